// SPDX-License-Identifier: Apache-2.0
// Loads the views around a tile, and marks the labels that are hidden in each view.
#include <algorithm>

#include "lib/base/fixed.h"
#include "lib/depth/sweep.h"
#include "lib/io/image.h"

namespace starfocus {
namespace {

// Splits a row of the picture into rows of the planes. Beyond the left and right ends of the
// picture, the outermost pixels are repeated.
void DeinterleavePictureRow(const uint8_t* row, int32_t picture_width, const TileViews& views,
                            const simd::DepthKernels& kernels, uint8_t* out) {
  const auto stride = static_cast<int32_t>(views.stride);
  const int32_t first = Clamp(-views.left, 0, stride);
  const int32_t last = Clamp(picture_width - views.left, first, stride);
  kernels.DeinterleaveRow(row + 3 * (views.left + first), static_cast<size_t>(last - first),
                          views.stride, out + first);
  for (size_t c = 0; c < 3; ++c, out += stride) {
    std::fill_n(out, first, row[c]);
    std::fill(out + last, out + stride, row[3 * static_cast<size_t>(picture_width - 1) + c]);
  }
}

// Makes the planes of a view for the fractions of a pixel in all its phases. The planes are stored
// consecutively from `out` on.
void MakePlanes(const Plane<const uint8_t>& picture, const ViewPhases& phases,
                const SweepSetup& setup, const simd::DepthKernels& kernels, const TileViews& views,
                uint8_t* out) {
  // `stride` is larger than `count`, because interpolation reads samples after the end of a row. No
  // label moves a pixel to a sample after the first `count` samples.
  const size_t stride = views.stride, count = stride - simd::kSliceLanes;
  constexpr int32_t kFraction = kMoveOne - 1;
  for (int32_t row = 0; row <= views.rows; ++row) {
    uint8_t* next = views.split + static_cast<size_t>(row % 2) * 3 * stride;
    const int32_t y = Clamp(views.top + row, 0, setup.height - 1);
    DeinterleavePictureRow(picture.Row(y), setup.width, views, kernels, next);
    if (row == 0) continue;
    const uint8_t* here = views.split + static_cast<size_t>((row - 1) % 2) * 3 * stride;
    for (int32_t k = 0; k < phases.count; ++k) {
      for (size_t c = 0; c < 3; ++c) {
        uint8_t* to = out + (3 * static_cast<size_t>(k) + c) * views.plane +
                      static_cast<size_t>(row - 1) * stride;
        kernels.InterpolateRow(here + c * stride, next + c * stride,
                               phases.move[k].across & kFraction, phases.move[k].down & kFraction,
                               count, to);
      }
    }
  }
}

// Returns the part of the planes' rectangle that lies in the picture.
Rect PartInside(const SweepSetup& setup, const TileViews& views) {
  return Clipped({views.left, views.top, static_cast<int32_t>(views.stride), views.rows},
                 setup.width, setup.height);
}

// Returns the number of labels that a pixel at disparity d hides. The hidden labels are always the
// lowest labels.
uint8_t HiddenBehind(const SweepSetup& setup, int32_t d) {
  const int32_t beyond = Max(d - kSurfaceDepth - setup.low, 0) + setup.step - 1;
  // Nearly all setups have the step kLabelStep. A division by a constant is a shift.
  const int32_t labels = setup.step == kLabelStep ? beyond / kLabelStep : beyond / setup.step;
  return static_cast<uint8_t>(Min(labels, setup.labels));
}

// Marks the labels that the pixels of a map in row y of `from` hide in the part `inside` of a view.
// `hidden` is the pixel of the view at the first pixel of `inside`; its rows are `stride` apart.
// kAcross is false if the view does not move horizontally, and kDown is false if the view does not
// move vertically. If kAcross or kDown is false, the compiler removes the computation of this
// movement.
template <bool kAcross, bool kDown>
void HideBehindRow(const SweepSetup& setup, const SideView& view, const int16_t* map, int32_t y,
                   const Rect& from, const Rect& inside, size_t stride, uint8_t* hidden) {
  const auto columns = static_cast<uint32_t>(inside.width);
  const auto rows = static_cast<uint32_t>(inside.height);
  const int16_t* disparity = map + setup.At(0, y);
  int32_t last = setup.low;
  uint8_t behind = HiddenBehind(setup, last);
  for (int32_t x = from.x; x < from.x + from.width; ++x) {
    const int32_t d = disparity[x];
    const int32_t across = kAcross ? WholeMoveBy(view.at.u, d) : 0;
    const int32_t down = kDown ? WholeMoveBy(view.at.v, d) : 0;
    const auto column = static_cast<uint32_t>(x + across - inside.x);
    const auto row = static_cast<uint32_t>(y + down - inside.y);
    if ((kAcross && column >= columns) || (kDown && row >= rows)) continue;
    if (d != last) behind = HiddenBehind(setup, last = d);
    uint8_t& here = hidden[row * stride + column];
    here = std::max(here, behind);
  }
}

// Returns `rect` extended by the reach of the setup, along each axis on which the view moves.
// Pixels of `rect` can only move to pixels of the result, and only pixels of the result can hide
// pixels of `rect`.
Rect WithReach(const SweepSetup& setup, const SideView& view, const Rect& rect) {
  const Rect across = Widened(setup, rect, view.at.u != 0 ? setup.reach : 0);
  const Rect down = Widened(setup, rect, view.at.v != 0 ? setup.reach : 0);
  return {across.x, down.y, across.width, down.height};
}

}  // namespace

TileViews TakeTileViews(const SweepSetup& setup, const Rect& bordered, Arena* arena) {
  const auto width = static_cast<size_t>(bordered.width),
             height = static_cast<size_t>(bordered.height);
  const auto beyond = 2 * static_cast<size_t>(setup.reach) + 1;
  TileViews views = {};
  views.stride = simd::SliceSamples(width + beyond) + simd::kPadding;
  views.plane = views.stride * (height + beyond);
  views.rgb = arena->Take<uint8_t>(views.plane, 3 * (static_cast<size_t>(setup.AllPhases()) + 1));
  views.split = arena->Take<uint8_t>(views.stride, 2 * 3);
  views.hidden = arena->Take<uint8_t>(views.plane, static_cast<size_t>(setup.side_views));
  return views;
}

void LoadTileViews(const SweepSetup& setup, const starfocus_light_field& light_field,
                   const Rect& bordered, const simd::DepthKernels& kernels, TileViews* views) {
  views->left = bordered.x - setup.reach;
  views->top = bordered.y - setup.reach;
  views->rows = bordered.height + 2 * setup.reach + 1;
  ViewPhases whole;  // The centre view does not move.
  whole.count = 1;
  MakePlanes(RowsOf(light_field.views[0]), whole, setup, kernels, *views, views->rgb);
  uint8_t* planes = views->rgb + 3 * views->plane;
  for (int32_t k = 0; k < setup.side_views; ++k) {
    const SideView& side = setup.side[k];
    const ViewPhases phases = setup.PhasesOf(side);
    MakePlanes(RowsOf(light_field.views[side.index]), phases, setup, kernels, *views, planes);
    planes += 3 * static_cast<size_t>(phases.count) * views->plane;
  }
}

void FindMoves(const SweepSetup& setup, const TileViews& views, simd::ViewMove* moves) {
  const auto stride = static_cast<int32_t>(views.stride);
  const auto plane = static_cast<int32_t>(views.plane);
  int32_t first = 1;  // index of the view's first set of planes
  for (int32_t k = 0; k < setup.side_views; ++k) {
    const ViewPhases phases = setup.PhasesOf(setup.side[k]);
    for (int32_t l = 0; l < setup.labels; ++l) {
      const LabelMove move = setup.MoveOf(setup.side[k], l);
      const int32_t planes = 3 * (first + phases.slot[move.phase]);
      moves[l * setup.side_views + k] = {
          planes * plane + (move.down >> kMoveBits) * stride + (move.across >> kMoveBits),
          k * plane + WholeMove(move.down) * stride + WholeMove(move.across)};
    }
    first += phases.count;
  }
}

void MarkOutside(const SweepSetup& setup, TileViews* views) {
  const Rect inside = PartInside(setup, *views);
  views->ends = inside.height < views->rows || static_cast<size_t>(inside.width) < views->stride;
  views->all_seen = !views->ends;
  const auto rows = static_cast<size_t>(views->rows);
  for (int32_t view = 0; view < setup.side_views; ++view) {
    uint8_t* hidden = views->hidden + static_cast<size_t>(view) * views->plane;
    std::fill_n(hidden, rows * views->stride, simd::kViewEnds);
    for (int32_t y = inside.y; y < inside.y + inside.height; ++y) {
      std::fill_n(hidden + views->At(inside.x, y), inside.width, uint8_t{0});
    }
  }
}

void MarkHiddenInMaps(const SweepSetup& setup, const int16_t* side_maps, TileViews* views) {
  MarkOutside(setup, views);
  views->all_seen = false;
  const Rect inside = PartInside(setup, *views);
  for (int32_t k = 0; k < setup.side_views; ++k) {
    const int16_t* map = side_maps + ptrdiff_t{k} * setup.width * setup.height;
    uint8_t* hidden = views->hidden + static_cast<size_t>(k) * views->plane;
    for (int32_t y = inside.y; y < inside.y + inside.height; ++y) {
      const int16_t* disparity = map + setup.At(inside.x, y);
      uint8_t* to = hidden + views->At(inside.x, y);
      for (int32_t x = 0; x < inside.width; ++x) to[x] = HiddenBehind(setup, disparity[x]);
    }
  }
}

void MarkHidden(const SweepSetup& setup, const int16_t* map, const Rect& bordered,
                TileViews* views) {
  MarkOutside(setup, views);
  views->all_seen = false;
  for (int32_t k = 0; k < setup.side_views; ++k) {
    const SideView& view = setup.side[k];
    const Rect inside = WithReach(setup, view, bordered), from = WithReach(setup, view, inside);
    uint8_t* hidden =
        views->hidden + static_cast<size_t>(k) * views->plane + views->At(inside.x, inside.y);
    const auto hide = view.at.v == 0   ? HideBehindRow<true, false>
                      : view.at.u == 0 ? HideBehindRow<false, true>
                                       : HideBehindRow<true, true>;
    for (int32_t y = from.y; y < from.y + from.height; ++y) {
      hide(setup, view, map, y, from, inside, views->stride, hidden);
    }
  }
}

}  // namespace starfocus
