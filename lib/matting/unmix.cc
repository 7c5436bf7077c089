// SPDX-License-Identifier: Apache-2.0
#include <cstring>

#include "lib/matting/colour.h"
#include "lib/matting/coverage_tile.h"

namespace starfocus {
namespace {

constexpr int32_t kAround = simd::kNearReach;
constexpr int32_t kSide = kCoverageTile + 2 * kAround;

// Colours are compared in 255ths of white with 3 fractional bits.
constexpr int kColourBits = 3;
constexpr int32_t kSquareOne = 1 << (2 * kColourBits);
// Alpha is computed from colours to the degree that the colours can be trusted; the disparity map
// decides the rest. Noise of one code must change alpha little, so the trust is a product of smooth
// functions without limits. With the squared distance c between near and far colours, the first is
// c / (c + kContrastNoise), the factor of a least-squares fit that weighs alpha's distance from the
// guess with kContrastNoise.
constexpr int32_t kContrastNoise = 1500 * kSquareOne;
// With the squared distance b of the mixed colour from the line through the near and far colours,
// the second is s / (s + b). The scale s is kNoise, the tolerated squared noise of mixed colours,
// plus c / 16.
constexpr int32_t kNoise = 81 * kSquareOne;
// The third is the sum of the weights of the near samples around a pixel, in units of 2^-15. The
// trust is 1 if the sum is at least 2^kNearBits.
constexpr int kNearBits = 10;

// The pixels in and around a tile: light, near disparities, and the weight of each pixel in a mean
// of the near light.
struct NearTile {
  static constexpr size_t kPlane = kSide * kSide;
  int16_t light[3 * kPlane];
  int16_t near[kPlane];
  int16_t weight[kPlane];

