// SPDX-License-Identifier: Apache-2.0
#include "lib/matting/mixed_pixels.h"

#include "lib/io/deep.h"

namespace starfocus {
namespace {

// Number of fractional bits of colours in comparisons, in units of white / 255. Products of
// compared colours fit in 64 bits.
constexpr int kColourBits = 4;
constexpr int64_t kSquareOne = 1 << (2 * kColourBits);
// Smallest squared distance between two colours whose mixtures can be recognised: 8/255 of white in
// one channel. The measurements of kLeastContrast, kNoise and kContrastParts are in
// docs/constants.md.
constexpr int64_t kLeastContrast = 64 * kSquareOne;
// Tolerated squared distance of a mixture from the line between the two colours: noise of 3/255 of
// white in each channel, plus 1/16 of the squared contrast.
constexpr int64_t kNoise = 27 * kSquareOne;
constexpr int64_t kContrastParts = 16;
constexpr int64_t kShareOne = 1 << kShareBits;
// Smallest share at which the far colour that was read replaces the colour of the pixel completely.
constexpr int kPureParts = 16;

int64_t Limited(int64_t fade) { return fade < 0 ? 0 : fade > kShareOne ? kShareOne : fade; }

// Reads the colours of a boundary pixel and of the two surfaces beside the edge. The captured view
// on the side away from the nearer surface shows the far surface, because the nearer surface is
// shifted away from the pixel. Without such a view, the far colour is the colour of the next pixel
// away from the nearer surface, or, if that pixel is on another surface, the mixed colour, which
// gives a share of 0.
BoundaryColours ReadColours(const CentreView& centre, int32_t x, int32_t y, int side,
                            int32_t disparity, int32_t near, int32_t step) {
  const int dx = kSides[side][0], dy = kSides[side][1];
  const int pure = Abs(centre.Disparity(x + 2 * dx, y + 2 * dy) - near) <= step ? 2 : 1;
  BoundaryColours colours;
  colours.mixed = colours.far = centre.ColourAt(x, y);
  colours.near = centre.ColourAt(x + pure * dx, y + pure * dy);
  const OcclusionView& behind = centre.input().occlusion_views.Last(side ^ 1);
  if (behind.view != 0) {
    const int bits = kViewBits + kDisparityBits - kShiftBits + centre.layer();
    const CapturedLine line = {x * kShiftOne - ScaledByView(behind.at.u, disparity, bits),
                               y * kShiftOne - ScaledByView(behind.at.v, disparity, bits), 1, 0};
    ReadCaptured(centre.input(), centre.layer(), behind.view, line, 1, colours.far.rgb);
  } else if (Abs(centre.Disparity(x - dx, y - dy) - disparity) <= step) {
    colours.far = centre.ColourAt(x - dx, y - dy);
  }
  return colours;
}

// A mixture is split only if its two surfaces move by more than kLeastMove relative to each other
// (kShiftBits). In measurements, a smaller limit of a quarter pixel did not improve accuracy, and a
// limit of two pixels lost 0.2 dB (docs/constants.md).
constexpr int32_t kLeastMove = kShiftOne;

Colour MeanOf(const ColourSum<int32_t>& sum) {
  Colour mean;
  for (int c = 0; c < 3; ++c) {
    mean.rgb[c] = static_cast<int16_t>(Checked(ranges::kUnmixed, sum.Mean(c)));
  }
  return mean;
}

// Returns the light of the surface that covers the rest of a mixture, if `surface` covers `part` of
// the mixture.
int16_t RestOf(int32_t mixed, int32_t surface, int32_t part) {
  const int32_t rest = kWhole - part;
  return LimitedLight((mixed * kWhole - part * surface + rest / 2) / rest);
}

// Widens a range of colours so that it contains a colour.
void Widen(const int16_t* rgb, int32_t* low, int32_t* high) {
  for (int c = 0; c < 3; ++c) {
    low[c] = Min(low[c], rgb[c]);
    high[c] = Max(high[c], rgb[c]);
  }
}

void LimitTo(const int32_t* low, const int32_t* high, Colour* colour) {
  for (int c = 0; c < 3; ++c) {
    colour->rgb[c] = static_cast<int16_t>(Clamp(colour->rgb[c], low[c], high[c]));
  }
}

// Returns the smallest share of a near surface whose light is neither negative nor brighter than
// white, if the light of the far surface is `far`.
int32_t LeastShare(const Colour& mixed, const Colour& far) {
  int32_t least = 0;
  for (int c = 0; c < 3; ++c) {
    const int32_t more = mixed[c] - far[c];
    const int32_t most = more > 0 ? ranges::kUnmixed.high - far[c] : far[c];
    if (more != 0) least = Max(least, (Abs(more) * simd::kSliceWhole + most - 1) / most);
  }
  return least;
}

// Returns true if the disparity map shows the near surface at a split pixel.
bool ShowsNear(const Input& input, const FarLight& far, int32_t x, int32_t y) {
  return input.disparity.Row(y)[x] > far.disparity;
}

// Calls act(x, y, at) for each pixel of the picture in the field that lies in a thin tile; `at` is
// its index, CoverageMap::At(x, y).
template <class Act>
void ForEachThin(const CoverageMap& map, const BlockPixels& field, const Act& act) {
  const Rect inside = Clipped({field.x, field.y, field.width, field.height}, map.width, map.height);
  for (int32_t y = inside.y; y < inside.y + inside.height; ++y) {
    for (int32_t x = inside.x, end; x < inside.x + inside.width; x = end) {
      end = Min(inside.x + inside.width, (x / kCoverageTile + 1) * kCoverageTile);
      if (map.Tile(x / kCoverageTile, y / kCoverageTile).thin == 0) continue;
      size_t at = map.At(x, y);
      for (int32_t k = x; k < end; ++k) act(k, y, at++);
    }
  }
}

}  // namespace

CentreView::CentreView(const Input& input, const BlockPixels* field)
    : input_(input), field_(field), layer_(field != nullptr ? field->layer : 0) {
  if (field == nullptr) return;
  copied_ = Clipped({field->x, field->y, field->width, field->height}, input.width, input.height);
}

namespace {

// Returns true if a colour has a sample of at least `least`.
bool Reaches(const BoundaryColours& colours, int32_t least) {
  for (const Colour* colour : {&colours.near, &colours.far, &colours.mixed}) {
    if (Max(Max((*colour)[0], (*colour)[1]), (*colour)[2]) >= least) return true;
  }
  return false;
}

// Reads the colours at a boundary with their light beyond white. A lamp beyond white makes mixtures
// white, and so hides how little of a pixel it covers. Not inlined, because its Input of more than
// 2 KiB would lie on the stack.
[[gnu::noinline]] bool ReadBright(const Input& in, int32_t x, int32_t y, int side,
                                  int32_t disparity, int32_t near, int32_t step,
                                  BoundaryColours* bright) {
  const Input whole = DeepWholeOf(in);
  *bright = ReadColours(CentreView(whole), x, y, side, disparity, near, step);
  return Reaches(*bright, (kLightWhite >> kExcessBits) + 1);
}

}  // namespace

Mixture FindMixture(const CentreView& centre, int32_t x, int32_t y, int side, int32_t disparity,
                    int32_t near, int32_t step, int32_t contrast_fade) {
  const BoundaryColours shown = ReadColours(centre, x, y, side, disparity, near, step);
  const Input* const captured = centre.input().captured;
  BoundaryColours bright;
  if (centre.input().is_deep() && centre.layer() == 0 &&
      (captured != nullptr || Reaches(shown, kLightWhite)) &&
      ReadBright(centre.input(), x, y, side, disparity, near, step, &bright)) {
    return Unmix(bright, contrast_fade, shown);
  }
  if (captured == nullptr || centre.layer() > 0) return Unmix(shown, contrast_fade, shown);
  return Unmix(ReadColours(CentreView(*captured), x, y, side, disparity, near, step), contrast_fade,
               shown);
}

// A pixel is separated by the position of its colour relative to the line from `far` to `near`.
//
// Noise must not decide whether a pixel is split. At each limit, the share and the weight of the
// far colour, which replaces the colour of the pixel, therefore fade to 0 instead of stopping
// abruptly: from a contrast of kLeastContrast plus `contrast_fade` down to kLeastContrast, for
// shares from 13/20 to 19/20, and from 1/4 to 3/2 of the tolerated squared distance from the line.
// The far surface covers the centre of the pixel, so a larger share means that `far` is wrong. For
// shares below 1 / kPureParts, the weight also falls to 0, because the far colour differs from the
// colour of the pixel by the distance from the line.
Mixture Unmix(const BoundaryColours& light, int32_t contrast_fade, const BoundaryColours& shown) {
  const ColourLine line = ColourLineOf<kColourBits>(light.near, light.far, light.mixed);
  const int64_t along = line.along, contrast = line.contrast;
  Mixture mixture = {0, shown.near, shown.mixed};
  if (contrast <= kLeastContrast || along <= 0 || 20 * along >= 19 * contrast) return mixture;
  // The distance from the line and its limit are multiplied by `contrast`.
  const int64_t beside = kContrastParts * (line.distance * contrast - along * along);
  const int64_t limit = contrast * (kContrastParts * kNoise + contrast);
  if (2 * (beside >> kShareBits) >= 3 * (limit >> kShareBits)) return mixture;
  const int64_t share = along * kShareOne / contrast;
  const int64_t clear =
      Limited((contrast - kLeastContrast) * kShareOne / (contrast_fade * kSquareOne));
  const int64_t inside = Limited((6 * kShareOne - 4 * (beside / (limit >> kShareBits))) / 5);
  const int64_t most = Limited((19 * kShareOne - 20 * share) / 6);
  const int64_t fade = (clear * inside >> kShareBits) * most >> kShareBits;
  const int64_t weight = Limited(kPureParts * share) * fade >> kShareBits;
  mixture.share = static_cast<int32_t>(share * fade >> kShareBits);
  for (int c = 0; c < 3; ++c) {
    const int32_t change = shown.far[c] - shown.mixed[c];
    mixture.far.rgb[c] =
        static_cast<int16_t>(shown.mixed[c] + RoundShift(weight * change, kShareBits));
  }
  return mixture;
}

namespace {

// Splits the pixels of a field (SplitPixels).
class PixelSplitter {
 public:
  PixelSplitter(const Input& input, const ViewGrid& grid, const BlockPixels& field)
      : centre_(input, &field),
        grid_(grid),
        field_(field),
        rims_(field.layer == 0 && input.captured == nullptr ? input.rims : nullptr),
        map_(field.layer == 0 ? input.coverage : nullptr),
        step_(static_cast<int16_t>(kDepthEdge << field.layer)),
        rim_(grid.Move(grid.n())) {}

