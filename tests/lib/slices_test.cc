// SPDX-License-Identifier: Apache-2.0
// Tests the limits of slices: the pixels that they reach, their memory, and their cancellation.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "lib/slices/compositor.h"
#include "lib/slices/slice_plane.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/inside.h"
#include "tests/support/refocused.h"
#include "tests/support/test_scene.h"

namespace slices_test {
namespace {

constexpr int kWidth = 96, kHeight = 64;

struct Views {
  explicit Views(int n)
      : weights(starfocus::ViewWeightsSize(n)),
        aperture(starfocus::MakeSubapertures(n, starfocus::ApertureFallOff(0.8), weights.data())) {}

  std::vector<uint16_t> weights;
  starfocus::ViewWeights aperture;
};

// Returns the number of pixels by which the slice of `disparity` exceeds a rectangle.
int ReachOf(const Views& views, double focus, double aperture, int disparity) {
  const starfocus::ViewGrid grid = starfocus::MakeViewGrid(
      views.aperture, starfocus::MakeFocusRange(focus), aperture * views.aperture.extent, 0);
  starfocus::SlicePlane placed;
  starfocus::PlaceSlice(grid, int16_t(disparity), {0, 0, 64, 64}, &placed);
  return placed.reach;
}

TEST_CASE("slices: for any N, the reach of a slice is at most LargestSliceReach") {
  test::Random random(7);
  std::vector<Views> all;
  for (int n = 1; n <= 26; ++n) all.emplace_back(n);
  double nearest = 9;  // smallest distance of a slice to the limit, pixels
  for (int round = 0; round < 40000; ++round) {
    const double blur =
        random.Int(0, 3) == 0 ? random.Int(1, 128) : random.Real(0.5, STARFOCUS_MAX_BLUR);
    const double aperture = random.Int(0, 1) == 0 ? 1 : random.Real(0.3, 1);
    // Rounding of the focus increases the distance between focus and disparity, and so does
    // rounding of the disparity.
    const double away = std::min(blur / aperture, 500.0);
    const double focus = std::floor(random.Real(-10, 10) * 64) / 64 + 0.5 / 64;
    const int disparity = int(std::floor((focus - away) * 64 + 0.5)) - random.Int(0, 2);
    if (std::abs(disparity) > 500 * 64) continue;
    for (const int n : {4, 4 + random.Int(-3, 22)}) {
      const Views& views = all[size_t(n - 1)];
      const int reach = ReachOf(views, focus, aperture, disparity);
      const int most = starfocus::LargestSliceReach(aperture * away);
      CAPTURES(n, blur, aperture);
      CHECK(reach <= most);
      nearest = std::min(nearest, double(most - reach));
    }
  }
  CHECK(nearest == 0);
}

TEST_CASE("slices: the limit of the total area of slices depends only on the blur of the lens") {
  CHECK(starfocus::SliceArea(4) == 400);
  for (const double blur : {0.5, 8.0, 32.9}) {
    CAPTURE(blur);
    CHECK(starfocus::MostSliceArea(blur) == 5 * 51 * 51);
  }
  CHECK(starfocus::MostSliceArea(33) == 5 * 52 * 52);
  CHECK(starfocus::MostSliceArea(STARFOCUS_MAX_BLUR) == 5 * 147 * 147);
}

TEST_CASE("slices: the memory of a slice is at most kAreaBytes times its area") {
  for (int reach = 0; reach <= starfocus::LargestSliceReach(STARFOCUS_MAX_BLUR); ++reach) {
    CAPTURE(reach);
    CHECK(starfocus::SliceBytes(starfocus::kLeastColumns, starfocus::kLeastRows, size_t(reach)) +
              starfocus::StripBytes(starfocus::kLeastRows, size_t(reach)) <=
          starfocus::kAreaBytes * size_t(starfocus::SliceArea(reach)));
  }
}

TEST_CASE("slices: slices that are computed in several parts give the same picture") {
  test::Scene scene = test::RandomScene(kWidth, kHeight, 5, -9, 9, 4);
  test::SetDisparity(&scene, [](int x, int) { return x < kWidth / 2 ? 9.0F : -9.0F; });
  test::Engine engine(test::ConfigFor(scene, 20));
  size_t& pool = test::PoolBytes(engine.get());
  const auto reach = size_t(starfocus::SliceReach(16 * starfocus::kShiftOne, starfocus::kShiftOne));
  const size_t whole = starfocus::SliceBytes(64, 64, reach) + starfocus::StripBytes(64, reach);
  const size_t least = starfocus::SliceBytes(16, 8, reach) + starfocus::StripBytes(8, reach);
  REQUIRE(pool > 2 * whole);
  for (const double focus : {0.0, 6.0}) {
    const starfocus::Params params = test::Params(focus, 1, STARFOCUS_MODE_BENCHMARK);
    test::Output out(kWidth, kHeight);
    const test::Output expected = test::OutputOf(&engine, params, scene);
    const size_t ample = pool;
    for (const size_t bytes : {whole, (whole + least) / 2, 2 * least}) {
      pool = bytes;
      REQUIRE(test::Refocus(&engine, params, scene, &out) == STARFOCUS_OK);
      CAPTURES(focus, bytes);
      CHECK(out.bytes == expected.bytes);
    }
    pool = ample;
  }
}

int rows_filled = 0;

// Cancels the call as soon as the first row of a slice has been filled.
int SayNo(void*, int32_t, int32_t) { return rows_filled > 0 ? 1 : 0; }

TEST_CASE("slices: no more buckets are computed after cancellation") {
  const test::Scene scene = test::RandomScene(256, 256, 5, -3, 9, 8);
  test::Config config = test::ConfigFor(scene, 32);
  config.superblock = 256;
  test::Engine engine(config);
  starfocus::simd::Kernels counting = starfocus::simd::BestKernels();
  counting.SelectSlice = [](auto... arguments) {
    ++rows_filled;
    return starfocus::simd::BestKernels().SelectSlice(arguments...);
  };
  test::UseKernels(&counting, engine.get());
  starfocus::Params params = test::Params(0, 1, STARFOCUS_MODE_FRAME, STARFOCUS_RENDERER_SLICES);
  test::Output out = test::OutputOf(&engine, params, scene);
  const int all = rows_filled;
  rows_filled = 0;
  CHECK(test::Refocus(&engine, params, scene, &out, test::ToldTo(SayNo)) ==
        STARFOCUS_ERROR_CANCELLED);
  CHECK(rows_filled > 0);
  CHECK(rows_filled < all / 8);  // fewer than two of sixteen buckets were computed
}

// With AddressSanitizer, red zones between the parts of a workspace increase its size.
TEST_CASE(
    "slices: a worker requires 1.15 MiB for blocks of 64 pixels and blurs of up to 32 pixels" *
    doctest::skip(starfocus::kRedZone > 0)) {
  size_t bytes[2];
  for (int workers = 1; workers <= 2; ++workers) {
    test::Config config = test::ConfigFor(test::EmptyScene(kWidth, kHeight, 17, -16, 16), 32);
    config.superblock = 64;
    config.max_workers = workers;
    REQUIRE(starfocus_workspace_size(&config, &bytes[workers - 1], nullptr) == STARFOCUS_OK);
  }
  CHECK(bytes[1] - bytes[0] <= size_t{1180} << 10);
}

}  // namespace
}  // namespace slices_test
