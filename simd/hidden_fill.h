// SPDX-License-Identifier: Apache-2.0
// SIMD kernels that inpaint surfaces that are hidden behind depth edges and that no captured view
// shows.
#ifndef STARFOCUS_SIMD_HIDDEN_FILL_H_
#define STARFOCUS_SIMD_HIDDEN_FILL_H_

#include <cstddef>
#include <cstdint>

#include "simd/layered_depth.h"
#include "simd/light.h"
#include "simd/samples.h"
#include "simd/slices.h"

namespace starfocus::simd {

// Farthest surface of each pixel of a row. The planes R, G and B are `plane` samples apart.
// `source` is 0 at pixels at which a captured view shows the farthest surface.
struct FarRow {
  int16_t* disparity;
  int16_t* rgb;
  uint16_t* source;
  size_t plane;
};

// A row of farthest surfaces, index 1, between two neighbouring rows. At both ends of the rows,
// kSliceLanes more pixels must be readable. All planes of colours are `plane` samples apart.
struct FarRows {
  const int16_t* disparity[3];
  const int16_t* rgb[3];
  size_t plane;
  const uint16_t* source;  // of row 1
  // Bit k is set if group k of kSliceLanes pixels of row 1 is processed. The other groups repeat no
  // colour.
  uint64_t strips;
  int16_t unit;  // largest difference of disparity within one surface
};

// Light, 4/255 of white, by which repeated colours may always differ (LimitFar).
inline constexpr int16_t kStreakLight = 4 << kLightBits;

namespace reference {

inline bool IsHiding(uint64_t hiding, size_t n) { return (hiding >> (n / kSliceLanes) & 1) != 0; }

// Returns the index of the farthest surface at pixel n.
inline int FarthestOf(const SurfaceRow& surfaces, size_t n) {
  int farthest = 0;
  for (int k = 1; k < kSurfaces && IsHiding(surfaces.hiding, n); ++k) {
    const int16_t disparity = surfaces.disparity[k][n];
    if (disparity != kNoSurface && disparity < surfaces.disparity[farthest][n]) farthest = k;
  }
  return farthest;
}

// Copies the farthest surfaces of a row of `count` pixels, in whole groups of kSliceLanes. Returns
// the largest distance over which a copied colour is repeated, or 0 if no colour is repeated. Bit k
// of *strips is set if group k of kSliceLanes pixels repeats a colour. The
// sources of the hidden surfaces have the format of HiddenRow: source[k] belongs to surface k + 1.
// If the first surface covers only a part of a pixel, source[0] belongs to surface 2 instead.
STARFOCUS_REFERENCE int32_t CopyFarthest(const SurfaceRow& row, const uint16_t* const* source,
                                         size_t count, const FarRow& far, uint64_t* strips) {
  int32_t most = 0;
  *strips = 0;
  for (size_t n = 0; n < SliceSamples(count); ++n) {
    const int farthest = FarthestOf(row, n);
    const uint8_t share = row.share[n];
    const bool parted = share != kSliceWhole && share != kSliceEnd;
    const int found = farthest - (parted ? 1 : 0);
    const int from = found > 0 ? source[found - 1][n] : 0;
    const int distance = from >> kSourceDistance;
    far.source[n] = static_cast<uint16_t>(distance > 0 ? from : 0);
    far.disparity[n] = row.disparity[farthest][n];
    for (size_t c = 0; c < 3; ++c) {
      far.rgb[c * far.plane + n] = row.rgb[farthest][c * row.plane + n];
    }
    most = distance > most ? distance : most;
    if (distance > 0) *strips |= uint64_t{1} << (n / kSliceLanes);
  }
  return most;
}

// Returns true if the disparity of pixel n of row 1 differs by at most rows.unit from that of the
// pixel `across` pixels beside it in row `row`.
inline bool IsSame(const FarRows& rows, size_t n, int row, ptrdiff_t across) {
  const int16_t other = rows.disparity[row][static_cast<ptrdiff_t>(n) + across];
  const int16_t less = Saturated(rows.disparity[1][n] - other);
  return less <= rows.unit && less >= -rows.unit;
}

// Smooths the colours of those pixels of a row whose colours are repeated over a distance of at
// least step / 2. Other pixels are not changed. Processes the groups rows.strips. `step` is at most
// kSliceLanes. The new colour of a pixel is the mean of its old colour and the mean of its four
// neighbours at a distance of `step` pixels. If the disparity of a neighbour differs by more than
// `unit`, the pixel itself replaces the neighbour. The mean of the neighbours is the mean of two
// means: the mean of left and right, and the mean of above and below. Each mean is rounded half up.
// Rows 0 and 2 are `step` rows above and below. Colours are light and not negative.
STARFOCUS_REFERENCE void SmoothFar(const FarRows& rows, int32_t step, int16_t* out) {
  // Left, right, above and below.
  const int row_of[4] = {1, 1, 0, 2};
  const ptrdiff_t across[4] = {-step, step, 0, 0};
  for (size_t n = 0; n < 64 * kSliceLanes; ++n) {
    if (!IsHiding(rows.strips, n) || 2 * (rows.source[n] >> kSourceDistance) < step) continue;
    for (size_t c = 0; c < 3; ++c) {
      const size_t at = c * rows.plane + n;
      const int16_t here = rows.rgb[1][at];
      int32_t colours[4];
      for (int k = 0; k < 4; ++k) {
        colours[k] = IsSame(rows, n, row_of[k], across[k])
                         ? rows.rgb[row_of[k]][static_cast<ptrdiff_t>(at) + across[k]]
                         : here;
      }
      const int32_t around = Mean(Mean(colours[0], colours[1]), Mean(colours[2], colours[3]));
      out[at] = static_cast<int16_t>(Mean(here, around));
    }
  }
}

// Limits repeated colours to the colours of two neighbours, so that no odd source shows as a
// streak: they may exceed the range of both by this range and kStreakLight. The neighbours are the
// pixels above and below if the source is on the left or right, the pixels on the left and right if
// the source is above or below. A pixel with sources in both directions, or with a neighbour whose
// disparity differs by more than `unit`, is not changed. Rows 0 and 2 are the next rows. Processes
// the groups rows.strips.
STARFOCUS_REFERENCE void LimitFar(const FarRows& rows, int16_t* out) {
  for (size_t n = 0; n < 64 * kSliceLanes; ++n) {
    if (!IsHiding(rows.strips, n)) continue;
    const bool across = (rows.source[n] & kSourceAlongRow) != 0;
    const bool down = (rows.source[n] & kSourceAlongColumn) != 0;
    if (across == down) continue;
    const int row_of[2] = {across ? 0 : 1, across ? 2 : 1};
    const ptrdiff_t beside[2] = {across ? 0 : -1, across ? 0 : 1};
    const bool same =
        IsSame(rows, n, row_of[0], beside[0]) && IsSame(rows, n, row_of[1], beside[1]);
    if (!same) continue;
    for (size_t c = 0; c < 3; ++c) {
      const size_t at = c * rows.plane + n;
      const int16_t first = rows.rgb[row_of[0]][static_cast<ptrdiff_t>(at) + beside[0]];
      const int16_t second = rows.rgb[row_of[1]][static_cast<ptrdiff_t>(at) + beside[1]];
      const int16_t low = first < second ? first : second, high = first < second ? second : first;
      const int16_t more = Saturated(high - low + kStreakLight);
      const int16_t own = rows.rgb[1][at];
      const int16_t least = Saturated(low - more), most = Saturated(high + more);
      out[at] = own < least ? least : own > most ? most : own;
    }
  }
}

// Copies the repeated colours of a row to a surface, at all pixels at which this surface is the
// farthest. `disparity` and `rgb` are the row of the surface; the planes of `rgb` are `plane`
// samples apart. Processes group c of kSliceLanes pixels if bit c of `hiding` is set.
STARFOCUS_REFERENCE void PutFarthest(const FarRow& far, const int16_t* disparity, uint64_t hiding,
                                     size_t plane, int16_t* rgb) {
  for (size_t n = 0; n < 64 * kSliceLanes; ++n) {
    if (!IsHiding(hiding, n) || far.source[n] == 0 || disparity[n] != far.disparity[n]) continue;
    for (size_t c = 0; c < 3; ++c) rgb[c * plane + n] = far.rgb[c * far.plane + n];
  }
}

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_HIDDEN_FILL_H_
