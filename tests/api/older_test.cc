// SPDX-License-Identifier: Apache-2.0
// Tests structures with a field `size` as callers pass them whose headers are older or newer than
// the library. Every structure is in memory of exactly its size, so that sanitizers find reads and
// writes beyond its end.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "starfocus/depth.h"
#include "starfocus/experimental.h"
#include "starfocus/starfocus.h"
#include "tests/support/config.h"
#include "tests/support/prepared_memory.h"
#include "tests/support/test_scene.h"

namespace older_test {
namespace {

constexpr int kWidth = 70, kHeight = 50;

// The first `size` bytes of a structure, or the structure and `rest` in the bytes after it.
template <class Structure>
class Sized {
 public:
  Sized(const Structure& whole, size_t size, uint8_t rest = 0) : memory_(std::max(size, kLeast)) {
    std::fill(memory_.begin(), memory_.end(), rest);
    std::memcpy(memory_.data(), &whole, std::min(memory_.size(), sizeof whole));
    const auto given = uint32_t(size);
    std::memcpy(memory_.data(), &given, sizeof given);
  }
  Structure* get() { return reinterpret_cast<Structure*>(memory_.data()); }

 private:
  static constexpr size_t kLeast = sizeof(uint32_t);
  std::vector<uint8_t> memory_;
};

struct Fixture {
  test::Scene scene = test::RandomScene(kWidth, kHeight, 5, -3, 6, 4);
  test::Config config = test::ConfigFor(scene, 12);
  test::Engine engine{config};
  starfocus_light_field field = scene.Field();
  test::Output out{kWidth, kHeight};
  starfocus_image image = starfocus_image_rgb(out.bytes.data(), out.stride);
  starfocus_params params;
  std::vector<uint8_t> expected;

