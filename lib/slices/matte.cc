// SPDX-License-Identifier: Apache-2.0
#include "lib/slices/matte.h"

#include "lib/base/fixed.h"
#include "lib/matting/boundary_pixel.h"
#include "lib/matting/coverage_map.h"

namespace starfocus {
namespace {

// A mixture is split only if its two surfaces move by more than kLeastMove relative to each other
// (kShiftBits). In measurements, a smaller limit of a quarter pixel did not improve accuracy, and a
// limit of two pixels lost 0.2 dB (docs/constants.md).
constexpr int32_t kLeastMove = kShiftOne;

class MatteFinder {
 public:
  MatteFinder(const Input& input, const ViewGrid& grid, const BlockPixels& field,
              LayeredDepth* surfaces)
      : centre_{input},
        grid_(grid),
        field_(field),
        surfaces_(*surfaces),
        step_(static_cast<int16_t>(kDepthEdge << field.layer)),
        rim_(grid.Move(grid.n())) {}

  int16_t step() const { return step_; }

  void FindPixel(int32_t column, int32_t row) {
    if (IsThin(field_.x + column, field_.y + row)) return;
    const int32_t disparity = *field_.Disparity(column, row);
    Parts parts;
    for (int side = 0; side < kSideCount; ++side) {
      const int32_t near = *field_.Disparity(column + kSides[side][0], row + kSides[side][1]);
      if (near - disparity <= step_ || !Moves(near, disparity)) continue;
      parts.nearest = Max(parts.nearest, near);
      parts.Add(MixtureAt({column, row, side, disparity, near, step_}));
    }
    const int32_t share = RoundShift(parts.most * simd::kSliceWhole, kShareBits);
    if (share > 0) Part(column, row, disparity, share, parts);
  }

 private:
  // Returns true if the coverage map splits the pixel.
  bool IsThin(int32_t x, int32_t y) const {
    const CoverageMap* const map = centre_.input.coverage;
    return map != nullptr && field_.layer == 0 &&
           map->Tile(x / kCoverageTile, y / kCoverageTile).thin != 0;
  }

  // Sums of a boundary pixel's mixtures with the nearer surfaces on all sides, each mixture
  // weighted by its share.
  struct Parts {
    int32_t shares = 0, most = 0, nearest = INT16_MIN;
    int32_t near[3] = {0, 0, 0}, far[3] = {0, 0, 0};

    void Add(const Mixture& mixture) {
      if (mixture.share == 0) return;
      shares += mixture.share;
      most = Max(most, mixture.share);
      for (int c = 0; c < 3; ++c) {
        near[c] += mixture.share * mixture.near[c];
        far[c] += mixture.share * mixture.far[c];
      }
    }
    int16_t Mean(int32_t sum) const {
      return static_cast<int16_t>(Checked(ranges::kUnmixed, (sum + shares / 2) / shares));
    }
  };

  // Returns the mixture at a boundary pixel. The coordinates in `pixel` are relative to the field.
  Mixture MixtureAt(const BoundaryPixel& pixel) const {
    if (field_.layer > 0) return MixtureOfLevel(pixel);
    BoundaryPixel of_picture = pixel;
    of_picture.x += field_.x;
    of_picture.y += field_.y;
    return FindMixture(centre_, of_picture);
  }

  // Returns the colour of a pixel of the field. Pixels outside the field have the colour of the
  // nearest pixel inside.
  Colour ColourAt(int32_t column, int32_t row) const {
    const int16_t* rgb =
        field_.Rgb(Clamp(column, 0, field_.width - 1), Clamp(row, 0, field_.height - 1));
    return {{rgb[0], rgb[1], rgb[2]}};
  }
  int32_t DisparityAt(int32_t column, int32_t row) const {
    return *field_.Disparity(Clamp(column, 0, field_.width - 1), Clamp(row, 0, field_.height - 1));
  }

  // Returns the mixture at a pixel of a subsampled layer.
  Mixture MixtureOfLevel(const BoundaryPixel& pixel) const {
    const int32_t x = pixel.x, y = pixel.y;
    const int dx = kSides[pixel.side][0], dy = kSides[pixel.side][1];
    const Colour mixed = ColourAt(x, y);
    const bool wide = Abs(DisparityAt(x + 2 * dx, y + 2 * dy) - pixel.near) <= pixel.step;
    const Colour near = ColourAt(x + (wide ? 2 : 1) * dx, y + (wide ? 2 : 1) * dy);
    return Unmix({near, FarAt(pixel, mixed), mixed});
  }

