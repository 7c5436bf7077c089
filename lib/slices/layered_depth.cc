// SPDX-License-Identifier: Apache-2.0
#include "lib/slices/layered_depth.h"

#include <cstring>

#include "lib/base/fixed.h"
#include "lib/matting/mixed_pixels.h"

namespace starfocus {
namespace {

using simd::kStripColumns;

static_assert(kOcclusionViews == simd::kHiddenViews, "number of views per side");

// Sets kStripColumns pixels to kNoSurface. The pixels after the end of a row must be cleared,
// because SIMD kernels read whole vectors.
void ClearStrip(int16_t* disparity) {
  for (int32_t k = 0; k < kStripColumns; ++k) disparity[k] = kNoSurface;
}

// Converts a view to the input format of the SIMD kernel FindHidden.
simd::HiddenView HiddenViewOf(const OcclusionView& behind, int unit_bits) {
  const bool down = Abs(behind.at.v) > Abs(behind.at.u);
  const int32_t along = down ? behind.at.v : behind.at.u, across = down ? behind.at.u : behind.at.v;
  const int32_t size = Abs(along);
  if (behind.view == 0) return {0, 0, 0};
  const int32_t unit = ((kViewOne << unit_bits) + size / 2) / size;
  if (unit > simd::kMostUnit) return {0, 0, 0};
  const int32_t slant = (Abs(across) * (1 << simd::kSlantBits) + size / 2) / size;
  return {static_cast<int16_t>(unit), static_cast<int8_t>((down ? 2 : 0) + (along < 0 ? 1 : 0)),
          static_cast<int16_t>(across < 0 ? -slant : slant)};
}

// Copies the disparity and the colour of a hidden surface of a pixel to another hidden surface.
void CopyHidden(size_t at, int from, int to, LayeredDepth* surfaces) {
  surfaces->disparity[to][at] = surfaces->disparity[from][at];
  for (size_t sample = at; sample < 3 * surfaces->plane; sample += surfaces->plane) {
    surfaces->rgb[to][sample] = surfaces->rgb[from][sample];
  }
}

class SurfaceFinder {
 public:
  SurfaceFinder(const simd::Kernels& kernels, const Input& input, const BlockPixels& field,
                LayeredDepth* surfaces)
      : kernels_(kernels),
        input_(input),
        field_(field),
        layer_(field.layer),
        surfaces_(*surfaces),
        unit_(int32_t{1} << (kDisparityBits + layer_)),
        step_(kDepthEdge << layer_) {
    for (int side = 0; side < kSideCount; ++side) {
      for (int k = 0; k < kOcclusionViews; ++k) {
        views_[side][k] = HiddenViewOf(input.occlusion_views.on[side][k], kDisparityBits + layer_);
      }
    }
  }

  void Find() {
    const int32_t height = surfaces_.height;
    FindRange();
    for (int32_t y = 0; y < height; ++y) FindEdgesOfRow(y);
    StartColumns(height - 1, 2);
    for (int32_t y = height - 2; y >= 0; --y) FindEdgesOfColumns(y, y + 1, 2);
    StartColumns(0, 3);
    for (int32_t y = 1; y < height; ++y) FindEdgesOfColumns(y, y - 1, 3);
    // FindCopies reads the corner above the first pixel of row 1, which gets no copy.
    surfaces_.disparity[0][-1] = surfaces_.disparity[0][0];
    surfaces_.repeats = false;
    for (int32_t y = 0; y < height; ++y) FindRow(y);
  }

 private:
  void FindRange() {
    simd::DisparityRange ranges[kMaxStrips];
    kernels_.FindRanges(Row(0), static_cast<size_t>(surfaces_.stride),
                        static_cast<size_t>(surfaces_.height), static_cast<size_t>(surfaces_.width),
                        ranges);
    simd::DisparityRange all = ranges[0];
    for (int32_t x = kStripColumns; x < surfaces_.width; x += kStripColumns) {
      Widen(ranges[x / kStripColumns], &all);
    }
    surfaces_.low = all.low;
    surfaces_.high = all.high;
  }

  uint8_t* Edges(int side, int32_t y) const { return surfaces_.edges[side] + surfaces_.At(0, y); }
  const int16_t* Row(int32_t y) const { return surfaces_.disparity[0] + surfaces_.At(0, y); }