  void Visit(SplitVisitor visit, void* data) const {
    const Input& input = centre_.input();
    SplitPixel pixel;
    ForEachBesideEdge(*input.kernels, input, field_, step_, [&](int32_t column, int32_t row) {
      if (SplitBoundary(column, row, &pixel)) visit(pixel, step_, data);
    });
    if (rims_ != nullptr) {
      ForEachInRim([&](int32_t x, int32_t y) {
        if (SplitRim(x - field_.x, y - field_.y, &pixel)) visit(pixel, step_, data);
      });
    }
    if (map_ == nullptr) return;
    ForEachThin(*map_, field_, [&](int32_t x, int32_t y, size_t at) {
      if (HasGiven(input) && map_->alpha[at] == kUnsplit) return;
      SplitThin(x, y, at, &pixel);
      visit(pixel, step_, data);
    });
  }

 private:
  // The outline next to a pixel of its far surface: the distance to the nearest pixel of the near
  // surface, 0 if it is more than kRimWidth pixels away; the sides on which it is (one bit of
  // kSides each); and the largest disparity there.
  struct Outline {
    int32_t distance, sides, near;
  };

  // Calls act(x, y) for each pixel of the picture in the field, except its outermost pixels, that
  // lies in a patch with a rim.
  template <class Act>
  void ForEachInRim(const Act& act) const {
    const Rect inside = Clipped({field_.x + 1, field_.y + 1, field_.width - 2, field_.height - 2},
                                rims_->width, rims_->height);
    const int32_t right = inside.x + inside.width, bottom = inside.y + inside.height;
    for (int32_t y = inside.y, end; y < bottom; y = end) {
      end = Min(bottom, (y / kRimPatch + 1) * kRimPatch);
      for (int32_t x = inside.x, last; x < right; x = last) {
        last = Min(right, (x / kRimPatch + 1) * kRimPatch);
        if (!rims_->RimAt(x, y).IsEmpty()) ForPixels({x, y, last - x, end - y}, act);
      }
    }
  }

