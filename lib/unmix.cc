#include "lib/unmix.h"

#include "lib/fixed.h"

namespace starfocus {
namespace {

constexpr int32_t kShareOne = 1 << kShareBits;

// Colours nearer to each other than this, squared, tell no mixture.
constexpr int64_t kLeastContrast = 64;
// Up to this distance from the line between the two colours a pixel is their mixture, squared: a
// few gray levels of noise and a sixteenth of their contrast's square.
constexpr int64_t kNoise = 27;
constexpr int64_t kContrastParts = 16;

// Blur radius, kShiftBits, up to which a surface counts as sharp. A pixel more, where the paper's
// subsampled layers begin, and no outline shows.
constexpr int32_t kSharp = 2 * kShiftOne;

// How much of `mixed` shows `near`, the rest being `far`: kShareBits, 0 when it is no mixture. The
// far surface has the pixel's centre, so that more than 4/5 says that `far` is something else.
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
  return (static_cast<int32_t>(along) * (2 * kShareOne) + static_cast<int32_t>(contrast)) /
         (2 * static_cast<int32_t>(contrast));
}

// How much of it to take out, kShiftBits, none below 0: all where the near surface is defocused by
// a pixel more than the far one, and that by no more than kSharp.
int32_t StrengthOf(int32_t near_radius, int32_t far_radius) {
  return Min(Min(near_radius - far_radius, kSharp + kShiftOne - far_radius), kShiftOne);
}

// The picture around a pixel; beyond its edges it repeats them.
class Unmixer {
 public:
  Unmixer(const Window& window, const ViewGrid& grid)
      : window_(window), grid_(grid), rim_(grid.Move(grid.n())), half_(window.views == 17) {}

  // Writes the far surface's colour of pixel (x, y): the mean over the depth edges beside it, each
  // by the share that the nearer surface has there.
  void Unmix(int32_t x, int32_t y, uint8_t* out) const {
    constexpr int8_t kSides[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    const uint8_t* mixed = Colour(x, y);
    int32_t sums[3] = {0, 0, 0}, shares = 0;
    for (const auto& side : kSides) {
      uint8_t far[3];
      int32_t amount = 0;
      const int32_t share = LookAt(x, y, side[0], side[1], far, &amount);
      shares += share;
      for (int c = 0; c < 3; ++c) sums[c] += share * amount * (far[c] - mixed[c]);
    }
    if (shares == 0) return;
    const int32_t unit = shares * kShareOne;
    for (int c = 0; c < 3; ++c) {
      out[c] = static_cast<uint8_t>(
          Checked(ranges::kUnmixed, (mixed[c] * unit + sums[c] + unit / 2) / unit));
    }
  }

 private:
  int32_t Disparity(int32_t x, int32_t y) const {
    return window_.disparity.Row(
        Clamp(y, 0, window_.picture_height - 1))[Clamp(x, 0, window_.picture_width - 1)];
  }
  const uint8_t* Colour(int32_t x, int32_t y) const {
    return window_.centre.Row(Clamp(y, 0, window_.height - 1)) +
           3 * static_cast<ptrdiff_t>(Clamp(x, 0, window_.width - 1));
  }
  int32_t Radius(int32_t disparity) const { return Abs(grid_.Shift(rim_, disparity)); }

  // The depth edge towards (dx, dy). Returns the nearer surface's share of the pixel; `amount` of
  // the pixel (kShareBits) is to become `far`. All of it from a share of a half on, but less below:
  // what is taken away there the nearer surface's own pixels mostly lack on the other side of the
  // edge. And less where nothing would show (StrengthOf).
  int32_t LookAt(int32_t x, int32_t y, int dx, int dy, uint8_t* far, int32_t* amount) const {
    const int32_t disparity = Disparity(x, y), near = Disparity(x + dx, y + dy);
    for (int c = 0; c < 3; ++c) far[c] = 0;
    if (near - disparity <= kSurfaceStep) return 0;
    const int32_t strength = StrengthOf(Radius(near), Radius(disparity));
    if (strength <= 0) return 0;
    ReadBehind(x, y, dx, dy, disparity, far);
    const int32_t beyond = Disparity(x + 2 * dx, y + 2 * dy);
    const int32_t pure = Abs(beyond - near) <= kSurfaceStep ? 2 : 1;
    const int32_t share = ShareOf(Colour(x + pure * dx, y + pure * dy), far, Colour(x, y));
    *amount = (Min(2 * share, kShareOne) * strength + kShiftOne / 2) >> kShiftBits;
    return share;
  }

  // The point of the far surface in the captured view towards (-dx, -dy), where the nearer surface
  // lies farther towards (dx, dy).
  void ReadBehind(int32_t x, int32_t y, int dx, int dy, int32_t disparity, uint8_t* far) const {
    if (window_.side_colours != nullptr) ++*window_.side_colours;
    const int32_t moved = disparity * (1 << (kShiftBits - kDisparityBits - (half_ ? 1 : 0)));
    int32_t sums[3];
    InterpolateCaptured(window_, CapturedView(-dx, -dy, half_), x * kShiftOne + dx * moved,
                        y * kShiftOne + dy * moved, sums);
    // Halves towards the pixel, so that an inverted picture is decided on alike.
    constexpr int32_t kHalf = 1 << (2 * kShiftBits - 1);
    const uint8_t* mixed = Colour(x, y);
    for (int c = 0; c < 3; ++c) {
      const bool up = (mixed[c] << (2 * kShiftBits)) > sums[c];
      far[c] = static_cast<uint8_t>((sums[c] + kHalf - (up ? 0 : 1)) >> (2 * kShiftBits));
    }
  }

  const Window& window_;
  const ViewGrid& grid_;
  const int64_t rim_;
  const bool half_;
};

// Not Max: of 16 bits, as vectors hold them.
int16_t Nearer(int16_t a, int16_t b) { return a > b ? a : b; }

// All bits set where the pixel at `at` is farther away by an edge than one beside it, above or
// below it; no bit elsewhere. `width`: from row to row.
int16_t BesideEdge(const int16_t* at, ptrdiff_t width) {
  const int16_t nearest = Nearer(Nearer(at[-1], at[1]), Nearer(at[-width], at[width]));
  const auto limit = static_cast<int16_t>(at[0] + kSurfaceStep);
  return static_cast<int16_t>(nearest > limit ? -1 : 0);
}

// Whether any of kAtOnce pixels is: most are not. Compilers make vectors of it on its own only.
constexpr int32_t kAtOnce = 16;
[[gnu::noinline]] bool AnyBesideEdge(const int16_t* at, ptrdiff_t width) {
  int16_t any = 0;
  for (int32_t k = 0; k < kAtOnce; ++k) any |= BesideEdge(at + k, width);
  return any != 0;
}

}  // namespace

void UnmixEdges(const Window& window, const ViewGrid& grid, Field* field) {
  if (window.layer != 0 || window.views == 1) return;
  const Unmixer unmixer(window, grid);
  for (int32_t row = 1; row + 1 < field->height; ++row) {
    const int16_t* disparity = field->Disparity(0, row);
    for (int32_t from = 1; from + 1 < field->width; from += kAtOnce) {
      const int32_t end = Min(from + kAtOnce, field->width - 1);
      const int32_t tested = end - kAtOnce;  // the last ones reach back
      if (tested > 0 && !AnyBesideEdge(disparity + tested, field->width)) continue;
      for (int32_t column = from; column < end; ++column) {
        if (BesideEdge(disparity + column, field->width) == 0) continue;
        unmixer.Unmix(field->x + column, field->y + row, field->Rgb(column, row));
      }
    }
  }
}

}  // namespace starfocus
