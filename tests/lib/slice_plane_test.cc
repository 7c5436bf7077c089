// SPDX-License-Identifier: Apache-2.0
// Tests the reach of slices. The memory of slices must suffice for any lens.
#include "lib/slices/slice_plane.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lib/optics/rules.h"
#include "starfocus/starfocus.h"
#include "tests/support/test_scene.h"

namespace slice_plane_test {
namespace {

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

TEST_CASE("slice planes: for any N, the reach of a slice is at most LargestSliceReach") {
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

// Layered depth has a flag for groups of pixels with hidden surfaces. A slice may start within a
// group.
TEST_CASE("slice planes: pixels inside a slice are not integrated over pixels a second time") {
  // The nearer pixel is an integral. Without a scale of the shifts, the variance would be 0 up to a
  // blur of 1/2 and exceed the variance of the lens by up to 0.14 above.
  const double focus = 1;
  for (const int n : {3, 4, 5}) {
    const Views views(n);
    const starfocus::ViewGrid grid = starfocus::MakeViewGrid(
        views.aperture, starfocus::MakeFocusRange(focus), views.aperture.extent, 0);
    for (int blur = 1; blur <= 90; ++blur) {
      for (const int side : {-1, 1}) {
        const auto disparity = int16_t(64 * focus + side * blur);
        const starfocus::Slice slice = {disparity, disparity, disparity, disparity};
        std::vector<starfocus::simd::SliceOffset> offsets(size_t(2 * grid.n() + 1));
        starfocus::FindOffsets(grid, &slice, 1, offsets.data());
        double total = 0, exact = 0, shown = 0, mean = 0;
        for (int i = -grid.n(); i <= grid.n(); ++i) {
          double weight = 0;
          for (int j = -grid.n(); j <= grid.n(); ++j) weight += grid.aperture.Weight(i, j);
          const starfocus::simd::SliceOffset& offset = offsets[size_t(i + grid.n())];
          const double share = 1 + offset.inside / 32768.0;
          const double first = offset.whole, next = offset.whole + 1;
          const double shift = i * grid.step / std::ldexp(grid.n(), 24) * side * blur / 64;
          total += weight;
          exact += weight * shift * shift;
          shown += weight * ((1 - share) * first * first + share * next * next);
          mean += weight * (first + share);
        }
        const double subaperture = grid.step / std::ldexp(grid.n(), 24) * blur / 64;
        exact = exact / total + subaperture * subaperture / 12;
        CAPTURE(n);
        CAPTURE(blur);
        CHECK(std::fabs(mean / total) < 1e-6);
        CHECK(std::fabs(shown / total - exact - std::min(exact / 4, 1.0 / 24)) < 0.008);
      }
    }
  }
}

TEST_CASE("slice planes: a hidden pixel is found at any position in a group of pixels") {
  constexpr int kWidth = 64, kShown = 24;
  constexpr size_t kRoom = kWidth + 2 * starfocus::simd::kSliceLanes;
  for (int behind = 0; behind < kWidth; ++behind) {
    std::vector<int16_t> near(kRoom, 0), far(kRoom, starfocus::kNoSurface), none = far;
    far[size_t(behind)] = -640;
    std::vector<int16_t> rgb(3 * kRoom, starfocus::kLightWhite);
    std::vector<uint8_t> share(kRoom, 128);
    uint64_t hiding = uint64_t{1} << behind / int(starfocus::simd::kSliceLanes);
    starfocus::LayeredDepth surfaces;
    surfaces.width = surfaces.stride = kWidth;
    surfaces.height = 1;
    surfaces.plane = kRoom;
    surfaces.share = share.data();
    surfaces.hiding = &hiding;
    int16_t* disparities[] = {near.data(), far.data(), none.data()};
    for (int k = 0; k < 3; ++k) {
      surfaces.disparity[k] = disparities[k];
      surfaces.rgb[k] = rgb.data();
    }
    const starfocus::simd::DisparityRange bands[] = {{-640, 0}};
    starfocus::SlicePlane placed;
    placed.reach = placed.subaperture = 0;
    placed.rows = 1;
    placed.plane = starfocus::PlaneSamples(kShown, 0);
    std::vector<int16_t> samples(4 * placed.plane + 2 * starfocus::simd::kSliceLanes);
    starfocus::simd::SliceCover cover;
    placed.samples = samples.data();
    placed.cover = &cover;
    starfocus::Slice slice;
    slice.disparity = slice.low = slice.high = slice.overlap = -640;
    for (int x = 0; x + kShown <= kWidth; ++x) {
      CAPTURES(behind, x);
      starfocus::FillSlice(starfocus::simd::BestKernels(), surfaces, bands, slice,
                           {x, 0, kShown, 1}, nullptr, placed);
      const bool shown = behind >= x && behind < x + kShown;
      CHECK((cover.some != 0) == shown);
      if (shown) CHECK(samples[3 * placed.plane + size_t(behind - x)] != 0);
    }
  }
}

}  // namespace
}  // namespace slice_plane_test
