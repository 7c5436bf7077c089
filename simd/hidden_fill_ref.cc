// SPDX-License-Identifier: Apache-2.0
#include "simd/hidden_fill.h"
#include "simd/samples.h"

namespace starfocus::simd::reference {
namespace {

bool IsHiding(uint64_t hiding, size_t n) { return (hiding >> (n / kSliceLanes) & 1) != 0; }

// Returns the index of the farthest surface at pixel n.
int FarthestOf(const SurfaceRow& surfaces, size_t n) {
  int farthest = 0;
  for (int k = 1; k < kSurfaces && IsHiding(surfaces.hiding, n); ++k) {
    const int16_t disparity = surfaces.disparity[k][n];
    if (disparity != kNoSurface && disparity < surfaces.disparity[farthest][n]) farthest = k;
  }
  return farthest;
}

}  // namespace

int32_t TakeFarthest(const SourcedRow& row, size_t count, const FarRow& far) {
  int32_t most = 0;
  for (size_t n = 0; n < SliceSamples(count); ++n) {
    const int farthest = FarthestOf(row.surfaces, n);
    const uint8_t share = row.surfaces.share[n];
    const bool parted = share != kSliceWhole && share != kSliceEnd;
    const int found = farthest - (parted ? 1 : 0);
    const int source = found > 0 ? row.source[found - 1][n] : 0;
    const int distance = source >> kSourceDistance;
    far.source[n] = static_cast<uint16_t>(distance > 0 ? source : 0);
    far.disparity[n] = row.surfaces.disparity[farthest][n];
    for (size_t c = 0; c < 3; ++c) {
      far.rgb[c * far.plane + n] = row.surfaces.rgb[farthest][c * row.surfaces.plane + n];
    }
    most = distance > most ? distance : most;
  }
  return most;
}

void SmoothFar(const FarRows& rows, int16_t unit, int32_t step, size_t count, int16_t* rgb) {
  struct Neighbour {
    int row;
    ptrdiff_t across;
  };
  const Neighbour neighbours[4] = {{1, -step}, {1, step}, {0, 0}, {2, 0}};
  for (size_t n = 0; n < SliceSamples(count); ++n) {
    if (2 * (rows.source[n] >> kSourceDistance) < step) continue;
    for (size_t c = 0; c < 3; ++c) {
      const size_t at = c * rows.plane + n;
      const int16_t here = rows.rgb[1][at];
      int32_t colours[4];
      for (int k = 0; k < 4; ++k) {
        const Neighbour& next = neighbours[k];
        const int16_t disparity = rows.disparity[next.row][static_cast<ptrdiff_t>(n) + next.across];
        const int16_t less = Saturated(rows.disparity[1][n] - disparity);
        const bool same = less <= unit && less >= -unit;
        colours[k] = same ? rows.rgb[next.row][static_cast<ptrdiff_t>(at) + next.across] : here;
      }
      const int32_t around = Mean(Mean(colours[0], colours[1]), Mean(colours[2], colours[3]));
      rgb[at] = static_cast<int16_t>(Mean(here, around));
    }
  }
}

void PutFarthest(const FarRow& far, const int16_t* disparity, uint64_t hiding, size_t plane,
                 int16_t* rgb) {
  for (size_t n = 0; n < 64 * kSliceLanes; ++n) {
    if (!IsHiding(hiding, n) || far.source[n] == 0 || disparity[n] != far.disparity[n]) continue;
    for (size_t c = 0; c < 3; ++c) rgb[c * plane + n] = far.rgb[c * far.plane + n];
  }
}

}  // namespace starfocus::simd::reference
