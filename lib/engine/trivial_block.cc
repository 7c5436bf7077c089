// SPDX-License-Identifier: Apache-2.0
#include "lib/engine/trivial_block.h"

#include <cstring>

#include "lib/input/picture_edge.h"

namespace starfocus {
namespace {

// In all views a pixel stays in its place, and its neighbour does not count, where
// 2 |t| + L <= 1 (SubapertureWeight) for its shift t and subaperture L <= |t|; here in
// kShiftBits, less one for rounding.
constexpr int32_t kStill = kShiftOne / 3 - 1;

// Disparity steps from pixel to pixel, as moved by the outermost view at layer 0, up to which a
// surface neither folds nor tears in any view, so that no hole opens: kMaxStretch bridges what an
// eighth of a pixel and the rounding of shifts add up to.
constexpr int32_t kGentleStep = (1 << kDisparityBits) / 8;

// The part of the extended rectangle that lies in the picture, which is never empty.
struct Part {
  int32_t left, right, top, bottom;  // exclusive at the right and the bottom
};

Part PartOf(const RenderJob& job) {
  const Window& window = *job.window;
  const Rect rect = Extended(job.rect, job.border);
  return {Clamp(rect.x, 0, window.width - 1), Clamp(rect.x + rect.width, 1, window.width),
          Clamp(rect.y, 0, window.height - 1), Clamp(rect.y + rect.height, 1, window.height)};
}

// A row of the layer's disparities: every 2^L-th of the picture's.
struct DisparityRow {
  const int16_t* row;
  int layer;
  int32_t last;

  DisparityRow(const Window& window, int32_t y)
      : row(window.disparity.Row(Min(y << window.layer, window.picture_height - 1))),
        layer(window.layer),
        last(window.picture_width - 1) {}
  int32_t At(int32_t x) const { return row[Min(x << layer, last)]; }
};

bool IsGentle(const Window& window, const Part& part) {
  for (int32_t y = part.top; y < part.bottom; ++y) {
    const DisparityRow row(window, y), above(window, Max(y - 1, part.top));
    int32_t before = row.At(part.left);
    for (int32_t x = part.left; x < part.right; ++x) {
      const int32_t disparity = row.At(x);
      if (Abs(disparity - before) > kGentleStep || Abs(disparity - above.At(x)) > kGentleStep) {
        return false;
      }
      before = disparity;
    }
  }
  return true;
}

// Whether all pixels of the part are alike.
template <class Sample>
bool IsUniform(const Plane<const Sample>& plane, const Part& part) {
  const auto left = 3 * static_cast<ptrdiff_t>(part.left);
  const Sample* first = plane.Row(part.top) + left;
  constexpr size_t kPixel = 3 * sizeof(Sample);
  const size_t bytes = kPixel * static_cast<size_t>(part.right - part.left);
  for (int32_t y = part.top; y < part.bottom; ++y) {
    const Sample* row = plane.Row(y) + left;
    if (std::memcmp(row, first, kPixel) != 0) return false;
    if (std::memcmp(row, row + 3, bytes - kPixel) != 0) return false;
  }
  return true;
}

}  // namespace

bool NothingMoves(const RenderJob& job) {
  const Window& window = *job.window;
  if (window.layer != 0) return false;
  const int64_t still =
      (int64_t{kStill} << (kStepBits + kDisparityBits - kShiftBits)) / job.grid->step;
  // Within this of one disparity there is no depth edge either, and so nothing to mix.
  const auto limit = static_cast<int32_t>(still < kSurfaceStep / 2 ? still : kSurfaceStep / 2);
  const int32_t focus = job.grid->focus;
  const Part part = PartOf(job);
  for (int32_t y = part.top; y < part.bottom; ++y) {
    const int16_t* row = window.disparity.Row(y);
    for (int32_t x = part.left; x < part.right; ++x) {
      if (Abs(row[x] - focus) > limit) return false;
    }
  }
  return true;
}

bool IsOneColour(const RenderJob& job, uint8_t* colour) {
  const Window& window = *job.window;
  const Part part = PartOf(job);
  int16_t light[3];
  if (window.layer == 0) {
    if (!IsUniform(window.centre, part)) return false;
    std::memcpy(colour, window.centre.Row(part.top) + 3 * static_cast<ptrdiff_t>(part.left), 3);
    job.kernels->Decode(colour, 3, window.transfer->encoding, light);
  } else {
    if (!IsUniform(window.samples, part)) return false;
    const int16_t* sample = window.samples.Row(part.top) + 3 * static_cast<ptrdiff_t>(part.left);
    job.kernels->Narrow(sample, 3, window.transfer->encoding, colour);
    job.kernels->Decode(colour, 3, window.transfer->encoding, light);
    // Samples of one colour are its light, rounded; else filters may leave the colour.
    for (int c = 0; c < 3; ++c) {
      if (sample[c] != (light[c] + 1) >> (kLightBits - simd::kLayerBits)) return false;
    }
  }
  // The centre view alone fills holes with what lies around them.
  if (window.views == 1) return true;
  return IsGentle(window, part) && ShowsBeyond(window, Extended(job.rect, job.border), light);
}

}  // namespace starfocus
