// SPDX-License-Identifier: Apache-2.0
#include "lib/matting/mixed_pixels.h"

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

// Returns a - b with kColourBits. Halves are rounded away from 0, so that inverted colours have the
// same differences with opposite signs, and therefore the same shares.
int64_t Difference(int32_t a, int32_t b) {
  const int64_t size = RoundShift(Abs(a - b), kLightBits - kColourBits);
  return a < b ? -size : size;
}

// How a pixel is divided: the share of the nearer surface, and the weight with which the far colour
// that was read replaces the colour of the pixel. Both have kShareBits.
struct Division {
  int32_t share = 0, weight = 0;
};

// Divides a pixel by the position of its colour relative to the line from `far` to `near`.
//
// Noise must not decide whether a pixel is split. At each limit, the share and the weight therefore
// fade to 0 instead of stopping abruptly: at contrasts below twice kLeastContrast, for shares from
// 13/20 to 19/20, and from 1/4 to 3/2 of the tolerated squared distance from the line. The far
// surface covers the centre of the pixel, so a larger share means that `far` is wrong. For shares
// below 1 / kPureParts, the weight also falls to 0, because the far colour differs from the colour
// of the pixel by the distance from the line.
Division DivisionOf(const BoundaryColours& colours) {
  int64_t along = 0, contrast = 0, distance = 0;
  for (int c = 0; c < 3; ++c) {
    const int64_t whole = Difference(colours.near[c], colours.far[c]);
    const int64_t part = Difference(colours.mixed[c], colours.far[c]);
    along += part * whole;
    contrast += whole * whole;
    distance += part * part;
  }
  if (contrast <= kLeastContrast || along <= 0 || 20 * along >= 19 * contrast) return {};
  // The distance from the line and its limit are multiplied by `contrast`.
  const int64_t beside = kContrastParts * (distance * contrast - along * along);
  const int64_t limit = contrast * (kContrastParts * kNoise + contrast);
  if (2 * (beside >> kShareBits) >= 3 * (limit >> kShareBits)) return {};
  const int64_t share = along * kShareOne / contrast;
  const int64_t clear = Limited((contrast - kLeastContrast) * kShareOne / kLeastContrast);
  const int64_t inside = Limited((6 * kShareOne - 4 * (beside / (limit >> kShareBits))) / 5);
  const int64_t most = Limited((19 * kShareOne - 20 * share) / 6);
  const int64_t fade = (clear * inside >> kShareBits) * most >> kShareBits;
  return {static_cast<int32_t>(share * fade >> kShareBits),
          static_cast<int32_t>(Limited(kPureParts * share) * fade >> kShareBits)};
}

// Returns the colour of the next pixel away from the nearer surface. If that pixel is on another
// surface than `pixel`, returns `mixed`, which gives a share of 0.
Colour ReadBeside(const CentreView& centre, const BoundaryPixel& pixel, const Colour& mixed) {
  const int8_t* const side = kSides[pixel.side];
  const int32_t x = pixel.x - side[0], y = pixel.y - side[1];
  const bool same = Abs(centre.Disparity(x, y) - pixel.disparity) <= pixel.step;
  return same ? centre.ColourAt(x, y) : mixed;
}

// Returns the captured view on the side away from the nearer surface. In the returned view, the
// nearer surface is shifted away from the pixel.
const OcclusionView& OcclusionViewAway(const Input& input, const BoundaryPixel& pixel) {
  return input.occlusion_views.Last(pixel.side ^ 1);
}

// Reads the colour of the far surface from the captured view that OcclusionViewAway returns.
Colour ReadFar(const Input& input, const BoundaryPixel& pixel) {
  const OcclusionView& look = OcclusionViewAway(input, pixel);
  constexpr int kBits = kViewBits + kDisparityBits - kShiftBits;
  const int32_t x = pixel.x * kShiftOne - ScaledByView(look.at.u, pixel.disparity, kBits);
  const int32_t y = pixel.y * kShiftOne - ScaledByView(look.at.v, pixel.disparity, kBits);
  int32_t sums[3];
  InterpolateCaptured(input, look.view, x, y, sums);
  Colour far;
  for (int c = 0; c < 3; ++c)
    far.rgb[c] = static_cast<int16_t>(RoundShift(sums[c], 2 * kShiftBits));
  return far;
}

// Reads the colours of a boundary pixel and of the two surfaces beside the edge.
BoundaryColours ReadColours(const CentreView& centre, const BoundaryPixel& pixel) {
  const int32_t x = pixel.x, y = pixel.y;
  const int dx = kSides[pixel.side][0], dy = kSides[pixel.side][1];
  const int32_t beyond = centre.Disparity(x + 2 * dx, y + 2 * dy);
  const int pure = Abs(beyond - pixel.near) <= pixel.step ? 2 : 1;
  BoundaryColours colours;
  colours.mixed = centre.ColourAt(x, y);
  colours.near = centre.ColourAt(x + pure * dx, y + pure * dy);
  colours.far = OcclusionViewAway(centre.input, pixel).view != 0
                    ? ReadFar(centre.input, pixel)
                    : ReadBeside(centre, pixel, colours.mixed);
  return colours;
}