  Fixture() {
    starfocus_params_init(&params);
    params.focus = 2;
    expected = Refocus(&params, &field, nullptr);
  }
  std::vector<uint8_t> Refocus(const starfocus_params* lens, const starfocus_light_field* given,
                               starfocus_report* report) {
    std::fill(out.bytes.begin(), out.bytes.end(), test::kPoison);
    REQUIRE(starfocus_refocus(engine.get(), lens, given, &image, report) == STARFOCUS_OK);
    return out.bytes;
  }
};

TEST_CASE("older: missing fields of parameters and light fields get their defaults") {
  Fixture f;
  Sized<starfocus_params> lens(f.params, offsetof(starfocus_params, aperture));
  Sized<starfocus_light_field> field(f.field, offsetof(starfocus_light_field, coverage));
  CHECK(f.Refocus(lens.get(), field.get(), nullptr) == f.expected);
  starfocus_study study = {sizeof study, STARFOCUS_MODE_BLUR, STARFOCUS_RENDERER_SLICES};
  f.params.study = &study;
  const std::vector<uint8_t> blurred = f.Refocus(&f.params, &f.field, nullptr);
  Sized<starfocus_study> shorter(study, offsetof(starfocus_study, renderer));
  f.params.study = shorter.get();
  CHECK(f.Refocus(&f.params, &f.field, nullptr) == blurred);
}

TEST_CASE("older: a report is filled up to the size of the caller") {
  Fixture f;
  starfocus_layer_report layers[STARFOCUS_LAYERS] = {};
  starfocus_report whole;
  starfocus_report_init(&whole);
  whole.layers = layers;
  f.Refocus(&f.params, &f.field, &whole);
  CHECK(layers[0].pixels + layers[1].pixels + layers[2].pixels == kWidth * kHeight);
  CHECK(whole.rendered_samples > 0);
  for (const size_t size :
       {offsetof(starfocus_report, n) + sizeof(int32_t),
        offsetof(starfocus_report, gathered_pixels), offsetof(starfocus_report, layers)}) {
    starfocus_report poison;
    std::memset(&poison, test::kPoison, sizeof poison);
    Sized<starfocus_report> report(poison, size), full(whole, size);
    f.Refocus(&f.params, &f.field, report.get());
    CHECK(std::memcmp(report.get(), full.get(), size) == 0);
  }
}

TEST_CASE("older: light fields without coverage can be compared, prepared, pushed and estimated") {
  Fixture f;
  Sized<starfocus_light_field> field(f.field, offsetof(starfocus_light_field, coverage));
  const std::vector<uint8_t> before = f.expected;
  const starfocus_image before_image = starfocus_image_rgb(before.data(), f.out.stride);
  const starfocus_previous previous = {sizeof previous, field.get(), &before_image};
  starfocus_params after = f.params;
  after.previous = &previous;
  starfocus_report report;
  starfocus_report_init(&report);
  CHECK(f.Refocus(&after, field.get(), &report) == f.expected);
  CHECK(report.reused_blocks == 2);

  test::PreparedMemory memory(f.engine);
  starfocus_prepared* prepared = memory.Prepare(f.engine.get(), *field.get());
  CHECK(starfocus_refocus_prepared(f.engine.get(), &f.params, prepared, &f.image, nullptr) ==
        STARFOCUS_OK);
  CHECK(f.out.bytes == f.expected);

  test::Config streaming = f.config;
  streaming.features |= STARFOCUS_FEATURE_STREAMING;
  test::Engine stream(streaming);
  int32_t consumed = 0;
  REQUIRE(starfocus_stream_begin(stream.get(), &f.params) == STARFOCUS_OK);
  CHECK(starfocus_stream_push(stream.get(), field.get(), kHeight, &consumed) == STARFOCUS_OK);
  CHECK(consumed == kHeight);

  size_t bytes = 0;
  REQUIRE(starfocus_map_workspace_size(&f.config, 0, &bytes, nullptr) == STARFOCUS_OK);
  std::vector<uint8_t> room(bytes + STARFOCUS_ALIGNMENT);
  uint8_t* workspace = room.data();
  while (reinterpret_cast<uintptr_t>(workspace) % STARFOCUS_ALIGNMENT != 0) ++workspace;
  std::vector<float> map(kWidth * kHeight);
  starfocus_disparity_output output = {};
  output.disparity = map.data();
  output.disparity_stride = sizeof(float) * kWidth;
  CHECK(starfocus_estimate_disparity(&f.config, nullptr, field.get(), &output, workspace, bytes,
                                     nullptr) == STARFOCUS_OK);
}

int blocks = 0, times = 0;

TEST_CASE("older: missing fields of tuning and observer get their defaults") {
  Fixture f;
  starfocus_tuning tuning;
  starfocus_tuning_init(&tuning);
  Sized<starfocus_tuning> shorter(tuning, offsetof(starfocus_tuning, deblocking));
  starfocus_config config = f.config;
  config.tuning = &tuning;
  size_t expected = 0, bytes = 0;
  CHECK(starfocus_workspace_size(&config, &expected, nullptr) == STARFOCUS_OK);
  config.tuning = shorter.get();
  CHECK(starfocus_workspace_size(&config, &bytes, nullptr) == STARFOCUS_OK);
  CHECK(bytes == expected);

  starfocus_observer observer;
  starfocus_observer_init(&observer);
  observer.clock = [](void*) { return uint64_t(++times); };
  observer.on_block = [](void*, const starfocus_block*) { ++blocks; };
  Sized<starfocus_observer> clock(observer, offsetof(starfocus_observer, clock_data));
  starfocus_callbacks callbacks = {};
  callbacks.observer = clock.get();
  REQUIRE(starfocus_set_callbacks(f.engine.get(), &callbacks) == STARFOCUS_OK);
  CHECK(f.Refocus(&f.params, &f.field, nullptr) == f.expected);
  CHECK(times > 0);
  CHECK(blocks == 0);
}

// Checks that call(structure) accepts `whole` and rejects it with sizes that no header has, and
// with the size of a newer header, whether or not its unknown fields are 0.
template <class Structure, class Call>
void CheckSizes(const Structure& whole, const Call& call) {
  Sized<Structure> right(whole, sizeof whole);
  CHECK(call(right.get()) == STARFOCUS_OK);
  for (const size_t size : {size_t{0}, size_t{3}, sizeof(uint32_t), sizeof whole + 8}) {
    for (const uint8_t rest : {uint8_t{0}, uint8_t{1}}) {
      Sized<Structure> wrong(whole, size, rest);
      CHECK(call(wrong.get()) == STARFOCUS_ERROR_STRUCTURE);
    }
  }
}

TEST_CASE("older: sizes that no header has, and sizes of newer headers, are rejected") {
  Fixture f;
  size_t bytes = 0;
  starfocus_config config = f.config;
  const auto size_of = [&](const starfocus_config* given) {
    return starfocus_workspace_size(given, &bytes, nullptr);
  };
  CheckSizes(config, size_of);
  starfocus_tuning tuning;
  starfocus_tuning_init(&tuning);
  CheckSizes(tuning, [&](const starfocus_tuning* given) {
    config.tuning = given;
    return size_of(&config);
  });
  starfocus_report report;
  starfocus_report_init(&report);
  const auto refocus = [&](const starfocus_params* lens, const starfocus_light_field* field,
                           starfocus_report* to) {
    return starfocus_refocus(f.engine.get(), lens, field, &f.image, to);
  };
  CheckSizes(f.params, [&](auto* given) { return refocus(given, &f.field, nullptr); });
  CheckSizes(f.field, [&](auto* given) { return refocus(&f.params, given, nullptr); });
  CheckSizes(report, [&](auto* given) { return refocus(&f.params, &f.field, given); });
  starfocus_study study;
  starfocus_study_init(&study);
  starfocus_params lens = f.params;
  CheckSizes(study, [&](const starfocus_study* given) {
    lens.study = given;
    return refocus(&lens, &f.field, nullptr);
  });
  const starfocus_image before = starfocus_image_rgb(f.expected.data(), f.out.stride);
  starfocus_previous previous = {sizeof previous, &f.field, &before};
  lens = f.params;
  CheckSizes(previous, [&](const starfocus_previous* given) {
    lens.previous = given;
    return refocus(&lens, &f.field, nullptr);
  });
  lens.previous = &previous;
  CheckSizes(f.field, [&](const starfocus_light_field* given) {
    previous.light_field = given;
    return refocus(&lens, &f.field, nullptr);
  });
  starfocus_observer observer;
  starfocus_observer_init(&observer);
  CheckSizes(observer, [&](const starfocus_observer* given) {
    starfocus_callbacks callbacks = {};
    callbacks.observer = given;
    return starfocus_set_callbacks(f.engine.get(), &callbacks);
  });
}

}  // namespace
}  // namespace older_test
