// SPDX-License-Identifier: Apache-2.0
// Tests the layout of memory, and the resulting sizes of engines and prepared light fields.

#include <doctest/doctest.h>

#include <cstdint>

#include "starfocus/starfocus.h"
#include "tests/support/config.h"
#include "tests/support/inside.h"
#include "tests/support/memory_parts.h"
#include "tests/support/test_scene.h"

namespace layout_bytes_test {
namespace {

using starfocus::Arena;
using starfocus::kTooLarge;

// The test is skipped with red zones between pieces, since such pieces do not share memory.
TEST_CASE("layout: each allocated piece is aligned, padded and counted" *
          doctest::skip(starfocus::kRedZone > 0)) {
  alignas(STARFOCUS_ALIGNMENT) static uint8_t memory[1 << 12];
  Arena counting(nullptr), arena(memory);
  for (Arena* one : {&counting, &arena}) {
    uint8_t* first = one->Take<uint8_t>(1);
    int32_t* second = one->Take<int32_t>(7, 5);
    uint8_t* shared = nullptr;
    const auto fill_rest = [&] {
      const size_t room = one->Rest();
      CHECK(room >= 1000 - 63);
      shared = one->Take<uint8_t>(room);
      CHECK(one->Rest() == 0);
    };
    // The inner parts also see the length of the outer part before them.
    const auto inner = [&] { one->Overlap([&] { one->Take<uint8_t>(10); }, fill_rest); };
    one->Overlap([&] { one->Take<uint8_t>(1000); }, inner, [&] { one->Take<uint8_t>(10); });
    CHECK(one->Bytes() == 128 + 256 + 1088);
    CHECK(one->Rest() == 0);
    uint8_t* last = one->Take<uint8_t>(0);
    if (one == &counting) {
      CHECK((first == nullptr && second == nullptr && shared == nullptr && last == nullptr));
      continue;
    }
    CHECK(first == memory);
    // 1 + 64 bytes are rounded up to 128 bytes.
    CHECK(reinterpret_cast<uint8_t*>(second) == memory + 128);
    // 140 + 64 bytes are rounded up to 256 bytes.
    CHECK(shared == memory + 128 + 256);
    // 1000 + 64 bytes are rounded up to 1088 bytes.
    CHECK(last == shared + 1088);
  }
  CHECK(counting.Bytes() == 128 + 256 + 1088 + 64);
  CHECK(arena.Bytes() == counting.Bytes());
}

TEST_CASE("layout: sizes beyond the address space are reported as too large") {
  // Bytes that padding and rounding add to a piece.
  constexpr size_t kMost = 1 << 16, kExtra = starfocus::kRedZone + 64 + 63;
  const auto bytes = [](size_t count, size_t times) {
    Arena arena(nullptr, kMost);
    arena.Take<uint32_t>(count, times);
    return arena.Bytes();
  };
  CHECK(bytes((kMost - kExtra) / 4, 1) <= kMost);
  CHECK(bytes(1, (kMost - kExtra) / 4) <= kMost);
  CHECK(bytes((kMost - kExtra) / 4 + 1, 1) == kTooLarge);
  // Products of count and size that overflow to small numbers are reported as too large.
  CHECK(bytes(SIZE_MAX / 4 + 1, 1) == kTooLarge);
  CHECK(bytes(SIZE_MAX / 8 + 2, 2) == kTooLarge);
  CHECK(bytes(SIZE_MAX, SIZE_MAX) == kTooLarge);
  CHECK(bytes(0, SIZE_MAX) == starfocus::kRedZone + 64);
  // After the sum of sizes overflows, the total must remain kTooLarge.
  Arena arena(nullptr);
  arena.Take<uint8_t>(SIZE_MAX / 2 - kExtra);
  CHECK(arena.Bytes() <= SIZE_MAX / 2);
  arena.Overlap([&] { arena.Take<uint8_t>(1); }, [] {});
  CHECK(arena.Bytes() == kTooLarge);
}

// The recorded sizes are the sizes in KiB in docs/boards.md, for all modes and both renderers.
TEST_CASE("layout: the workspaces for boards do not exceed their recorded sizes" *
          doctest::skip(starfocus::kRedZone > 0)) {
  const auto with_coverage = [](test::Config config) {
    config.features |= STARFOCUS_FEATURE_COVERAGE;
    return config;
  };
  const struct {
    test::Config config;
    size_t most;
  } kBoards[] = {
      // The first three boards have memory for thin structures.
      {with_coverage(test::BoardConfig(640, 480, 1, 32, 8, 1)), 4569},
      {with_coverage(test::BoardConfig(1920, 1080, 17, 64, 32, 0)), 14449},
      {with_coverage(test::BoardConfig(1920, 1080, 1, 64, 32, 0)), 14522},
      // VGA, one streamed view, blocks of 32 pixels, blurs of up to 8 pixels.
      {test::BoardConfig(640, 480, 1, 32, 8, 1), 1141},
      // Full HD, whole pictures, blocks of 64 pixels, blurs of up to 32 pixels.
      {test::BoardConfig(1920, 1080, 17, 64, 32, 0), 3049},
      {test::BoardConfig(1920, 1080, 1, 64, 32, 0), 3049},
      // On the last board, the engine has no layers 1 and 2.
      {[] {
         test::Config config = test::BoardConfig(640, 480, 1, 32, 8, 1);
         config.tuning.max_layer = 0;
         return config;
       }(),
       1056},
  };
  for (const auto& board : kBoards) {
    size_t bytes = 0;
    REQUIRE(starfocus_workspace_size(&board.config, &bytes, nullptr) == STARFOCUS_OK);
    CAPTURE(bytes);
    CHECK(bytes <= board.most << 10);
  }
  // Features and renderers that are left out need no memory.
  test::Config whole = test::BoardConfig(640, 480, 1, 32, 8, 1);
  whole.tuning.line_scan = starfocus_line_scan_renderer();
  test::Config slices = whole, shapes = whole;
  slices.tuning.line_scan = nullptr;
  shapes.features |= STARFOCUS_FEATURE_SHAPES;
  CHECK(test::WorkspaceBytes(slices) < test::WorkspaceBytes(whole));
  CHECK(test::WorkspaceBytes(whole) < test::WorkspaceBytes(shapes));
}

// docs/boards.md lists the parts that MeasureParts returns.
TEST_CASE("layout: the sizes of all parts add up to the size of the workspace" *
          doctest::skip(starfocus::kRedZone > 0)) {
  for (const int streaming : {0, 1}) {
    for (const int images : {0, 1}) {
      test::Config config = test::BoardConfig(320, 200, 5, 64, 12, streaming);
      test::SetFeature(STARFOCUS_FEATURE_IMAGES, images, &config.features);
      const std::vector<test::MemoryPart> parts = test::MeasureParts(config);
      size_t bytes = 0;
      REQUIRE(starfocus_workspace_size(&config, &bytes, nullptr) == STARFOCUS_OK);
      CHECK(!parts.empty());
      CHECK(test::SumOf(parts).all == bytes);
    }
  }
}

// The engine of a preview uses the memory of the engine of the full picture.
TEST_CASE("layout: the layout of a preview fits into the workspace of the full picture") {
  test::Random random(44);
  for (int round = 0; round < 300; ++round) {
    test::Config config;
    config.width = random.Int(1, random.Int(0, 1) == 0 ? 40 : STARFOCUS_MAX_SIZE);
    config.height = random.Int(1, 4000);
    config.disparity_max = float(random.Real(0, 500));
    config.max_blur = random.Real(0.1, STARFOCUS_MAX_BLUR);
    config.superblock = 32 << random.Int(0, 3);
    config.max_workers = random.Int(1, 4);
    test::SetFeature(STARFOCUS_FEATURE_STREAMING, random.Int(0, 1), &config.features);
    test::SetFeature(STARFOCUS_FEATURE_IMAGES, random.Int(0, 1), &config.features);
    config.highlights = random.Int(0, 1) == 0 ? 1.0F : 8.0F;
    test::SetFeature(STARFOCUS_FEATURE_SHAPES, random.Int(0, 1), &config.features);
    const size_t bytes = test::WorkspaceBytes(config);
    if (bytes == kTooLarge) continue;
    config.previews = STARFOCUS_MAX_PREVIEW;
    CHECK(test::WorkspaceBytes(config) == bytes);
    for (int shift = 1; shift <= STARFOCUS_MAX_PREVIEW; ++shift) {
      const starfocus::FullConfig reduced = starfocus::ReducedConfig(config, shift);
      CAPTURES(round, shift);
      CHECK(test::WorkspaceBytes(reduced) <= bytes);
    }
  }
}

TEST_CASE(
    "layout: an engine of a preview shares workers and tables, and leaves the engine unchanged") {
  test::Config config;
  config.width = 300;
  config.height = 200;
  config.max_workers = 2;
  config.features |= STARFOCUS_FEATURE_STREAMING;
  test::Engine engine(config);
  REQUIRE(engine.status() == STARFOCUS_OK);
  starfocus::EngineState& state = test::StateOf(engine.get());
  const starfocus::Scratch* workers = state.scratch;
  const uint32_t* sums = workers[1].sums;
  const uint16_t* weights = state.tables->apertures[0].weights;
  const uint8_t *out = state.stripe.out.codes.data, *last_rows = state.stripe.last_rows.codes.data;
  state.rings.map_width = 300;
  state.stream.active = true;
  const starfocus::EngineState preview =
      starfocus::PreviewEngine(starfocus::ReducedConfig(state.config, 2), &state);
  CHECK(preview.config.width == 75);
  CHECK(preview.scratch == workers);
  CHECK(preview.scratch[1].sums == sums);
  CHECK(preview.tables->apertures[0].weights == weights);
  CHECK(preview.jobs == state.jobs);
  CHECK(preview.rings.disparity.data == state.rings.disparity.data);
  CHECK(preview.stripe.last_rows.codes.data == nullptr);  // previews are not streamed
  CHECK(state.config.width == 300);
  CHECK(state.stripe.out.codes.data == out);
  CHECK(state.stripe.last_rows.codes.data == last_rows);
  CHECK_FALSE(state.stream.active);   // the preview overwrites the rows of the stream
  CHECK(state.rings.map_width == 0);  // and the table of the map's columns
}

// On 32-bit machines, wide streaming configurations exceed the address space.
TEST_CASE("layout: sizes never overflow, and every call rejects sizes that are too large") {
  test::Config config;
  config.height = 65535;
  config.views = STARFOCUS_MAX_VIEWS;
  config.disparity_min = -500;
  config.disparity_max = 500;
  config.max_blur = STARFOCUS_MAX_BLUR;
  config.superblock = 256;
  config.features |= STARFOCUS_FEATURE_STREAMING;
  int refused = 0;
  for (int width = 999; width <= STARFOCUS_MAX_SIZE; width += 1000) {
    config.width = width;
    // Ring buffers of streams hold all views with 3 bytes per pixel. A ring buffer has the rows of
    // a stripe, and the rows within reach of the largest disparity and blur.
    const uint64_t rings = uint64_t{3 * STARFOCUS_MAX_VIEWS * (256 + 2 * 628)} * uint64_t(width);
    size_t bytes = 77;
    const starfocus_status status = starfocus_workspace_size(&config, &bytes, nullptr);
    CAPTURE(width);
    if (status == STARFOCUS_OK) {
      CHECK(bytes > rings);
      CHECK(bytes < 4 * rings + (1 << 26));
      continue;
    }
    CHECK(status == STARFOCUS_ERROR_TOO_LARGE);
    CHECK(bytes == 77);
    ++refused;
    alignas(STARFOCUS_ALIGNMENT) static uint8_t little[STARFOCUS_ALIGNMENT];
    starfocus_engine* engine = nullptr;
    CHECK(starfocus_init(&config, little, sizeof(little), &engine, nullptr) ==
          STARFOCUS_ERROR_TOO_LARGE);
    CHECK(engine == nullptr);
  }
  CHECK((refused > 0) == (sizeof(size_t) == 4));
}

}  // namespace
}  // namespace layout_bytes_test