  // Splits the boundary pixel (column, row). Returns false if it is not a mixture, or if the
  // coverage map splits it.
  bool SplitBoundary(int32_t column, int32_t row, SplitPixel* pixel) const {
    const int32_t x = field_.x + column, y = field_.y + row;
    if (IsInMap(x, y)) return false;
    const int16_t disparity = *field_.Disparity(column, row);
    // Sums of the mixtures with the nearer surfaces on all sides, weighted by their shares.
    ColourSum<int32_t> nears, fars;
    int32_t nearest = INT16_MIN, most = 0;
    for (int side = 0; side < kSideCount; ++side) {
      const int32_t near = *field_.Disparity(column + kSides[side][0], row + kSides[side][1]);
      if (near - disparity <= step_ || !MoveApart(near, disparity)) continue;
      nearest = Max(nearest, near);
      const Mixture mixture =
          FindMixture(centre_, x, y, side, disparity, near, step_, kContrastFade);
      most = Max(most, mixture.share);
      nears.Add(mixture.near, mixture.share);
      fars.Add(mixture.far, mixture.share);
    }
    if (nearest == INT16_MIN) return false;
    const Input& input = centre_.input();
    const bool is_excess = input.is_excess && input.is_deep();
    int32_t share = RoundShift(most * simd::kSliceWhole, kShareBits);
    if (is_excess && most > 0) share = Max(share, 1);
    const bool is_rim = rims_ != nullptr && !rims_->RimAt(x, y).IsEmpty();
    if (share == 0 && !is_rim) return false;
    *pixel = {SplitPixel::kBoundary,
              column,
              row,
              static_cast<uint8_t>(share),
              static_cast<int16_t>(nearest),
              disparity,
              share > 0 ? MeanOf(nears) : Colour(),
              share > 0 ? MeanOf(fars) : centre_.ColourAt(x, y)};
    if (is_excess && share > 0) KeepExcess(centre_.ColourAt(x, y), share, pixel);
    if (is_rim) CleanRim(OutlineAt(x, y), pixel);
    return pixel->share > 0;
  }

