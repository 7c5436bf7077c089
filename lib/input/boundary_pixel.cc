// SPDX-License-Identifier: Apache-2.0
#include "lib/input/boundary_pixel.h"

namespace starfocus {
namespace {

// Two colours whose squared distance is less than this tell no mixture apart: eight gray levels in
// one channel. docs/constants.md has what these three were measured on.
constexpr int64_t kLeastContrast = 64;
// Up to this distance from the line between the two colours a pixel is their mixture, squared: a
// noise of three gray levels in each channel, and a sixteenth of their contrast's square.
constexpr int64_t kNoise = 27;
constexpr int64_t kContrastParts = 16;

// Returns how much of `mixed` shows `near`, the rest being `far`: kShareBits, 0 when it is no
// mixture. The far surface has the pixel's centre, so that more than 4/5 says that `far` is
// something else. The share is rounded down, so that to round it once more, to fewer bits, rounds
// what it really is.
int32_t ShareOf(const uint8_t* near, const uint8_t* far, const uint8_t* mixed) {
  int64_t along = 0, contrast = 0, distance = 0;
  for (int c = 0; c < 3; ++c) {
    const int32_t whole = near[c] - far[c], part = mixed[c] - far[c];
    along += part * whole;
    contrast += whole * whole;
    distance += part * part;
  }
  if (contrast < kLeastContrast || along <= 0 || 5 * along > 4 * contrast) return 0;
  const int64_t beside = distance * contrast - along * along;  // squared, times the contrast
  if (kContrastParts * beside > contrast * (kContrastParts * kNoise + contrast)) return 0;
  return static_cast<int32_t>((static_cast<uint32_t>(along) << kShareBits) /
                              static_cast<uint32_t>(contrast));
}

// The point of the far surface in the captured view away from the nearer one, which lies farther
// towards that there.
void ReadFar(const Window& window, const BoundaryPixel& pixel, const uint8_t* mixed, uint8_t* far) {
  if (window.reads != nullptr) ++window.reads->side_colours;
  const int dx = pixel.side[0], dy = pixel.side[1];
  const bool half = window.views == 17;
  const int32_t moved = pixel.disparity * (1 << (kShiftBits - kDisparityBits - (half ? 1 : 0)));
  const int view = CapturedView(-dx, -dy, half);
  const int32_t x = pixel.x * kShiftOne + dx * moved, y = pixel.y * kShiftOne + dy * moved;
  PrefetchCaptured(window, view, {x, y, 0, 0});
  int32_t sums[3];
  InterpolateCaptured(window, view, x, y, sums);
  // Halves are rounded towards the pixel, so that an inverted picture is decided on alike.
  constexpr int32_t kHalf = 1 << (2 * kShiftBits - 1);
  for (int c = 0; c < 3; ++c) {
    const bool up = (mixed[c] << (2 * kShiftBits)) > sums[c];
    far[c] = static_cast<uint8_t>((sums[c] + kHalf - (up ? 0 : 1)) >> (2 * kShiftBits));
  }
}

}  // namespace

Mixture FindMixture(const CentreView& centre, const BoundaryPixel& pixel) {
  const int32_t x = pixel.x, y = pixel.y;
  const int dx = pixel.side[0], dy = pixel.side[1];
  const uint8_t* mixed = centre.Colour(x, y);
  const int32_t beyond = centre.Disparity(x + 2 * dx, y + 2 * dy);
  const int pure = Abs(beyond - pixel.near) <= pixel.step ? 2 : 1;
  Mixture mixture;
  mixture.near = centre.Colour(x + pure * dx, y + pure * dy);
  ReadFar(centre.window, pixel, mixed, mixture.far);
  mixture.share = ShareOf(mixture.near, mixture.far, mixed);
  return mixture;
}

}  // namespace starfocus