  // Finds the edges along a row, as the SIMD kernel FindEdges does along columns. FindEdges visits
  // every pixel; FindEdgesOfRow visits only the pixels at an edge, because edges are rare.
  void FindEdgesOfRow(int32_t y) {
    const auto stride = static_cast<size_t>(surfaces_.stride);
    std::memset(Edges(0, y), 0, stride);
    std::memset(Edges(1, y), 0, stride);
    const int16_t* row = Row(y);
    const int32_t steps = surfaces_.width - 1;
    kernels_.FindSteps(row, static_cast<size_t>(steps), static_cast<int16_t>(step_),
                       surfaces_.steps);
    const int32_t strips = (steps + kStripColumns - 1) / kStripColumns;
    for (int32_t from = (strips - 1) * kStripColumns; from >= 0; from -= kStripColumns) {
      uint32_t falls = surfaces_.steps[from / kStripColumns].falls;
      for (; falls != 0; falls &= ~(uint32_t{1} << HighestBit(falls))) {
        const int32_t x = from + HighestBit(falls);
        FollowEdge(row + x, -1, x + 1, Edges(0, y) + x);
      }
    }
    for (int32_t from = 0; from < steps; from += kStripColumns) {
      ForEachBit(surfaces_.steps[from / kStripColumns].rises, [&](int32_t k) {
        const int32_t x = from + k + 1;
        FollowEdge(row + x, 1, steps + 1 - x, Edges(1, y) + x);
      });
    }
  }

  // Writes the distance to the far side of the edge at `near` for up to `count` pixels, but not
  // beyond the next edge. Skips edges that only continue the depth of another edge
  // (kSmallStepBits). FindEdgesOfRow visits the remaining edges in order.
  void FollowEdge(const int16_t* near, int direction, int32_t count, uint8_t* distance) const {
    if (*distance != 0) return;
    const int32_t far = near[-direction];
    const int32_t farthest = Min(simd::FarthestEdge(kDisparityBits + layer_), surfaces_.high - far);
    for (int32_t k = 1, moved = 0; k <= count && moved <= farthest; ++k, moved += unit_) {
      const int32_t depth = *near - far;
      if (depth > step_ && moved <= depth) *distance = static_cast<uint8_t>(k);
      if (k == count) return;
      const int32_t change = near[direction] - *near,
                    so_far = Min(near[direction] - far, INT16_MAX);
      const bool goes_on =
          moved + unit_ <= Min(so_far, farthest) && change <= so_far >> simd::kSmallStepBits;
      if (change > step_ && !goes_on) return;
      near += direction;
      distance += direction;
    }
  }

  void StartColumns(int32_t y, int side) {
    std::memset(Edges(side, y), 0, static_cast<size_t>(surfaces_.stride));
    for (int32_t x = 0; x < surfaces_.stride; ++x) {
      surfaces_.moved[x] = INT16_MAX;
      surfaces_.behind[x] = 0;
    }
  }

  void FindEdgesOfColumns(int32_t y, int32_t beside, int side) {
    // No view sees farther behind an edge than the range of the disparities.
    const int unit_bits = kDisparityBits + layer_;
    const int32_t farthest = Min(simd::FarthestEdge(unit_bits), surfaces_.high - surfaces_.low);
    kernels_.FindEdges(Row(y), Row(beside), static_cast<int16_t>(step_), unit_bits,
                       static_cast<int16_t>(farthest), static_cast<size_t>(surfaces_.width),
                       surfaces_.moved, surfaces_.behind, Edges(side, y));
  }

  void FindRow(int32_t y) {
    const size_t at = surfaces_.At(0, y);
    simd::DepthRow row = {};
    row.disparity = Row(y);
    row.stride = surfaces_.stride;
    row.width = surfaces_.width;
    row.above = y;
    row.below = surfaces_.height - 1 - y;
    row.high = surfaces_.high;
    row.unit_bits = kDisparityBits + layer_;
    std::memcpy(row.views, views_, sizeof(views_));
    for (int side = 0; side < 4; ++side) row.edges[side] = Edges(side, y);
    uint16_t found[simd::kSurfaces - 1][kMaxStrips];
    const simd::HiddenRow hidden = {{surfaces_.disparity[1] + at, surfaces_.disparity[2] + at},
                                    {surfaces_.sources[0] + at, surfaces_.sources[1] + at},
                                    {found[0], found[1]},
                                    surfaces_.share + at};
    const uint64_t strips = kernels_.FindHidden(row, hidden);
    surfaces_.hiding[y] = strips;
    for (int behind = 1; behind < simd::kSurfaces; ++behind) {
      int32_t strip = 0;
      for (uint64_t rest = strips; rest != 0; rest >>= 1, ++strip) {
        const uint32_t pixels = (rest & 1) != 0 ? found[behind - 1][strip] : 0;
        if (pixels != 0) SetColours(strip * kStripColumns, y, behind, pixels);
      }
    }
    if (y > 0 && y < surfaces_.height - 1) CloseRow(y);
  }

