// SPDX-License-Identifier: Apache-2.0
#include "lib/gather/slope.h"

#include "lib/optics/opening.h"

namespace starfocus {
namespace {

constexpr int32_t kHalves = 2 * kCellSize;  // number of half pixels along the side of a cell

// Returns the signed blur radius at the upper left corner of a cell.
int32_t RadiusAtCorner(const CellGrid& grid, const BlurScale& scale, int32_t column, int32_t row) {
  constexpr int kSummedBits = 3;  // log2 of the number of summed disparities, two of each cell
  int64_t distance = -int64_t{scale.focus.far} * (1 << kSummedBits);
  for (int32_t y = row - 1; y <= row; ++y) {
    for (int32_t x = column - 1; x <= column; ++x) {
      const Cell& cell = *grid.At(Clamp(x, 0, grid.columns - 1), Clamp(y, 0, grid.rows - 1));
      distance += cell.low + cell.high;
    }
  }
  return static_cast<int32_t>((scale.step * distance) >>
                              (kStepBits + kDisparityBits + kSummedBits - kSlopeBits));
}

}  // namespace

Slope::Slope(const CellGrid& grid, const BlurScale& scale, int32_t column, int32_t row,
             int32_t layer)
    : layer_(layer), left_(kHalves * column), top_(kHalves * row) {
  for (int32_t k = 0; k < 4; ++k) {
    corners_[k] = RadiusAtCorner(grid, scale, column + (k & 1), row + (k >> 1));
  }
}

// Returns the signed radius of a pixel of the layer, in pixels of the layer, with ScaledBits extra
// fractional bits.
int64_t Slope::Scaled(int32_t x, int32_t y) const {
  const int32_t across = (2 * x + 1) * (1 << layer_) - left_;
  const int32_t down = (2 * y + 1) * (1 << layer_) - top_;
  const int32_t above = corners_[0] * (kHalves - across) + corners_[1] * across;
  const int32_t below = corners_[2] * (kHalves - across) + corners_[3] * across;
  return int64_t{above} * (kHalves - down) + int64_t{below} * down;
}

int32_t Slope::At(int32_t x, int32_t y) const {
  return static_cast<int32_t>(RoundShift(Scaled(x, y), ScaledBits()));
}

RadiusRange Slope::RangeOf(const Rect& pixels) const {
  const int32_t right = pixels.x + pixels.width - 1, bottom = pixels.y + pixels.height - 1;
  const int32_t radii[4] = {At(pixels.x, pixels.y), At(right, pixels.y), At(pixels.x, bottom),
                            At(right, bottom)};
  int32_t low = radii[0], high = radii[0];
  for (const int32_t radius : radii) {
    low = Min(low, radius);
    high = Max(high, radius);
  }
  const int32_t nearest = low < 0 && high > 0 ? 0 : Min(Abs(low), Abs(high));
  return {nearest, Max(Abs(low), Abs(high))};
}

void Slope::FindShares(const RadiusRange& between, const Rect& pixels, size_t stride,
                       int16_t* share) const {
  constexpr int32_t kOne = INT16_MAX;
  const int64_t low = int64_t{between.low} * between.low;
  const int64_t range = int64_t{between.high} * between.high - low;
  const int64_t unit = range > 0 ? (int64_t{kOne} << 32) / range : 0;
  const int bits = ScaledBits();
  for (int32_t row = 0; row < pixels.height; ++row, share += stride) {
    const int32_t x = pixels.x, y = pixels.y + row;
    int64_t scaled = Scaled(x, y);
    const int64_t step = Scaled(x + 1, y) - scaled;
    scaled += int64_t{1} << (bits - 1);
    int16_t* to = share;
    for (int32_t n = 0; n < pixels.width; ++n, to += 3, scaled += step) {
      const int64_t radius = scaled >> bits;
      const int64_t part = ((radius * radius - low) * unit) >> 32;
      to[0] = to[1] = to[2] = static_cast<int16_t>(part < 0 ? 0 : part > kOne ? kOne : part);
    }
  }
}

simd::HalfMove Slope::Move(int32_t spread) const {
  constexpr int32_t kMost = INT16_MAX;
  const int64_t radii = int64_t{corners_[0]} + corners_[1] + corners_[2] + corners_[3];
  // The mean radius is 1/4 of the sum of the radii at the corners. The gradient is 1/16 of the
  // difference between opposite sides.
  const auto half_move = [&](int32_t difference) {
    const int bits = kOpeningBits + 2 * kSlopeBits + 2 + 4 + 1 - 15 + layer_;
    // Rounds the absolute value, so that a mirrored slope moves exactly as far in the other
    // direction.
    const int64_t product = radii * difference * spread;
    const int64_t move = RoundShift(product < 0 ? -product : product, bits);
    const auto limited = static_cast<int32_t>(move < kMost ? move : kMost);
    return static_cast<int16_t>(product < 0 ? -limited : limited);
  };
  return {half_move(corners_[1] + corners_[3] - corners_[0] - corners_[2]),
          half_move(corners_[2] + corners_[3] - corners_[0] - corners_[1])};
}

}  // namespace starfocus