// Returns a mixture whose far colour changes from the colour of the pixel to the far colour that
// was read as the weight increases.
Mixture MixtureOf(const Division& division, const BoundaryColours& colours) {
  Mixture mixture = {division.share, colours.near, colours.mixed};
  for (int c = 0; c < 3; ++c) {
    const int32_t change = colours.far[c] - colours.mixed[c];
    mixture.far.rgb[c] = static_cast<int16_t>(
        colours.mixed[c] + RoundShift(int64_t{division.weight} * change, kShareBits));
  }
  return mixture;
}

// A mixture is split only if its two surfaces move by more than kLeastMove relative to each other
// (kShiftBits). In measurements, a smaller limit of a quarter pixel did not improve accuracy, and a
// limit of two pixels lost 0.2 dB (docs/constants.md).
constexpr int32_t kLeastMove = kShiftOne;

// Coverage above kMostExact counts as more than it is: pixels with a coverage of at least
// kLeastWhole belong to the near surface alone.
constexpr int32_t kMostExact = 102, kLeastWhole = (kMostExact + kWhole) / 2;

// Sums of a boundary pixel's mixtures with the nearer surfaces on all sides, each mixture weighted
// by its share.
struct MixtureSum {
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
  Colour Mean(const int32_t (&sums)[3]) const {
    Colour mean;
    for (int c = 0; c < 3; ++c) {
      mean.rgb[c] =
          static_cast<int16_t>(Checked(ranges::kUnmixed, (sums[c] + shares / 2) / shares));
    }
    return mean;
  }
};

// Returns the light of the surface that covers the rest of a mixture, if `surface` covers `part` of
// the mixture.
int16_t RestOf(int32_t mixed, int32_t surface, int32_t part) {
  const int32_t rest = kWhole - part;
  const int32_t light = (mixed * kWhole - part * surface + rest / 2) / rest;
  return static_cast<int16_t>(Clamp(light, ranges::kUnmixed.low, ranges::kUnmixed.high));
}

}  // namespace

Colour CentreView::ColourAt(int32_t x, int32_t y) const {
  const int32_t column = Clamp(x, 0, input.width - 1), row = Clamp(y, 0, input.height - 1);
  Colour colour;
  input.Light(0, column, row, 1, colour.rgb);
  return colour;
}

Mixture FindMixture(const CentreView& centre, const BoundaryPixel& pixel) {
  const BoundaryColours colours = ReadColours(centre, pixel);
  const Input* const captured = centre.input.captured;
  if (captured == nullptr) return Unmix(colours);
  return MixtureOf(DivisionOf(ReadColours({*captured}, pixel)), colours);
}

Mixture Unmix(const BoundaryColours& colours) { return MixtureOf(DivisionOf(colours), colours); }

PixelSplitter::PixelSplitter(const Input& input, const ViewGrid& grid, const BlockPixels& field)
    : centre_{input},
      grid_(grid),
      field_(field),
      map_(field.layer == 0 ? input.coverage : nullptr),
      step_(static_cast<int16_t>(kDepthEdge << field.layer)),
      rim_(grid.Move(grid.n())) {}

bool PixelSplitter::SplitBoundary(int32_t column, int32_t row, SplitPixel* pixel) const {
  const int32_t x = field_.x + column, y = field_.y + row;
  if (map_ != nullptr && map_->Tile(x / kCoverageTile, y / kCoverageTile).thin != 0) return false;
  const int16_t disparity = *field_.Disparity(column, row);
  MixtureSum sum;
  for (int side = 0; side < kSideCount; ++side) {
    const int32_t near = *field_.Disparity(column + kSides[side][0], row + kSides[side][1]);
    if (near - disparity <= step_ || !Moves(near, disparity)) continue;
    sum.nearest = Max(sum.nearest, near);
    sum.Add(MixtureAt({column, row, side, disparity, near, step_}));
  }
  const int32_t share = RoundShift(sum.most * simd::kSliceWhole, kShareBits);
  if (share == 0) return false;
  *pixel = {SplitPixel::kBoundary,
            column,
            row,
            static_cast<uint8_t>(share),
            static_cast<int16_t>(sum.nearest),
            disparity,
            sum.Mean(sum.near),
            sum.Mean(sum.far)};
  return true;
}