  // Closes surfaces at steps where two slices may move apart. The far side of each small step is
  // continued behind the pixel on the near side, with the colour of the far side (kMostCopy). With
  // these copies, the surface stays closed, however its slices move.
  void CloseRow(int32_t y) {
    // The array `moved` can be reused, because FindEdges no longer needs its content.
    int16_t* const copies = surfaces_.moved;
    uint64_t strips =
        kernels_.FindCopies(Row(y), surfaces_.stride, static_cast<size_t>(surfaces_.width),
                            static_cast<int16_t>(kLeastCopy << layer_),
                            static_cast<int16_t>(kMostCopy << layer_), copies);
    copies[0] = copies[surfaces_.width - 1] = kNoSurface;
    for (size_t x = 0; strips != 0; strips >>= 1, x += kStripColumns) {
      if ((strips & 1) != 0) CloseStrip(y, x, copies + x);
    }
  }

  void CloseStrip(int32_t y, size_t x, const int16_t* copies) {
    const size_t at = surfaces_.At(0, y) + x;
    const uint64_t bit = uint64_t{1} << (x / kStripColumns);
    if ((surfaces_.hiding[y] & bit) == 0) {  // FindHidden has not set the sources
      surfaces_.hiding[y] |= bit;
      for (uint16_t* sources : surfaces_.sources) {
        std::memset(sources + at, 0, kStripColumns * sizeof(*sources));
      }
    }
    const simd::HiddenGroup hidden = {{surfaces_.disparity[1] + at, surfaces_.disparity[2] + at},
                                      {surfaces_.sources[0] + at, surfaces_.sources[1] + at},
                                      {surfaces_.rgb[1] + at, surfaces_.rgb[2] + at},
                                      surfaces_.plane,
                                      surfaces_.share + at};
    kernels_.InsertCopies(Row(y) + x, surfaces_.stride, copies, surfaces_.rgb[0] + at, hidden);
  }

  // Sets the colour of each pixel k of a strip for which bit k of `found` is set. Adjacent pixels
  // behind one edge, which have the same disparity and source, are read together.
  void SetColours(int32_t x, int32_t y, int behind, uint32_t found) {
    const size_t at = surfaces_.At(x, y);
    const int16_t* const disparity = surfaces_.disparity[behind] + at;
    const uint16_t* const sources = surfaces_.sources[behind - 1] + at;
    for (int32_t k = 0, end = 0; found != 0; found &= ~uint32_t{0} << end) {
      k = LowestBit(found);
      end = k + 1;
      const uint32_t source = sources[k], sides = source & 15;
      if ((sides & (sides - 1)) != 0) {
        ReadMean(x + k, y, disparity[k], source, strip_ + 3 * k);
        continue;
      }
      while (end < kStripColumns && sources[end] == source && disparity[end] == disparity[k]) ++end;
      ReadSide(x + k, y, end - k, disparity[k], source, LowestBit(sides), strip_ + 3 * k);
    }
    kernels_.Deinterleave(strip_, kStripColumns, surfaces_.plane, surfaces_.rgb[behind] + at);
  }

  // Reads the mean of the colours that the sources of a hidden pixel on several sides provide.
  void ReadMean(int32_t x, int32_t y, int16_t disparity, uint32_t source, int16_t* to) {
    int32_t sums[3] = {0, 0, 0}, count = 0;
    ForEachBit(source & 15, [&](int32_t side) {
      int16_t shown[3];
      ReadSide(x, y, 1, disparity, source, side, shown);
      for (int c = 0; c < 3; ++c) sums[c] += shown[c];
      ++count;
    });
    for (int c = 0; c < 3; ++c) to[c] = static_cast<int16_t>((sums[c] + count / 2) / count);
  }

