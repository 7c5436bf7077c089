// SPDX-License-Identifier: Apache-2.0
// Tests the separation of boundary pixels in a light field with one depth edge per row.
#include <doctest/doctest.h>

#include <vector>

#include "lib/io/block_pixels.h"
#include "lib/line_scan/line_scan.h"
#include "tests/support/star_views.h"

namespace unmix_test {
namespace {

using namespace starfocus;

constexpr int kSize = 24;
constexpr int kEdge = 12;  // the first near column

// Grey levels of the far surface, the near surface, and the mixed pixel between both surfaces.
struct Greys {
  int far, near, mixed;
};

// A far surface on the left and a near surface on the right. The side views show only the far
// surface.
struct Scene {
  std::vector<uint8_t> centre, side;
  std::vector<int16_t> disparity;
  std::vector<int16_t> rgb;
  Input input;
  BlockPixels field;

  Scene(double far, double near, const Greys& greys, int views = 5, bool mirrored = false)
      : centre(3 * kSize * kSize),
        side(3 * kSize * kSize, uint8_t(greys.far)),
        disparity(kSize * kSize),
        rgb(starfocus::RgbStride(kSize) * kSize) {
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const int at = y * kSize + (mirrored ? kSize - 1 - x : x);
        const int grey = x >= kEdge ? greys.near : x == kEdge - 1 ? greys.mixed : greys.far;
        for (int c = 0; c < 3; ++c) centre[size_t(3 * at + c)] = uint8_t(grey);
        disparity[size_t(at)] = int16_t(64 * (x >= kEdge ? near : far));
      }
    }
    input.width = kSize;
    input.height = kSize;
    test::SetStar(views, &input);
    input.transfer = &starfocus::TransferOf(STARFOCUS_TRANSFER_NONE);
    test::SetPixels(0, centre, 3 * kSize, &input);
    for (int view = 1; view < views; ++view) test::SetPixels(view, side, 3 * kSize, &input);
    input.disparity = {disparity.data(), kSize, 0, 0};
    field.rgb = rgb.data();
    field.disparity = disparity.data();
  }

  // Returns the grey levels of the middle row after UnmixEdges.
  std::vector<int> Unmixed(int layer = 0) {
    std::vector<int16_t> copy(disparity.size() + starfocus::simd::kPadding);
    field.disparity = copy.data();
    starfocus::LoadBlock(input, 0, {4, 4, kSize - 8, kSize - 8}, {4, 4, 4, 4}, &field);
    starfocus::ViewWeights aperture;
    aperture.n = aperture.last = 4;
    field.layer = layer;
    const ViewGrid grid = starfocus::MakeViewGrid(aperture, {}, 1, 0);
    starfocus::UnmixEdges(starfocus::simd::BestKernels(), input, grid, &field);
    std::vector<int> greys;
    for (int x = 0; x < kSize; ++x)
      greys.push_back((*field.Rgb(x, kSize / 2) + 64) >> starfocus::kLightBits);
    return greys;
  }

  // Returns the level of the mixed pixel, and checks that all other pixels are unchanged.
  int Mixed(int layer = 0) {
    const std::vector<int> greys = Unmixed(layer);
    for (int x = 0; x < kSize; ++x) {
      if (x != kEdge - 1) CHECK(greys[size_t(x)] == centre[size_t(3 * x)]);
    }
    return greys[kEdge - 1];
  }
};

TEST_CASE("unmix: the near part of a sharp pixel next to a defocused surface is removed") {
  // Half of the mixed pixel shows the near surface.
  CHECK(Scene(0, 4, {40, 240, 140}).Mixed() == 40);
  CHECK(Scene(0, 4, {40, 240, 170}).Mixed() == 40);
  // The mixed pixel shows a quarter of the near surface, and unmixing removes half of this quarter.
  CHECK(Scene(0, 4, {40, 240, 90}).Mixed() == 65);
  CHECK(Scene(0, 4, {240, 40, 190}).Mixed() == 215);
  CHECK(Scene(0, 4, {40, 240, 40}).Mixed() == 40);
  CHECK(Scene(-1, 4, {40, 240, 90}).Mixed() == 65);
}

TEST_CASE("unmix: the far colour is read from the view that sees behind the edge") {
  for (const int views : {5, 9, 17}) {
    for (const bool mirrored : {false, true}) {
      // Only the view that sees behind the edge is grey. If UnmixEdges read another view, the pixel
      // would not count as mixed.
      Scene scene(2, 6, {40, 240, 140}, views, mirrored);
      std::vector<uint8_t> other(scene.side.size(), 240);
      const int right = views == 17 ? 9 : 1, left = right + 1, behind = mirrored ? right : left;
      for (int view = 1; view < views; ++view) {
        if (view != behind) scene.input.images[view].planes[0] = other.data();
      }
      // In the view that sees behind the edge, only the pixel that moves by -u d is grey.
      const int x = mirrored ? kSize - kEdge : kEdge - 1;
      const int moved = x + (mirrored ? -1 : 1) * (views == 17 ? 1 : 2);
      std::vector<uint8_t> one(scene.side.size(), 240);
      for (int y = 0; y < kSize; ++y) {
        for (int c = 0; c < 3; ++c) one[size_t(3 * (y * kSize + moved) + c)] = 40;
      }
      scene.input.images[behind].planes[0] = one.data();
      CHECK(scene.Unmixed()[size_t(x)] == 40);
    }
  }
}

TEST_CASE("unmix: pixels that are blurred, not mixed, or sharp in the near surface do not change") {
  CHECK(Scene(-4, 0, {40, 240, 140}).Mixed() == 140);  // The near surface is in focus.
  CHECK(Scene(0, 1, {40, 240, 140}).Mixed() == 140);   // The step is too small for a depth edge.
  // The mixed pixel is blurred by three pixels.
  CHECK(Scene(-3, 8, {40, 240, 140}).Mixed() == 140);
  // A slightly blurred pixel is unmixed in part.
  CHECK(Scene(-2.5, 8, {40, 240, 140}).Mixed() == 90);
  // The near surface is hardly more defocused.
  CHECK(Scene(-1.5, 2, {40, 240, 140}).Mixed() == 90);
  CHECK(Scene(0, 4, {40, 240, 232}).Mixed() == 232);  // The near surface covers most of the pixel.
  CHECK(Scene(0, 4, {40, 240, 20}).Mixed() == 20);  // The mixed colour lies beyond the far colour.
  CHECK(Scene(0, 4, {40, 44, 42}).Mixed() == 42);   // The surfaces differ by only 4 levels.
  CHECK(Scene(0, 4, {40, 240, 140}, 1).Mixed() == 140);  // No view sees behind the edge.
  CHECK(Scene(0, 4, {40, 240, 140}).Mixed(1) == 140);    // Pixels of layer 1 are not unmixed.
  Scene colourful(0, 4, {40, 240, 70});
  for (int y = 0; y < kSize; ++y) colourful.centre[size_t(3 * (y * kSize + kEdge - 1))] = 255;
  CHECK(colourful.Mixed() == 255);
}

}  // namespace
}  // namespace unmix_test
