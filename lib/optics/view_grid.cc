// SPDX-License-Identifier: Apache-2.0
#include "lib/optics/view_grid.h"

namespace starfocus {
namespace {

// Spread of a run, which is a sequence of adjacent pixels: largest difference between the shifts of
// the pixels, in pixels (kShiftBits). Rendering a run with one shift misplaces the pixels of the
// run by at most half the spread, in any view. Halving the spread brings no improvement
// (docs/constants.md).
constexpr int32_t kRunSpread = kShiftOne / 4;

}  // namespace

ViewGrid MakeViewGrid(const ViewWeights& aperture, const FocusRange& focus, double aperture_radius,
                      int layer, bool has_half_views) {
  ViewGrid grid;
  grid.aperture = aperture;
  grid.focus = focus;
  const double step = aperture_radius * (int64_t{1} << kStepBits);
  grid.step = RoundShift(static_cast<int64_t>(step) << 1, 1 + layer);
  if (grid.step < 1) grid.step = 1;
  grid.layer = layer;
  if (has_half_views) {
    while (grid.half_views < grid.n() && 2 * (grid.half_views + 1) * aperture_radius <= grid.n()) {
      ++grid.half_views;
    }
  }
  // A run covers a disparity range of at most spread / (u_t / 2^layer), and ends at every depth
  // edge.
  const int64_t spread =
      (int64_t{kRunSpread} << (kStepBits + kDisparityBits - kShiftBits)) / grid.step;
  grid.spread = static_cast<int32_t>(spread < kSurfaceStep ? spread : kSurfaceStep);
  return grid;
}

}  // namespace starfocus
