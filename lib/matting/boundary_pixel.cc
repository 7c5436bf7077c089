// SPDX-License-Identifier: Apache-2.0
#include "lib/matting/boundary_pixel.h"

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

}  // namespace starfocus