  // Sums the near light around each pixel of a row of the tile (simd::Kernels::SumNear).
  void SumRow(const simd::Kernels& kernels, int32_t y, int16_t sums[4][simd::kSliceLanes]) const {
    const size_t at = static_cast<size_t>((y + kAround) * kSide + kAround);
    const int16_t* const colours[] = {light + at, light + kPlane + at, light + 2 * kPlane + at};
    kernels.SumNear(colours, near + at, weight + at, kSide, static_cast<int16_t>(kThinStep), sums);
  }
};

// Loads a tile and its surroundings. The function weight_of(x, y) returns the weight of pixel (x,
// y) in a mean of the near light.
template <class Weight>
void LoadNearTile(const Input& input, int32_t column, int32_t row, const Weight& weight_of,
                  NearTile* tile) {
  const CoverageMap& map = *input.coverage;
  const int32_t left = column * kCoverageTile - kAround, top = row * kCoverageTile - kAround;
  const int32_t first = Max(0, -left), last = Min(kSide, map.width - left);
  std::memset(tile->weight, 0, sizeof(tile->weight));
  std::memset(tile->light, 0, sizeof(tile->light));
  std::memset(tile->near, 0, sizeof(tile->near));
  for (int32_t y = Max(0, -top); y < Min(kSide, map.height - top); ++y) {
    int16_t light[3 * kSide + simd::kPadding / sizeof(int16_t)];
    const auto at = static_cast<size_t>(y * kSide + first);
    input.Light(0, left + first, top + y, last - first, light);
    input.kernels->Split(light, static_cast<size_t>(last - first), NearTile::kPlane,
                         tile->light + at);
    std::memcpy(tile->near + at, map.near + map.At(left + first, top + y),
                static_cast<size_t>(last - first) * sizeof(*tile->near));
    for (int32_t x = first; x < last; ++x) {
      tile->weight[y * kSide + x] = static_cast<int16_t>(weight_of(left + x, top + y));
    }
  }
}

using Rgb = int32_t[3];

// Colours of a pixel and of its two surfaces.
struct SplitColours {
  Rgb near, far, mixed;
  int32_t near_weight;  // sum of the weights of the samples of `near`
};

// Returns the part of a pixel that the near surface covers, as far as its colours can be trusted;
// `guess` replaces the rest.
int32_t AlphaOf(const SplitColours& colours, int32_t guess) {
  const ColourLine line = ColourLineOf<kColourBits>(colours.near, colours.far, colours.mixed);
  const int64_t contrast = line.contrast;
  if (contrast == 0) return guess;
  const int64_t beside = line.distance - line.along * line.along / contrast;
  const int64_t square = kNoise + contrast / 16;
  const int64_t part = line.along < 0 ? 0 : line.along > contrast ? contrast : line.along;
  // The difference of alpha and guess, multiplied by the trust in the contrast: at most kWhole,
  // with 8 more fractional bits.
  const int64_t change = (part * kWhole - guess * contrast) * 256 / (contrast + kContrastNoise);
  const int32_t known = Min(colours.near_weight, 1 << kNearBits);
  return guess + static_cast<int32_t>(
                     RoundShift(change * known * square / (square + beside), 8 + kNearBits));
}

// Calls visit(x, y, alpha, cell) for each pixel of the tile that is near an edge, if the light of
// the far surface (`cell`) is known. Coordinates x and y are in pixels of the picture.
template <class Visit>
void ForEachSplit(const Input& input, const NearTile& tile, int32_t column, int32_t row,
                  const Visit& visit) {
  const CoverageMap& map = *input.coverage;
  const int32_t left = column * kCoverageTile, top = row * kCoverageTile;
  FarTile far;
  PushTile(column, row, map, &far);
  for (int32_t y = 0; y < Min(kCoverageTile, map.height - top); ++y) {
    int16_t sums[4][simd::kSliceLanes];
    tile.SumRow(*input.kernels, y, sums);
    for (int32_t x = 0; x < Min(kCoverageTile, map.width - left); ++x) {
      const size_t to = map.At(left + x, top + y);
      const FarCell& cell = far.cells[y * kCoverageTile + x];
      if (map.alpha[to] == kUnsplit || cell.weight == 0) continue;
      int32_t alpha = map.first[to];
      const int32_t weight = sums[3][x];
      if (weight > 0) {
        SplitColours colours;
        colours.near_weight = weight;
        for (int c = 0; c < 3; ++c) {
          const size_t at = static_cast<size_t>(c) * NearTile::kPlane;
          colours.near[c] = (sums[c][x] << 15) / weight;
          colours.far[c] = cell.rgb[c];
          colours.mixed[c] =
              tile.light[at + static_cast<size_t>((y + kAround) * kSide + x + kAround)];
        }
        alpha = AlphaOf(colours, alpha);
      }
      visit(left + x, top + y, alpha, cell);
    }
  }
}

}  // namespace

void UnmixFirst(const Input& input, int32_t column, int32_t row) {
  const CoverageMap& map = *input.coverage;
  // Returns a weight of 0 for pixels on the far side of an edge. For other pixels, the weight
  // increases with the number of surrounding 3x3 pixels that are not on the far side.
  const auto weight_of = [&](int32_t x, int32_t y) {
    if (map.alpha[map.At(x, y)] == 0) return 0;
    int32_t count = 0;
    for (int32_t dy = -1; dy <= 1; ++dy) {
      const int32_t there = Clamp(y + dy, 0, map.height - 1);
      for (int32_t dx = -1; dx <= 1; ++dx) {
        count += map.alpha[map.At(Clamp(x + dx, 0, map.width - 1), there)] != 0 ? 1 : 0;
      }
    }
    return 3 * count * count;
  };
  NearTile tile;
  LoadNearTile(input, column, row, weight_of, &tile);
  ForEachSplit(input, tile, column, row, [&](int32_t x, int32_t y, int32_t alpha, const FarCell&) {
    map.first[map.At(x, y)] = static_cast<uint8_t>(alpha);
  });
}

void UnmixAgain(const Input& input, int32_t column, int32_t row) {
  const CoverageMap& map = *input.coverage;
  NearTile tile;
  LoadNearTile(
      input, column, row,
      [&](int32_t x, int32_t y) { return EighthPower(map.first[map.At(x, y)]); }, &tile);
  ForEachSplit(input, tile, column, row,
               [&](int32_t x, int32_t y, int32_t alpha, const FarCell& far) {
                 map.alpha[map.At(x, y)] = static_cast<uint8_t>(alpha);
                 std::memcpy(map.FarAt(x, y).rgb, far.rgb, sizeof(far.rgb));
               });
}

void TakeGiven(const Input& input, int32_t column, int32_t row) {
  const CoverageMap& map = *input.coverage;
  FarTile far;
  PushTile(column, row, map, &far);
  for (int32_t y = 0; y < Min(kCoverageTile, map.height - row * kCoverageTile); ++y) {
    for (int32_t k = 0; k < Min(kCoverageTile, map.width - column * kCoverageTile); ++k) {
      const int32_t x = column * kCoverageTile + k;
      const size_t to = map.At(x, row * kCoverageTile + y);
      const FarCell& cell = far.cells[y * kCoverageTile + k];
      if (map.alpha[to] == kUnsplit) continue;
      // A pixel cannot be split if the light of the far surface is not known nearby. It then
      // belongs to the near surface if the near surface covers most of it.
      map.alpha[to] = cell.weight > 0               ? map.first[to]
                      : 2 * map.first[to] >= kWhole ? uint8_t{kWhole}
                                                    : kUnsplit;
      std::memcpy(map.FarAt(x, row * kCoverageTile + y).rgb, cell.rgb, sizeof(cell.rgb));
    }
  }
}

}  // namespace starfocus