void PixelSplitter::SplitThin(int32_t x, int32_t y, SplitPixel* pixel) const {
  const CoverageMap& map = *map_;
  const size_t from = map.At(x, y);
  pixel->column = x - field_.x;
  pixel->row = y - field_.y;
  pixel->kind = map.alpha[from] == kUnsplit ? SplitPixel::kWhole : SplitPixel::kThin;
  if (pixel->kind == SplitPixel::kWhole) return;
  const int32_t found = map.alpha[from];
  const int32_t alpha = Min(found + Max(found - kMostExact, 0), kWhole);
  const FarCell& cell = map.FarAt(x, y);
  const bool whole = alpha == kWhole, is_excess = centre_.input.captured != nullptr;
  // Pixels without coverage have a near surface too, with a share of 0, so that the disparities of
  // all surfaces, and therefore the slices, do not depend on colours.
  pixel->near_disparity = map.near[from];
  pixel->far_disparity = cell.disparity;
  pixel->share = !whole           ? static_cast<uint8_t>(alpha)
                 : IsInside(x, y) ? uint8_t{simd::kSliceWhole}
                                  : simd::kSliceEnd;
  for (int c = 0; c < 3; ++c) {
    const int16_t mixed = field_.Rgb(pixel->column, pixel->row)[c];
    int16_t& near = pixel->near.rgb[c] = mixed;
    // The far surface has the excess of the whole pixel, unless the near surface covers the pixel.
    int16_t& far = pixel->far.rgb[c] = !is_excess ? cell.rgb[c] : whole ? int16_t{0} : mixed;
    if (whole || is_excess) continue;
    if (alpha > 0) near = RestOf(mixed, far, kWhole - alpha);
    // RestOf may have clipped the near surface's light. The far surface's light compensates for the
    // clipping, so that the mixture of both surfaces still equals the light of the pixel.
    far = RestOf(mixed, near, alpha);
  }
}

// Returns the mixture at a boundary pixel. The coordinates in `pixel` are relative to the field.
Mixture PixelSplitter::MixtureAt(const BoundaryPixel& pixel) const {
  if (field_.layer > 0) return MixtureOfLayer(pixel);
  BoundaryPixel of_picture = pixel;
  of_picture.x += field_.x;
  of_picture.y += field_.y;
  return FindMixture(centre_, of_picture);
}

// Returns the mixture at a pixel of a subsampled layer.
Mixture PixelSplitter::MixtureOfLayer(const BoundaryPixel& pixel) const {
  const int32_t x = pixel.x, y = pixel.y;
  const int dx = kSides[pixel.side][0], dy = kSides[pixel.side][1];
  const Colour mixed = ColourAt(x, y);
  const bool wide = Abs(DisparityAt(x + 2 * dx, y + 2 * dy) - pixel.near) <= pixel.step;
  const Colour near = ColourAt(x + (wide ? 2 : 1) * dx, y + (wide ? 2 : 1) * dy);
  return Unmix({near, FarAt(pixel, mixed), mixed});
}

// Estimates the colour of the far surface of a subsampled pixel. The colour is read from the
// captured view on the far side of the edge. If no captured view looks behind the edge, returns the
// colour of the next pixel away from the edge.
Colour PixelSplitter::FarAt(const BoundaryPixel& pixel, const Colour& mixed) const {
  const Input& input = centre_.input;
  const OcclusionView& look = OcclusionViewAway(input, pixel);
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

// Returns the colour of a pixel of the field. Pixels outside the field have the colour of the
// nearest pixel inside.
Colour PixelSplitter::ColourAt(int32_t column, int32_t row) const {
  const int16_t* rgb =
      field_.Rgb(Clamp(column, 0, field_.width - 1), Clamp(row, 0, field_.height - 1));
  return {{rgb[0], rgb[1], rgb[2]}};
}

int32_t PixelSplitter::DisparityAt(int32_t column, int32_t row) const {
  return *field_.Disparity(Clamp(column, 0, field_.width - 1), Clamp(row, 0, field_.height - 1));
}

bool PixelSplitter::Moves(int32_t near, int32_t far) const {
  return Abs(grid_.Shift(rim_, near) - grid_.Shift(rim_, far)) > kLeastMove;
}

// Returns true if the near surface also covers the four neighbours of a pixel, so that slices on
// both sides of a step within the surface overlap. Otherwise, the far surface would show between
// the slices.
bool PixelSplitter::IsInside(int32_t x, int32_t y) const {
  for (const auto& side : kSides) {
    if (IsPartial(x + side[0], y + side[1])) return false;
  }
  return true;
}

// Returns true if a pixel of the field has a far surface that is not hidden.
bool PixelSplitter::IsPartial(int32_t x, int32_t y) const {
  const CoverageMap& map = *map_;
  const bool in_field = x >= Max(0, field_.x) && x < Min(field_.x + field_.width, map.width) &&
                        y >= Max(0, field_.y) && y < Min(field_.y + field_.height, map.height);
  return in_field && map.Tile(x / kCoverageTile, y / kCoverageTile).thin != 0 &&
         map.alpha[map.At(x, y)] < kLeastWhole;
}

void TakeDisparities(const Input& input, BlockPixels* field) {
  if (input.coverage == nullptr || field->layer > 0) return;
  const CoverageMap& map = *input.coverage;
  ForEachThin(map, *field, [&](int32_t x, int32_t y) {
    const size_t from = map.At(x, y);
    const int32_t alpha = map.alpha[from];
    if (alpha == kUnsplit) return;
    const bool is_near = 2 * alpha >= kWhole;
    *field->Disparity(x - field->x, y - field->y) =
        is_near ? map.near[from] : map.FarAt(x, y).disparity;
  });
}

}  // namespace starfocus
