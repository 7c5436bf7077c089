// SPDX-License-Identifier: Apache-2.0
// Tests the division of the surfaces of a rectangle into slices.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "lib/slices/compositor.h"
#include "lib/slices/slice_plane.h"
#include "tests/support/test_scene.h"

namespace slices_test {
namespace {

using namespace starfocus;

constexpr int kSize = 64;

// Returns the rule without its limit on the total area of all slices.
SliceRule Ample(SliceRule rule) {
  rule.area = INT32_MAX;
  return rule;
}

// A map with one surface, or with further surfaces behind the first, as FindLayeredDepth returns
// maps.
struct Scene {
  std::vector<int16_t> planes[3];
  std::vector<uint64_t> hiding = std::vector<uint64_t>(kSize);
  std::vector<uint8_t> bins = std::vector<uint8_t>(starfocus::kSliceBins);
  std::vector<int32_t> least = std::vector<int32_t>(kSize);
  starfocus::LayeredDepth surfaces;
  starfocus::simd::DisparityRange bands[starfocus::kMaxRanges];

  Scene() {
    surfaces.width = surfaces.height = surfaces.stride = kSize;
    for (int k = 0; k < 3; ++k) {
      planes[k].assign(kSize * kSize + starfocus::simd::kSliceLanes,
                       k == 0 ? int16_t{0} : starfocus::kNoSurface);
      surfaces.disparity[k] = planes[k].data();
    }
    surfaces.hiding = hiding.data();
    surfaces.bins = bins.data();
    surfaces.least_blur = least.data();
  }

  int16_t& At(int x, int y, int surface = 0) {
    if (surface > 0) hiding[size_t(y)] |= uint64_t{1} << (x / 16);
    return planes[surface][size_t(y * kSize + x)];
  }

  // Returns the slices of the middle 16 x 16 pixels.
  std::vector<Slice> Cut(double focus, double aperture = 1,
                         const SliceRule& rule = Ample(starfocus::kSlices)) {
    starfocus::ViewWeights views;
    views.n = views.last = 4;
    const auto grid = starfocus::MakeViewGrid(views, starfocus::MakeFocusRange(focus), aperture, 0);
    const auto range = std::minmax_element(planes[0].begin(), planes[0].end());
    surfaces.low = *range.first;
    surfaces.high = *range.second;
    std::vector<Slice> slices(kMaxSlices);
    const int count = starfocus::FindSlices(starfocus::simd::BestKernels(), surfaces, grid, rule,
                                            {24, 24, 16, 16}, slices.data(), bands);
    REQUIRE(count > 0);
    REQUIRE(count <= rule.most);
    slices.resize(size_t(count));
    for (size_t k = 0; k < slices.size(); ++k) {
      CHECK(slices[k].low <= slices[k].disparity);
      CHECK(slices[k].disparity <= slices[k].high);
      CHECK(slices[k].high <= slices[k].overlap);
      if (k > 0) CHECK(slices[k].high < slices[k - 1].low);
    }
    return slices;
  }
};

TEST_CASE("slices: one surface is one slice, moved by its own disparity") {
  for (const int disparity : {-333, 0, 1, 517}) {
    Scene scene;
    std::fill(scene.planes[0].begin(), scene.planes[0].end(), int16_t(disparity));
    const std::vector<Slice> slices = scene.Cut(2.25);
    CHECK(slices.size() == 1);
    CHECK(slices[0].disparity == disparity);
  }
}

TEST_CASE("slices: the range of a band of rows includes the disparities of all surfaces") {
  Scene scene;
  scene.At(15, 15) = 20;
  scene.At(51, 17) = -40;
  scene.At(63, 18) = -50;   // The pixel is too far away to be visible in the middle of the picture.
  scene.At(20, 51) = -300;  // The pixel extends the range of disparities to hidden surfaces.
  for (int y = 30; y < 35; ++y) scene.At(40, y, 1) = int16_t(-100 - y);
  scene.At(0, 31, 2) = -200;
  scene.Cut(2.25);
  const int expected[7][2] = {{0, 0}, {0, 20}, {-40, 0}, {-200, 0}, {-134, 0}, {}, {-300, 0}};
  for (int band = 1; band < 7; ++band) {
    CAPTURE(band);
    for (const int row : {8 * band, 8 * band + 7}) {
      CHECK(scene.bands[row / starfocus::kRangeRows].low == expected[band][0]);
      CHECK(scene.bands[row / starfocus::kRangeRows].high == expected[band][1]);
    }
  }
}

TEST_CASE("slices: the nearest slice is first, and hidden surfaces also have slices") {
  Scene scene;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 30; x < kSize; ++x) scene.At(x, y) = 400;
  }
  // This pixel is too far away to be visible, but extends the range of disparities to hidden
  // surfaces.
  scene.At(0, 0) = -300;
  scene.At(35, 32, 1) = -200;
  scene.At(35, 32, 2) = -300;
  const std::vector<Slice> slices = scene.Cut(0);
  REQUIRE(slices.size() == 4);
  CHECK(slices[0].disparity == 400);
  CHECK(slices[1].disparity == 0);
  CHECK(slices[2].disparity == -200);
  CHECK(slices[3].disparity == -300);
}

TEST_CASE("slices: pixels that cannot splat into the rectangle are omitted") {
  Scene scene;
  scene.At(10, 30) = 64 * 12;  // the pixel is 14 columns away, and interpolation adds one column
  CHECK(scene.Cut(0).size() == 1);
  scene.At(10, 30) = 64 * 13;
  CHECK(scene.Cut(0).size() == 2);
  CHECK(scene.Cut(0, 0.5).size() == 1);
}

TEST_CASE("slices: ranges of disparity are 3/8 pixel or more for large blur, without gaps") {
  Scene scene;
  for (int y = 0; y < kSize; ++y) {
    // The disparities are from -2 to 2 pixels.
    for (int x = 0; x < kSize; ++x) scene.At(x, y) = int16_t(4 * (x - 32));
  }
  std::vector<bool> held(4 * 64);
  for (const Slice& slice : scene.Cut(0)) {
    CHECK(slice.high - slice.low < 24);
    for (int d = slice.low; d <= slice.high; ++d) held[size_t(d + 128)] = true;
  }
  for (int x = 24; x < 40; ++x) CHECK(held[size_t(scene.At(x, 30) + 128)]);
  const std::vector<Slice> blurred = scene.Cut(-40);
  for (const Slice& slice : blurred) CHECK(slice.high - slice.low <= 24 * (42 - 4) / 4);
  CHECK(blurred.size() < scene.Cut(0).size());
  for (const Slice& slice : scene.Cut(0, 1, Ample(starfocus::kFineSlices))) {
    CHECK(slice.high - slice.low < 8);
  }
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

TEST_CASE("slices: the ranges of slices become wider if slices are too many or too large") {
  test::Random random(5);
  Scene scene;
  for (int16_t& disparity : scene.planes[0]) disparity = int16_t(random.Int(-2000, 2000));
  const size_t all = scene.Cut(0).size();
  CHECK(all > 4);
  for (const SliceRule& tight : {SliceRule{int(all) - 1, starfocus::kSlices.range, INT32_MAX},
                                 SliceRule{16, starfocus::kSlices.range, 8 * 30 * 30}}) {
    CHECK(scene.Cut(0, 1, tight).size() < all);
  }
}

}  // namespace
}  // namespace slices_test