  // Estimates the colour of the far surface of a subsampled pixel. The colour is read from the
  // captured view on the far side of the edge. If no captured view looks behind the edge, returns
  // the colour of the next pixel away from the edge.
  Colour FarAt(const BoundaryPixel& pixel, const Colour& mixed) const {
    const Input& input = centre_.input;
    const OcclusionView& look = input.occlusion_views.Last(pixel.side ^ 1);
    if (look.view == 0) {
      const int32_t x = pixel.x - kSides[pixel.side][0], y = pixel.y - kSides[pixel.side][1];
      return Abs(DisparityAt(x, y) - pixel.disparity) <= pixel.step ? ColourAt(x, y) : mixed;
    }
    const int bits = kViewBits + kDisparityBits - kShiftBits + field_.layer;
    const CapturedLine line = {
        (field_.x + pixel.x) * kShiftOne - ScaledByView(look.at.u, pixel.disparity, bits),
        (field_.y + pixel.y) * kShiftOne - ScaledByView(look.at.v, pixel.disparity, bits), 1, 0};
    Colour far;
    ReadCaptured(input, field_.layer, look.view, line, 1, far.rgb);
    return far;
  }

  bool Moves(int32_t near, int32_t far) const {
    return Abs(grid_.Shift(rim_, near) - grid_.Shift(rim_, far)) > kLeastMove;
  }

  void Part(int32_t column, int32_t row, int32_t disparity, int32_t share, const Parts& parts) {
    const size_t at = surfaces_.At(column, row);
    surfaces_.hiding[row] |= uint64_t{1} << (column / static_cast<int32_t>(simd::kSliceLanes));
    surfaces_.share[at] = static_cast<uint8_t>(share);
    // A copy of the pixel (kLeastCopy) has the colour of the mixture, so the far surface replaces
    // the copy.
    const bool has_copy = disparity - surfaces_.disparity[1][at] <= step_;
    if (has_copy) {
      surfaces_.sources[0][at] =
          surfaces_.sources[1][at];  // source of the surface behind the far surface
    } else {
      surfaces_.disparity[2][at] = surfaces_.disparity[1][at];
    }
    surfaces_.disparity[1][at] = static_cast<int16_t>(disparity);
    surfaces_.disparity[0][at] = static_cast<int16_t>(parts.nearest);
    for (size_t c = 0; c < 3; ++c) {
      const size_t sample = c * surfaces_.plane + at;
      if (!has_copy) surfaces_.rgb[2][sample] = surfaces_.rgb[1][sample];
      surfaces_.rgb[1][sample] = parts.Mean(parts.far[c]);
      surfaces_.rgb[0][sample] = parts.Mean(parts.near[c]);
    }
  }

  const CentreView centre_;
  const ViewGrid& grid_;
  const BlockPixels& field_;
  LayeredDepth& surfaces_;
  const int16_t step_;  // largest step between pixels that is not a depth edge
  const int64_t rim_;
};

}  // namespace

void FindMatte(const simd::Kernels& kernels, const Input& input, const ViewGrid& grid,
               const BlockPixels& field, LayeredDepth* surfaces) {
  MatteFinder finder(input, grid, field, surfaces);
  ForEachBesideEdge(kernels, input, field, finder.step(),
                    [&](int32_t column, int32_t row) { finder.FindPixel(column, row); });
}

namespace {

// Coverage above kMostExact counts as more than it is: pixels with a coverage of at least
// kLeastWhole belong to the near surface alone.
constexpr int32_t kMostExact = 102, kLeastWhole = (kMostExact + kWhole) / 2;
// Smallest difference of disparity (kDisparityBits) between the near surface and a hidden surface.
// Hidden surfaces with a smaller difference are dropped, because they are not opaque but other
// strands of the thin structure.
constexpr int32_t kSameStructure = 4 << kDisparityBits;

class ThinParter {
 public:
  ThinParter(const Input& input, const BlockPixels& field, LayeredDepth* surfaces)
      : map_(*input.coverage),
        is_excess_(input.captured != nullptr),
        field_(field),
        surfaces_(*surfaces) {}

  void PartPixel(int32_t x, int32_t y) {
    const size_t from = map_.At(x, y), at = surfaces_.At(x - field_.x, y - field_.y);
    if (map_.alpha[from] == kUnparted) {
      DropCopies(at);
      return;
    }
    const int32_t found = map_.alpha[from];
    const int32_t alpha = Min(found + Max(found - kMostExact, 0), kWhole);
    const FarCell& far = map_.FarAt(x, y);
    const int32_t row = y - field_.y;
    surfaces_.hiding[row] |= uint64_t{1}
                             << ((x - field_.x) / static_cast<int32_t>(simd::kSliceLanes));
    surfaces_.sources[0][at] = surfaces_.sources[1][at] = 0;
    surfaces_.disparity[2][at] = kNoSurface;
    const int16_t* const mixed = field_.Rgb(x - field_.x, row);
    const bool whole = alpha == kWhole;
    // Pixels without coverage have a near surface too, with a share of 0, so that the disparities
    // of all surfaces, and therefore the slices, do not depend on colours.
    SetDisparity(0, at, map_.near[from]);
    SetDisparity(1, at, far.disparity);
    surfaces_.share[at] = !whole           ? static_cast<uint8_t>(alpha)
                          : IsInside(x, y) ? uint8_t{simd::kSliceWhole}
                                           : simd::kSliceEnd;
    for (size_t c = 0; c < 3; ++c) {
      const size_t sample = c * surfaces_.plane + at;
      int16_t& near = surfaces_.rgb[0][sample] = mixed[c];
      int16_t& beyond = surfaces_.rgb[1][sample] =
          is_excess_ ? ExcessBehind(near, whole) : far.rgb[c];
      if (whole || is_excess_) continue;
      if (alpha > 0) near = RestOf(mixed[c], beyond, kWhole - alpha);
      // RestOf may have clipped the near surface's light. The far surface's light compensates for
      // the clipping, so that the mixture of the near and far surfaces still equals the light of
      // the pixel.
      beyond = RestOf(mixed[c], near, alpha);
    }
  }

