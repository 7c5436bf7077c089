// SPDX-License-Identifier: Apache-2.0
#include "lib/input/boundary_pixel.h"

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
// Largest squared distance of a mixture from the line between the two colours: noise of 3/255 of
// white in each channel, plus 1/16 of the squared contrast.
constexpr int64_t kNoise = 27 * kSquareOne;
constexpr int64_t kContrastParts = 16;

int32_t Compared(int32_t light) {
  return static_cast<int32_t>(RoundShift(light, kLightBits - kColourBits));
}

// Position of a colour relative to the line from `far` to `near`: the position along the line, and
// the squared distance from the line. Both values are multiplied by `contrast`, the squared length
// of the line.
struct LinePlace {
  int64_t along = 0, contrast = 0, beside = 0;

  LinePlace(const Colour& near, const Colour& far, const Colour& mixed) {
    int64_t distance = 0;
    for (int c = 0; c < 3; ++c) {
      const int64_t whole = Compared(near[c]) - Compared(far[c]);
      const int64_t part = Compared(mixed[c]) - Compared(far[c]);
      along += part * whole;
      contrast += whole * whole;
      distance += part * part;
    }
    beside = distance * contrast - along * along;
  }

  // Returns the largest value of `kContrastParts * beside` at which a colour counts as a mixture.
  int64_t Limit() const { return contrast * (kContrastParts * kNoise + contrast); }

  int32_t Share() const {
    return static_cast<int32_t>((static_cast<uint64_t>(along) << kShareBits) /
                                static_cast<uint64_t>(contrast));
  }
};

// Returns the share of `near` in `mixed`, kShareBits; the rest is `far`. The share is 0 if `mixed`
// is not a mixture. The far surface covers the centre of the pixel, so a share above 4/5 means that
// `far` is wrong. The share is rounded down, so that later rounding to fewer bits gives the rounded
// exact value.
int32_t ShareOf(const Colour& near, const Colour& far, const Colour& mixed) {
  const LinePlace place(near, far, mixed);
  if (place.contrast < kLeastContrast || place.along <= 0) return 0;
  if (5 * place.along > 4 * place.contrast) return 0;
  return kContrastParts * place.beside > place.Limit() ? 0 : place.Share();
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
const OcclusionView& OcclusionViewAway(const Window& window, const BoundaryPixel& pixel) {
  return window.occlusion_views.Last(pixel.side ^ 1);
}

// Reads the colour of the far surface from the captured view that OcclusionViewAway returns.
Colour ReadFar(const Window& window, const BoundaryPixel& pixel, const Colour& mixed) {
  const OcclusionView& look = OcclusionViewAway(window, pixel);
  constexpr int kBits = kViewBits + kDisparityBits - kShiftBits;
  const int32_t x = pixel.x * kShiftOne - ScaledByView(look.at.u, pixel.disparity, kBits);
  const int32_t y = pixel.y * kShiftOne - ScaledByView(look.at.v, pixel.disparity, kBits);
  int32_t sums[3];
  InterpolateCaptured(window, look.view, x, y, sums);
  // Halves are rounded towards the colour of the pixel, so that an inverted picture gives the same
  // shares.
  constexpr uint32_t kHalf = 1 << (2 * kShiftBits - 1);
  Colour far;
  for (int c = 0; c < 3; ++c) {
    const bool up = (mixed[c] << (2 * kShiftBits)) > sums[c];
    const uint32_t sum = static_cast<uint32_t>(sums[c]) + kHalf - (up ? 0 : 1);
    far.rgb[c] = static_cast<int16_t>(sum >> (2 * kShiftBits));
  }
  return far;
}

}  // namespace

Colour CentreView::ColourAt(int32_t x, int32_t y) const {
  const int32_t column = Clamp(x, 0, window.width - 1), row = Clamp(y, 0, window.height - 1);
  Colour colour;
  window.reader.Light(0, column, row, 1, colour.rgb);
  return colour;
}

Mixture FindMixture(const CentreView& centre, const BoundaryPixel& pixel) {
  const bool is_excess = centre.window.is_excess;
  Mixture mixture = {};
  if (is_excess) {
    Window light = centre.window;
    light.reader = light.light;
    light.is_excess = false;
    mixture.share = FindMixture({light}, pixel).share;
    if (mixture.share == 0) return mixture;
  }
  const int32_t x = pixel.x, y = pixel.y;
  const int dx = kSides[pixel.side][0], dy = kSides[pixel.side][1];
  const Colour mixed = centre.ColourAt(x, y);
  const int32_t beyond = centre.Disparity(x + 2 * dx, y + 2 * dy);
  const int pure = Abs(beyond - pixel.near) <= pixel.step ? 2 : 1;
  mixture.near = centre.ColourAt(x + pure * dx, y + pure * dy);
  mixture.far = OcclusionViewAway(centre.window, pixel).view != 0
                    ? ReadFar(centre.window, pixel, mixed)
                    : ReadBeside(centre, pixel, mixed);
  if (!is_excess) mixture.share = ShareOf(mixture.near, mixture.far, mixed);
  return mixture;
}

int32_t FadedShareOf(const Colour& near, const Colour& far, const Colour& mixed) {
  constexpr int64_t kOne = 1 << kShareBits;
  const auto limited = [](int64_t fade) { return fade < 0 ? 0 : fade > kOne ? kOne : fade; };
  const LinePlace place(near, far, mixed);
  if (place.contrast <= kLeastContrast || place.along <= 0 || place.along >= place.contrast) {
    return 0;
  }
  const int64_t contrast = limited((place.contrast - kLeastContrast) * kOne / kLeastContrast);
  const int64_t outside = kContrastParts * place.beside / (place.Limit() >> kShareBits);
  int64_t share = place.Share();
  const int64_t most = limited(5 * (kOne - share));
  const int64_t fades[] = {contrast, limited(2 * kOne - outside), most};
  for (const int64_t fade : fades) {
    share = share * fade >> kShareBits;
  }
  return static_cast<int32_t>(share);
}

}  // namespace starfocus