  // The rounded share of a lamp would change its excess, so the brighter surface of a boundary
  // pixel has what the other surface lacks.
  static void KeepExcess(const Colour& mixed, int32_t share, SplitPixel* pixel) {
    for (int c = 0; c < 3; ++c) {
      int16_t &near = pixel->near.rgb[c], &far = pixel->far.rgb[c];
      if (near >= far) {
        near = RestOf(mixed[c], Min(far, mixed[c]), kWhole - share);
      } else if (share < kWhole) {
        far = RestOf(mixed[c], Min(near, mixed[c]), share);
      }
    }
  }

  // Splits a pixel of a contaminated rim that is not a boundary pixel. Returns false if the pixel
  // does not belong to a rim.
  bool SplitRim(int32_t column, int32_t row, SplitPixel* pixel) const {
    const int32_t x = field_.x + column, y = field_.y + row;
    if (IsInMap(x, y)) return false;
    const int16_t far = *field_.Disparity(column, row);
    for (const auto& side : kSides) {  // SplitBoundary splits boundary pixels
      if (*field_.Disparity(column + side[0], row + side[1]) - far > step_) return false;
    }
    const Outline outline = OutlineAt(x, y);
    if (outline.distance == 0) return false;
    if (!MoveApart(outline.near, far)) return false;
    *pixel = {
        SplitPixel::kBoundary, column, row, 0, static_cast<int16_t>(outline.near), far, Colour(),
        centre_.ColourAt(x, y)};
    CleanRim(outline, pixel);
    return pixel->share > 0;
  }