 private:
  // Returns true if the near surface also covers the four neighbours of a pixel, so that slices on
  // both sides of a step within the surface overlap. Otherwise, the far surface would show between
  // the slices.
  bool IsInside(int32_t x, int32_t y) const {
    for (const auto& side : kSides) {
      if (IsPartial(x + side[0], y + side[1])) return false;
    }
    return true;
  }

  // Returns true if a pixel of the field has a far surface that is not hidden.
  bool IsPartial(int32_t x, int32_t y) const {
    const bool in_field = x >= Max(0, field_.x) && x < Min(field_.x + field_.width, map_.width) &&
                          y >= Max(0, field_.y) && y < Min(field_.y + field_.height, map_.height);
    return in_field && map_.Tile(x / kCoverageTile, y / kCoverageTile).thin != 0 &&
           map_.alpha[map_.At(x, y)] < kLeastWhole;
  }

  // Returns the far surface's excess (light beyond white): the excess of the whole pixel, or 0 if
  // the near surface covers the whole pixel.
  static int16_t ExcessBehind(int16_t excess, bool whole) { return whole ? int16_t{0} : excess; }

  // Returns the light of the surface that covers the rest of a mixture, if `surface` covers `part`
  // of the mixture.
  static int16_t RestOf(int32_t mixed, int32_t surface, int32_t part) {
    const int32_t rest = kWhole - part;
    const int32_t light = (mixed * kWhole - part * surface + rest / 2) / rest;
    return static_cast<int16_t>(Clamp(light, ranges::kUnmixed.low, ranges::kUnmixed.high));
  }

  void SetDisparity(int surface, size_t at, int16_t disparity) {
    surfaces_.disparity[surface][at] = disparity;
    surfaces_.low = disparity < surfaces_.low ? disparity : surfaces_.low;
    surfaces_.high = disparity > surfaces_.high ? disparity : surfaces_.high;
  }

  void DropCopies(size_t at) {
    const int32_t near = surfaces_.disparity[0][at];
    for (int behind = simd::kSurfaces - 1; behind > 0; --behind) {
      int16_t& disparity = surfaces_.disparity[behind][at];
      if (disparity != kNoSurface && near - disparity < kSameStructure) disparity = kNoSurface;
    }
  }

  const CoverageMap& map_;
  const bool is_excess_;  // true if the input's light is the excess of highlights beyond white
  const BlockPixels& field_;
  LayeredDepth& surfaces_;
};

// Calls act(x, y) for each pixel of the picture in thin tiles of the field.
template <class Act>
void ForThin(const CoverageMap& map, const BlockPixels& field, const Act& act) {
  const int32_t left = Max(0, field.x), right = Min(field.x + field.width, map.width);
  const int32_t top = Max(0, field.y), bottom = Min(field.y + field.height, map.height);
  for (int32_t y = top; y < bottom; ++y) {
    for (int32_t x = left, end; x < right; x = end) {
      end = Min(right, (x / kCoverageTile + 1) * kCoverageTile);
      if (map.Tile(x / kCoverageTile, y / kCoverageTile).thin == 0) continue;
      for (int32_t k = x; k < end; ++k) act(k, y);
    }
  }
}

}  // namespace

void TakeThinDisparities(const Input& input, BlockPixels* field) {
  if (input.coverage == nullptr || field->layer > 0) return;
  const CoverageMap& map = *input.coverage;
  ForThin(map, *field, [&](int32_t x, int32_t y) {
    const size_t from = map.At(x, y);
    const int32_t alpha = map.alpha[from];
    if (alpha == kUnparted) return;
    const bool is_near = 2 * alpha >= kWhole;
    *field->Disparity(x - field->x, y - field->y) =
        is_near ? map.near[from] : map.FarAt(x, y).disparity;
  });
}

void PartThin(const Input& input, const BlockPixels& field, LayeredDepth* surfaces) {
  if (input.coverage == nullptr || field.layer > 0) return;
  ThinParter parter(input, field, surfaces);
  ForThin(*input.coverage, field, [&](int32_t x, int32_t y) { parter.PartPixel(x, y); });
}

}  // namespace starfocus
