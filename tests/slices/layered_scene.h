// SPDX-License-Identifier: Apache-2.0
// A small light field for the tests of layered depth.
#ifndef STARFOCUS_TESTS_SLICES_LAYERED_SCENE_H_
#define STARFOCUS_TESTS_SLICES_LAYERED_SCENE_H_

#include <algorithm>
#include <vector>

#include "lib/io/block_pixels.h"
#include "lib/slices/layered_depth.h"
#include "tests/support/star_views.h"
#include "tests/support/test_scene.h"

namespace test {

using starfocus::kNoSurface;
using starfocus::LayeredDepth;

inline constexpr int kSize = 40;
inline constexpr int kStride = 48;  // SliceSamples
inline constexpr int kStripColumns = int(starfocus::simd::kSliceLanes);
inline constexpr int kArea = kStride * kSize + 16;

// A light field of a disparity map in pixels per unit, a centre view of one grey level, and
// captured views. Each pixel of a captured view stores its position: R is x, G is y, and B is the
// index of the view.
struct LayeredScene {
  std::vector<int16_t> disparity = std::vector<int16_t>(kSize * kSize);
  std::vector<uint8_t> centre = std::vector<uint8_t>(3 * kSize * kSize);
  std::vector<uint8_t> side[STARFOCUS_MAX_VIEWS];
  std::vector<int16_t> planes[3], rows[2];
  std::vector<uint16_t> sources[2];
  std::vector<starfocus::simd::StepBits> steps;
  std::vector<uint8_t> edges[4], share;
  std::vector<int16_t> colours[3], rgb;
  std::vector<uint64_t> hiding = std::vector<uint64_t>(kSize);
  starfocus::Input input;
  LayeredDepth surfaces;
  starfocus::BlockPixels field;
  std::vector<int16_t> copy;

  explicit LayeredScene(int views) {
    for (int view = 1; view < views; ++view) {
      side[view].resize(3 * kSize * kSize);
      for (int at = 0; at < kSize * kSize; ++at) {
        uint8_t* pixel = &side[view][size_t(3 * at)];
        pixel[0] = uint8_t(at % kSize);
        pixel[1] = uint8_t(at / kSize);
        pixel[2] = uint8_t(view);
      }
      test::SetPixels(view, side[view], 3 * kSize, &input);
    }
    input.width = input.height = kSize;
    test::SetStar(views, &input);
  }

  void Set(int x, int y, double pixels, int grey) {
    disparity[size_t(y * kSize + x)] = int16_t(64 * pixels);
    std::fill_n(&centre[size_t(3 * (y * kSize + x))], 3, uint8_t(grey));
  }
  void Fill(int x0, int x1, int y0, int y1, double pixels, int grey) {
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) Set(x, y, pixels, grey);
    }
  }

  void Find() {
    input.transfer = &starfocus::TransferOf(STARFOCUS_TRANSFER_NONE);
    test::SetPixels(0, centre, 3 * kSize, &input);
    input.disparity = {disparity.data(), kSize, 0, 0};
    for (int k = 0; k < 3; ++k) {
      planes[k].assign(kArea + 2 * kStripColumns, 0);
      colours[k].assign(3 * kArea + kStripColumns, 0);
      surfaces.disparity[k] = planes[k].data() + kStripColumns;
      surfaces.rgb[k] = colours[k].data() + kStripColumns;
    }
    for (int k = 0; k < 4; ++k) {
      edges[k].assign(kArea, 0);
      surfaces.edges[k] = edges[k].data();
    }
    for (std::vector<int16_t>& row : rows) row.assign(kStride, 0);
    for (int k = 0; k < 2; ++k) {
      sources[k].assign(kArea, 0);
      surfaces.sources[k] = sources[k].data();
    }
    steps.resize(kStride / kStripColumns);
    surfaces.steps = steps.data();
    share.assign(kArea, 0);
    surfaces.share = share.data();
    surfaces.moved = rows[0].data();
    surfaces.behind = rows[1].data();
    surfaces.hiding = hiding.data();
    rgb.assign(starfocus::RgbStride(kSize) * kSize, 0);
    copy.assign(kSize * kSize + starfocus::simd::kPadding, 0);
    field = {};
    field.rgb = rgb.data();
    field.disparity = copy.data();
    starfocus::LoadBlock(input, 0, {0, 0, kSize, kSize}, {0, 0, 0, 0}, &field);
    starfocus::FindLayeredDepth(starfocus::simd::BestKernels(), input, field, &surfaces);
  }

  // Returns a disparity in pixels per unit, or -1000 if there is no surface.
  double Behind(int x, int y, int surface = 1) const {
    const int16_t found = surfaces.disparity[surface][surfaces.At(x, y)];
    return found == kNoSurface ? -1000 : found / 64.0;
  }
  int Colour(int x, int y, int c, int surface = 1) const {
    const int light = surfaces.rgb[surface][size_t(c) * surfaces.plane + surfaces.At(x, y)];
    return (light + 64) >> starfocus::kLightBits;
  }
};

}  // namespace test

#endif  // STARFOCUS_TESTS_SLICES_LAYERED_SCENE_H_