  // Splits pixel (x, y) of the picture, which lies in a thin tile, as the coverage map says at
  // index `from` (CoverageMap::At).
  void SplitThin(int32_t x, int32_t y, size_t from, SplitPixel* pixel) const {
    const CoverageMap& map = *map_;
    pixel->column = x - field_.x;
    pixel->row = y - field_.y;
    pixel->kind = map.alpha[from] == kUnsplit ? SplitPixel::kOneSurface : SplitPixel::kThin;
    if (pixel->kind == SplitPixel::kOneSurface) return;
    const int32_t found = map.alpha[from];
    const FarLight& patch = map.FarAt(x, y);
    const Input& input = centre_.input();
    const bool is_excess = input.captured != nullptr;
    // Noise must not change the number of surfaces, so found coverage does not decide whether a
    // pixel lies inside.
    const bool inside = HasGiven(input) ? found >= kLeastWhole && IsInside(x, y)
                                        : ShowsNear(input, patch, x, y) && IsOneSurface(x, y);
    const int32_t alpha = inside ? kWhole : Min(found + Max(found - kMostExact, 0), kWhole);
    const bool whole = alpha == kWhole;
    // Pixels without coverage have a near surface too, with a share of 0, so that the disparities
    // of all surfaces, and therefore the slices, do not depend on colours.
    pixel->near_disparity = map.near[from];
    pixel->far_disparity = patch.disparity;
    pixel->share = !whole   ? static_cast<uint8_t>(alpha)
                   : inside ? uint8_t{simd::kSliceWhole}
                            : simd::kSliceEnd;
    Colour &near = pixel->near, &far = pixel->far;
    std::memcpy(near.rgb, field_.Rgb(pixel->column, pixel->row), sizeof(near.rgb));
    far = near;
    if (whole) {
      // Excess is not divided: the near surface has all the excess of a pixel that it covers.
      if (is_excess) far = {};
      if (!is_excess) std::memcpy(far.rgb, patch.rgb, sizeof(far.rgb));
    } else if (alpha > 0 && !is_excess) {
      const Colour mixed = near;
      for (int c = 0; c < 3; ++c) {
        near.rgb[c] = RestOf(mixed[c], patch.rgb[c], kWhole - alpha);
        // RestOf may have clipped the near surface's light. The far surface's light compensates for
        // the clipping, so that the mixture of both surfaces still equals the light of the pixel.
        // If the far surface covers less than half of the pixel, it compensates only in part,
        // because it would multiply noise.
        const int32_t more = RestOf(mixed[c], near.rgb[c], alpha) - patch.rgb[c];
        const int32_t part = Min(2 * (kWhole - alpha), kWhole);
        far.rgb[c] = static_cast<int16_t>(patch.rgb[c] + RoundShift(more * part, kAlphaBits));
      }
      if (rims_ != nullptr && HasGiven(centre_.input()) &&
          std::memcmp(far.rgb, patch.rgb, sizeof(far.rgb)) != 0) {
        LimitToFar(x, y, &far);
        const int32_t share = Min(Max(alpha, LeastShare(mixed, far)), kWhole - 1);
        pixel->share = static_cast<uint8_t>(share);
        for (int c = 0; c < 3; ++c) near.rgb[c] = RestOf(mixed[c], far[c], kWhole - share);
      }
    }
    if (!whole && rims_ != nullptr && !rims_->RimAt(x, y).IsEmpty())
      CleanRim(OutlineAt(x, y), pixel);
  }

