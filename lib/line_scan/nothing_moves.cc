// SPDX-License-Identifier: Apache-2.0
#include "lib/line_scan/nothing_moves.h"

#include "lib/base/fixed.h"

namespace starfocus {
namespace {

// A pixel stays in its place in all views, and its neighbour has weight 0, where
// 2 |t| + L <= 1 (SubapertureWeight) for its shift t and subaperture L <= |t|. In kShiftBits, less
// one for rounding.
constexpr int32_t kStill = kShiftOne / 3 - 1;

}  // namespace

bool NothingMoves(const RenderJob& job) {
  const Window& window = *job.window;
  if (window.layer != 0) return false;
  const int64_t still =
      (int64_t{kStill} << (kStepBits + kDisparityBits - kShiftBits)) / job.grid->step;
  // Disparities within this range have no depth edge, so that no pixel is mixed.
  const auto limit = static_cast<int32_t>(still < kSurfaceStep / 2 ? still : kSurfaceStep / 2);
  // At least one row and column lie in the picture.
  const Rect rect = Extended(job.rect, job.border);
  const int32_t left = Clamp(rect.x, 0, window.width - 1);
  const int32_t right = Clamp(rect.x + rect.width, 1, window.width);
  const int32_t top = Clamp(rect.y, 0, window.height - 1);
  const int32_t bottom = Clamp(rect.y + rect.height, 1, window.height);
  for (int32_t y = top; y < bottom; ++y) {
    const int16_t* row = window.disparity.Row(y);
    for (int32_t x = left; x < right; ++x) {
      if (Abs(row[x] - job.grid->focus) > limit) return false;
    }
  }
  return true;
}

}  // namespace starfocus
