// SPDX-License-Identifier: Apache-2.0
// Defines the parameters of an estimate of disparities: the labels, the views in the order of the
// SIMD kernels, and the tiles that jobs process.
#ifndef STARFOCUS_LIB_DEPTH_SETUP_H_
#define STARFOCUS_LIB_DEPTH_SETUP_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/config.h"
#include "lib/base/fixed.h"
#include "lib/base/geometry.h"
#include "lib/optics/view_set.h"
#include "starfocus/depth.h"

namespace starfocus {

// Sides of tiles are between 0.5 and 1.5 times kTileSide. Pixels within kTileBorder of a tile
// influence the tile's result. Paths from pixels farther away have hardly any effect.
inline constexpr int32_t kTileSide = 256, kMostTileSide = 3 * kTileSide / 2;
inline constexpr int32_t kTileBorder = 32;
// Border of the tiles of a repair. Because of the given map, a smaller border than kTileBorder is
// sufficient.
inline constexpr int32_t kRepairBorder = 12;

inline constexpr int32_t kLabelStep = 1 << (kDisparityBits - 1);  // half a pixel
inline constexpr int32_t kMostLabels = 129;
inline constexpr int32_t kMostSideViews = STARFOCUS_MAX_VIEWS - 1;

// A captured side view.
struct SideView {
  int32_t index;
  ViewPosition at;
};

// Each label shifts a side view by whole pixels and by a fraction of a pixel. The fractions of all
// labels differ by multiples of a quarter pixel, so there are at most kMostPhases fractions.
inline constexpr int32_t kMostPhases = 16;

// A shift of a side view, in 1/128 pixel, and the index of its fraction among the fractions of all
// labels (ViewPhases::slot).
struct LabelMove {
  int32_t across, down;
  int32_t phase;  // [0, kMostPhases)
};

// The fractions of a pixel by which the labels shift a side view.
struct ViewPhases {
  int32_t count = 0;
  // Number of a phase among the phases that labels use, or -1 if no label uses the phase.
  int8_t slot[kMostPhases] = {};
  LabelMove move[kMostPhases] = {};  // One label's shift for each slot.
};

// The eight directions between neighbouring pixels or views, in the order of their angles. Every
// second direction lies along an axis.
inline constexpr int8_t kEightDirections[8][2] = {{1, 0},  {1, 1},   {0, 1},  {-1, 1},
                                                  {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};

// Largest number of sides (SweepSetup::sides).
inline constexpr int32_t kMostSides = 8;

struct SweepSetup {
  int32_t width, height;
  // Disparity of label 0, and difference between the disparities of adjacent labels, in fixed point
  // (kDisparityBits). The difference is a multiple of half a pixel.
  int32_t low, step;
  int32_t labels;
  int32_t reach;  // largest movement, in pixels, of a point from the centre view to a side view,
                  // plus one
  int32_t side_views;
  SideView side[kMostSideViews];
  // If the views have the positions of starfocus_view_position, the views at full distance from the
  // centre come first, and views at one distance are in the order of their angles. At other
  // positions, `arms` is 0.
  int32_t arms, rings;
  // At other positions: masks of the side views whose directions differ by less than a right angle
  // from one direction. The first sweep assumes that the views of one mask see a pixel.
  uint16_t sides[kMostSides];
  int32_t side_count;
  int32_t directions;     // Number of directions of paths: 4 or 8.
  bool repairs;           // True to repair a given map, false to estimate a new one.
  int32_t columns, rows;  // Numbers of tiles; odd, so that mirrored pictures have mirrored tiles.

  // Returns true if all side views lie on one side of the centre view, as in a stereo pair.
  bool one_sided() const { return side_count == 1; }
  // Returns the index of pixel (x, y) in a map of the picture's size.
  size_t At(int32_t x, int32_t y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
  }
  // Returns the disparity of label l.
  int32_t Disparity(int32_t l) const { return low + l * step; }
  // Returns the shift of a side view at label l. The difference between the shifts of labels l and
  // 0 is rounded to quarter pixels, which is exact for the positions of starfocus_view_position.
  LabelMove MoveOf(const SideView& view, int32_t l) const;
  ViewPhases PhasesOf(const SideView& view) const;
  // Returns the sum of the numbers of phases over all side views.
  int32_t AllPhases() const;
};

// Returns the setup for a valid configuration of an estimate or, if `repairs` is true, of a repair.
SweepSetup MakeSetup(const FullConfig& config, bool repairs);

// Returns a setup with every second label of `setup` and with half of the paths. The last label of
// the coarse setup does not exceed the last label of `setup`. The first sweep of a repair uses the
// coarse setup, because the first sweep only determines which surfaces hide other surfaces.
SweepSetup CoarseSetup(const SweepSetup& setup);

// Returns the number of tiles into which `length` pixels are divided. The number is odd, and each
// tile is between 0.5 and 1.5 times `side` long.
int32_t TilesAlong(int32_t length, int32_t side);
// Returns the first pixel of tile k if `length` pixels are divided into `count` tiles. `count` must
// be odd.
int32_t TileBegin(int32_t length, int32_t count, int32_t k);

// Returns the rectangle of tile `index`; `index` is in [0, columns * rows).
Rect TileOf(const SweepSetup& setup, int32_t index);
// Returns the rectangle that is swept for tile `index`, which is the tile extended by the border of
// the setup.
Rect WithBorder(const SweepSetup& setup, int32_t index);
// Returns the rectangle enlarged by `border` on all sides and clipped to the picture.
inline Rect Widened(const SweepSetup& setup, const Rect& rect, int32_t border) {
  return Clipped(Extended(rect, {border, border, border, border}), setup.width, setup.height);
}

// Fractional bits of the movements of pixels between views.
inline constexpr int32_t kMoveBits = 7, kMoveOne = 1 << kMoveBits;

// Returns -position * d in pixels with `fraction_bits` fractional bits, by default in 1/128 pixel.
// Halves are rounded away from zero.
inline int32_t MoveBy(int32_t position, int32_t d, int32_t fraction_bits = kMoveBits) {
  const int32_t bits = kViewBits + kDisparityBits - fraction_bits;
  const int32_t move = -position * d;
  return (move + (1 << (bits - 1)) - (move < 0 ? 1 : 0)) >> bits;
}
// Returns the horizontal or vertical movement of a point of disparity d from the centre view to a
// side view, in 1/128 pixel.
inline int32_t MoveAcross(const SideView& view, int32_t d) { return MoveBy(view.at.u, d); }
inline int32_t MoveDown(const SideView& view, int32_t d) { return MoveBy(view.at.v, d); }
// Rounds a movement with `fraction_bits` fractional bits, by default in 1/128 pixel, to whole
// pixels. Halves are rounded towards zero, so that mirrored movements stay mirrored.
inline int32_t WholeMove(int32_t move, int32_t fraction_bits = kMoveBits) {
  return (move + (1 << (fraction_bits - 1)) - 1 + (move < 0 ? 1 : 0)) >> fraction_bits;
}
// Returns -position * d, rounded to whole pixels by WholeMove.
inline int32_t WholeMoveBy(int32_t position, int32_t d) {
  return WholeMove(-position * d, kViewBits + kDisparityBits);
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_SETUP_H_