  // Returns true if two surfaces move far enough relative to each other for a split.
  bool MoveApart(int32_t near, int32_t far) const {
    return Abs(grid_.Shift(rim_, near) - grid_.Shift(rim_, far)) > kLeastMove;
  }

  // Returns true if the coverage map decides how pixel (x, y) of the picture is split. Given
  // coverage decides only on the pixels that it splits.
  bool IsInMap(int32_t x, int32_t y) const {
    if (map_ == nullptr || map_->Tile(x / kCoverageTile, y / kCoverageTile).thin == 0) return false;
    return !HasGiven(centre_.input()) || map_->alpha[map_->At(x, y)] != kUnsplit;
  }

  // Returns true if a pixel of the field has a far surface that is not hidden.
  bool IsPartial(int32_t x, int32_t y) const {
    return Contains(centre_.copied(), x, y) &&
           map_->Tile(x / kCoverageTile, y / kCoverageTile).thin != 0 &&
           map_->alpha[map_->At(x, y)] < kLeastWhole;
  }

  // Returns true if a pixel lies inside its near surface, so that slices on both sides of a step
  // within the surface must overlap. Otherwise, the far surface would show between the slices. With
  // given coverage, the near surface must cover the pixel and its eight neighbours.
  bool IsInside(int32_t x, int32_t y) const {
    return !AnyPixel(Around(x, y, 1),
                     [&](int32_t column, int32_t row) { return IsPartial(column, row); });
  }

  // Returns true if a pixel and its eight neighbours belong to one surface of the disparity map.
  bool IsOneSurface(int32_t x, int32_t y) const {
    const int32_t here = centre_.Disparity(x, y);
    return !AnyPixel(Around(x, y, 1), [&](int32_t column, int32_t row) {
      const int32_t most = (Abs(column - x) + Abs(row - y)) * kDepthEdge;
      return Abs(centre_.Disparity(column, row) - here) > most;
    });
  }

  // Limits a colour of the far surface at pixel (x, y) to the range of the far colour of the map
  // and of pixels around that the near surface does not cover.
  void LimitToFar(int32_t x, int32_t y, Colour* far) const {
    const FarLight& patch = map_->FarAt(x, y);
    int32_t low[3] = {patch.rgb[0], patch.rgb[1], patch.rgb[2]}, high[3] = {low[0], low[1], low[2]};
    ForPixels(Around(x, y, 6), [&](int32_t column, int32_t row) {
      if (!IsPartial(column, row) || map_->alpha[map_->At(column, row)] != 0) return;
      Widen(field_.Rgb(column - field_.x, row - field_.y), low, high);
    });
    LimitTo(low, high, far);
  }

  Outline OutlineAt(int32_t x, int32_t y) const {
    const int32_t here = centre_.Disparity(x, y);
    Outline outline = {0, 0, INT16_MIN};
    for (int32_t distance = 1; distance <= kRimWidth; ++distance) {
      for (int side = 0; side < kSideCount; ++side) {
        const int32_t there =
            centre_.Disparity(x + distance * kSides[side][0], y + distance * kSides[side][1]);
        if (there - here <= kRimStep) continue;
        outline = {distance, outline.sides | 1 << side, Max(outline.near, there)};
      }
      if (outline.distance != 0) break;
    }
    return outline;
  }