  // Reads the colours of `count` hidden pixels from (x, y) of the field on, which all have this
  // disparity and source (the format of FindHidden).
  void ReadSide(int32_t x, int32_t y, int32_t count, int16_t disparity, uint32_t source,
                int32_t side, int16_t* to) {
    const auto distance = static_cast<int32_t>(source >> simd::kSourceDistance);
    if (distance != 0) {  // no view shows the pixels
      surfaces_.repeats = true;
      std::memcpy(to, field_.Rgb(x + kSides[side][0] * distance, y + kSides[side][1] * distance),
                  3 * static_cast<size_t>(count) * sizeof(*to));
      return;
    }
    const OcclusionView& behind =
        input_.occlusion_views.on[side][source >> (simd::kSourceSecond + side) & 1];
    // Returns the movement along one axis from the centre view to a view at `position`, in pixels
    // of the layer with kShiftBits.
    const auto moved = [&](int32_t position) {
      return ScaledByView(position, disparity, kViewBits + kDisparityBits - kShiftBits + layer_);
    };
    const CapturedLine line = {(field_.x + x) * kShiftOne - moved(behind.at.u),
                               (field_.y + y) * kShiftOne - moved(behind.at.v), 1, 0};
    ReadCaptured(input_, layer_, behind.view, line, count, to);
  }

