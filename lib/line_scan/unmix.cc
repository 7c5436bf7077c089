// SPDX-License-Identifier: Apache-2.0
// Separates boundary pixels for line scans.
#include "lib/line_scan/line_scan.h"
#include "lib/matting/mixed_pixels.h"

namespace starfocus {
namespace {

constexpr int32_t kShareOne = 1 << kShareBits;

// Largest blur radius of a sharp surface, kShiftBits. From a blur radius of 3 pixels on, where the
// paper's subsampled layers begin, no outline is visible (docs/constants.md).
constexpr int32_t kSharp = 2 * kShiftOne;

// Returns the part of the near surface (kShiftBits) that is removed from a mixed pixel; negative
// values count as 0. The result is 1 if the far blur radius is at most kSharp and the near blur
// radius is larger by at least one pixel.
int32_t StrengthOf(int32_t near_radius, int32_t far_radius) {
  return Min(Min(near_radius - far_radius, kSharp + kShiftOne - far_radius), kShiftOne);
}

// Returns the part of a pixel (kShareBits) that the far colour replaces. At full strength, the
// result is 1 if the share of the nearer surface is at least one half. Pixels with a smaller share
// are replaced only in part, because most of the removed light would be missing from the nearer
// surface beyond the edge. A smaller `strength` reduces the result where no outline would be
// visible.
int32_t AmountOf(int32_t share, int32_t strength) {
  return (Min(2 * share, kShareOne) * strength + kShiftOne / 2) >> kShiftBits;
}

// Writes the colour of the far surface at pixel (x, y): the mean over the adjacent depth edges,
// weighted by the share of the nearer surface.
void Unmix(const CentreView& centre, const ViewGrid& grid, int32_t x, int32_t y, int16_t* out) {
  const Colour mixed = centre.ColourAt(x, y);
  const int32_t disparity = centre.Disparity(x, y);
  const auto radius = [&](int32_t of) { return Abs(grid.Shift(grid.Move(grid.n()), of)); };
  int64_t sums[3] = {0, 0, 0}, shares = 0;
  for (int side = 0; side < kSideCount; ++side) {
    const int32_t near = centre.Disparity(x + kSides[side][0], y + kSides[side][1]);
    if (near - disparity <= kSurfaceStep) continue;
    const int32_t strength = StrengthOf(radius(near), radius(disparity));
    if (strength <= 0) continue;
    const Mixture mixture =
        FindMixture(centre, x, y, side, disparity, near, kSurfaceStep, kPaperContrastFade);
    const int64_t weight = int64_t{mixture.share} * AmountOf(mixture.share, strength);
    for (int c = 0; c < 3; ++c) sums[c] += weight * (mixture.far[c] - mixed[c]);
    shares += mixture.share;
  }
  if (shares == 0) return;
  const int64_t unit = shares * kShareOne;
  for (int c = 0; c < 3; ++c) {
    out[c] = static_cast<int16_t>(
        Checked(ranges::kUnmixed, (mixed[c] * unit + sums[c] + unit / 2) / unit));
  }
}

}  // namespace

void UnmixEdges(const simd::Kernels& kernels, const Input& input, const ViewGrid& grid,
                BlockPixels* field) {
  if (field->layer != 0 || input.views == 1) return;
  const CentreView centre(input);
  ForEachBesideEdge(kernels, input, *field, kSurfaceStep, [&](int32_t column, int32_t row) {
    Unmix(centre, grid, field->x + column, field->y + row, field->Rgb(column, row));
  });
}

}  // namespace starfocus