  // Limits a colour to the range of the clean colours beyond the rim, on the line across the
  // outline and on two lines beside it. Returns false if the far surface ends there.
  bool LimitToClean(int32_t x, int32_t y, const Outline& outline, Colour* colour) const {
    const int32_t here = centre_.Disparity(x, y);
    int32_t low[3] = {INT16_MAX, INT16_MAX, INT16_MAX}, high[3] = {0, 0, 0}, count = 0;
    ForEachBit(static_cast<uint32_t>(outline.sides), [&](int32_t side) {
      const int32_t dx = kSides[side][0], dy = kSides[side][1];
      for (int32_t distance = kRimWidth + 1; distance <= kRimEnd; ++distance) {
        const int32_t away = distance - outline.distance;
        for (int32_t beside = -2; beside <= 2; beside += 2) {
          const int32_t clean_x = x - away * dx + beside * dy,
                        clean_y = y - away * dy + beside * dx;
          if (Abs(centre_.Disparity(clean_x, clean_y) - here) > kRimStep / 2) continue;
          Widen(centre_.ColourAt(clean_x, clean_y).rgb, low, high);
          ++count;
        }
      }
    });
    if (count < kRimEnd - kRimWidth) return false;
    LimitTo(low, high, colour);
    return true;
  }

  // Divides a pixel of a rim into the clean far colour and the rest of the pixel's light, which the
  // near surface takes. The near surface covers a quarter of the pixel, or less if the rest is
  // faint (kWholeRest), or more if its light would otherwise be brighter than white or negative.
  void CleanRim(const Outline& outline, SplitPixel* pixel) const {
    constexpr int32_t kWholeRest = 8 << kLightBits;
    if (outline.distance == 0) return;
    const int32_t x = field_.x + pixel->column, y = field_.y + pixel->row;
    const PatchRim& rim = rims_->RimAt(x, y);
    const int32_t weight = rim.weight[outline.distance - 1];
    if (weight == 0) return;
    const Colour mixed = centre_.ColourAt(x, y);
    Colour clean;
    for (int c = 0; c < 3; ++c) {
      clean.rgb[c] = LimitedLight(mixed[c] - rim.excess[outline.distance - 1][c]);
    }
    if (!LimitToClean(x, y, outline, &clean)) return;
    int32_t part = LeastShare(mixed, clean);
    for (int c = 0; c < 3; ++c) {
      const int32_t rest = Abs(mixed[c] - clean[c]) * simd::kSliceWhole;
      part = Max(part, Min(rest / (4 * kWholeRest), simd::kSliceWhole / 4));
    }
    const auto blend = [&](int32_t from, int32_t to) {
      return from + (to - from) * weight / kWholeRim;
    };
    const int32_t share = Min(blend(pixel->share, Max(pixel->share, part)), simd::kSliceWhole - 1);
    if (share == 0) return;
    pixel->share = static_cast<uint8_t>(share);
    for (int c = 0; c < 3; ++c) {
      const int32_t far = blend(pixel->far[c], clean[c]);
      pixel->far.rgb[c] = static_cast<int16_t>(far);
      pixel->near.rgb[c] = LimitedLight(far + (mixed[c] - far) * simd::kSliceWhole / share);
    }
  }

  const CentreView centre_;
  const ViewGrid& grid_;
  const BlockPixels& field_;
  const RimMap* const rims_;      // Null if no pixel of the field belongs to a rim.
  const CoverageMap* const map_;  // Null if the coverage map splits no pixel of the field.
  const int16_t step_;            // Largest step between pixels that is not a depth edge.
  const int64_t rim_;
};

}  // namespace

void SplitPixels(const Input& input, const ViewGrid& grid, const BlockPixels& field,
                 SplitVisitor visit, void* data) {
  PixelSplitter(input, grid, field).Visit(visit, data);
}

void SetThinDisparities(const Input& input, BlockPixels* field) {
  if (input.coverage == nullptr || field->layer > 0) return;
  const CoverageMap& map = *input.coverage;
  ForEachThin(map, *field, [&](int32_t x, int32_t y, size_t from) {
    const int32_t alpha = map.alpha[from];
    if (alpha == kUnsplit) return;
    const FarLight& far = map.FarAt(x, y);
    const bool is_near = HasGiven(input) ? 2 * alpha >= kWhole : ShowsNear(input, far, x, y);
    *field->Disparity(x - field->x, y - field->y) = is_near ? map.near[from] : far.disparity;
  });
}

}  // namespace starfocus