  const simd::Kernels& kernels_;
  const Input& input_;
  const BlockPixels& field_;
  const int layer_;
  LayeredDepth& surfaces_;
  // disparity of a point that moves by one pixel of the layer in a view at distance 1
  const int32_t unit_;
  const int32_t step_;  // largest step between pixels that is not a depth edge
  simd::HiddenView views_[kSideCount][kOcclusionViews];
  int16_t strip_[3 * kStripColumns + simd::kPadding / sizeof(int16_t)] = {};  // colours of a strip
};

// Smallest difference of disparity (kDisparityBits) between the near surface and a hidden surface
// of a thin structure. Hidden surfaces with a smaller difference are dropped, because they are not
// opaque but other strands of the thin structure. Copies close a surface, and stay.
constexpr int32_t kSameStructure = 4 << kDisparityBits;

// Returns true if a pixel has a copy (kMostCopy), which is always its first hidden surface.
bool HasCopy(const LayeredDepth& surfaces, size_t at) {
  return surfaces.disparity[1][at] != kNoSurface && surfaces.sources[0][at] == 0;
}

void DropStrands(const SplitPixel& pixel, LayeredDepth* surfaces) {
  const size_t at = surfaces->At(pixel.column, pixel.row);
  const int32_t near = surfaces->disparity[0][at];
  for (int behind = simd::kSurfaces - 1; behind > 0; --behind) {
    int16_t& disparity = surfaces->disparity[behind][at];
    if (near - disparity >= kSameStructure || (behind == 1 && HasCopy(*surfaces, at))) continue;
    disparity = kNoSurface;
  }
}

// Returns the index of the surface that FindLayeredDepth has continued behind a pixel that the near
// surface of a thin structure covers, if this surface is the far surface of the pixel. Otherwise
// returns 0. InpaintHidden continues the colours of both sides of an edge, which are more accurate
// than the far colour of the coverage map, a mean of colours that are not behind the pixel.
int ContinuedFar(const SplitPixel& pixel, const LayeredDepth& surfaces) {
  const size_t at = surfaces.At(pixel.column, pixel.row);
  if (pixel.kind != SplitPixel::kThin || pixel.share < simd::kSliceWhole) return 0;
  for (int behind = 1; behind < simd::kSurfaces; ++behind) {
    const int32_t disparity = surfaces.disparity[behind][at];
    if (surfaces.sources[behind - 1][at] >> simd::kSourceDistance != 0 && disparity != kNoSurface &&
        disparity <= pixel.far_disparity + kThinStep) {
      return behind;
    }
  }
  return 0;
}

// Moves the second hidden surface of a pixel to the place of the first one.
void DropFirstHidden(size_t at, LayeredDepth* surfaces) {
  CopyHidden(at, 2, 1, surfaces);
  surfaces->sources[0][at] = surfaces->sources[1][at];
  surfaces->disparity[2][at] = kNoSurface;
  surfaces->sources[1][at] = 0;
}

// Gives a pixel the two surfaces that it mixes. A hidden surface at most `copy_step` behind the far
// surface is a copy (kMostCopy), which the far surface replaces. The copy of a pixel inside a thin
// structure stays in front of the far surface.
void Deinterleave(const SplitPixel& pixel, int32_t copy_step, LayeredDepth* surfaces) {
  LayeredDepth& to = *surfaces;
  const size_t at = to.At(pixel.column, pixel.row);
  const bool is_thin = pixel.kind == SplitPixel::kThin;
  const bool is_closed = is_thin && pixel.share == simd::kSliceWhole && HasCopy(to, at) &&
                         to.disparity[1][at] > pixel.far_disparity;
  const int far = is_closed ? 2 : 1;
  to.hiding[pixel.row] |= uint64_t{1} << (pixel.column / static_cast<int32_t>(simd::kSliceLanes));
  to.share[at] = pixel.share;
  to.disparity[0][at] = pixel.near_disparity;
  to.high = pixel.near_disparity > to.high ? pixel.near_disparity : to.high;
  const int continued = ContinuedFar(pixel, to);
  if (continued > 0) {
    if (continued > far) DropFirstHidden(at, surfaces);
    return;
  }
  if (is_thin) {
    to.sources[0][at] = to.sources[1][at] = 0;
    to.disparity[2][at] = kNoSurface;
  } else if (pixel.far_disparity - to.disparity[1][at] > copy_step) {
    CopyHidden(at, 1, 2, surfaces);
  } else {
    to.sources[0][at] = to.sources[1][at];  // source of the surface behind the far surface
  }
  to.disparity[far][at] = pixel.far_disparity;
  to.low = pixel.far_disparity < to.low ? pixel.far_disparity : to.low;
  for (size_t c = 0; c < 3; ++c) {
    const size_t sample = c * to.plane + at;
    to.rgb[far][sample] = pixel.far.rgb[c];
    to.rgb[0][sample] = pixel.near.rgb[c];
  }
}

}  // namespace

void FindLayeredDepth(const simd::Kernels& kernels, const Input& input, const BlockPixels& field,
                      LayeredDepth* surfaces) {
  surfaces->width = field.width;
  surfaces->height = field.height;
  surfaces->stride = static_cast<int32_t>(simd::SliceSamples(static_cast<size_t>(field.width)));
  surfaces->plane = static_cast<size_t>(surfaces->stride) * static_cast<size_t>(surfaces->height);
  for (int32_t y = 0; y < field.height; ++y) {
    const size_t at = surfaces->At(0, y);
    std::memcpy(surfaces->disparity[0] + at, field.Disparity(0, y),
                static_cast<size_t>(field.width) * sizeof(int16_t));
    // The next row overwrites the cleared pixels.
    ClearStrip(surfaces->disparity[0] + at + field.width);
    kernels.Deinterleave(field.Rgb(0, y), static_cast<size_t>(field.width), surfaces->plane,
                         surfaces->rgb[0] + at);
  }
  for (int16_t* disparity : surfaces->disparity) ClearStrip(disparity + surfaces->plane);
  std::memset(surfaces->share + surfaces->plane, simd::kSliceWhole, simd::kSliceLanes);
  SurfaceFinder(kernels, input, field, surfaces).Find();
}

void SplitMixedPixels(const Input& input, const ViewGrid& grid, const BlockPixels& field,
                      LayeredDepth* surfaces) {
  const auto apply = [](const SplitPixel& pixel, int32_t step, void* data) {
    auto* const to = static_cast<LayeredDepth*>(data);
    if (pixel.kind == SplitPixel::kOneSurface) {
      DropStrands(pixel, to);
    } else {
      Deinterleave(pixel, step, to);
    }
  };
  SplitPixels(input, grid, field, apply, surfaces);
}

void RemoveFocusRange(const FocusRange& focus, LayeredDepth* surfaces) {
  if (focus.IsSingle()) return;
  const auto remove = [&](int16_t* disparity, int32_t count) {
    for (int32_t k = 0; k < count; ++k) disparity[k] = focus.WithoutRange(disparity[k]);
  };
  for (int32_t y = 0; y < surfaces->height; ++y) {
    const size_t row = surfaces->At(0, y);
    remove(surfaces->disparity[0] + row, surfaces->width);
    for (int behind = 1; behind < simd::kSurfaces; ++behind) {
      int16_t* strip = surfaces->disparity[behind] + row;
      for (uint64_t rest = surfaces->hiding[y]; rest != 0; rest >>= 1, strip += kStripColumns) {
        if ((rest & 1) != 0) remove(strip, kStripColumns);
      }
    }
  }
  surfaces->low = focus.WithoutRange(surfaces->low);
  surfaces->high = focus.WithoutRange(surfaces->high);
}

}  // namespace starfocus
