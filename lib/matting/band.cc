// SPDX-License-Identifier: Apache-2.0
#include <cstring>

#include "lib/matting/coverage_tile.h"
#include "lib/matting/surface_search.h"

namespace starfocus {
namespace {

// Disparities in and around a tile: the input for finding the pixels near edges and their near
// disparities.
using BandDisparities = DisparitiesAround<kBandReach + 2>;

// A tile counts as thin structure if at least kLeastRagged of its pixels have a nearer neighbour,
// and if at least kLeastStrands of its pixels belong to strands one pixel wide. In tiles of hair,
// 38 or more pixels have a nearer neighbour. Tiles with a straight edge have 16 to 23 pixels with a
// nearer neighbour. Where wires two pixels wide cross, a tile has up to 54, but no such strand.
// Both counts depend on the disparity map alone, so that noise in the views cannot change them.
constexpr int32_t kLeastRagged = 36, kLeastStrands = 2;

// Offset to a neighbour at most kBandReach pixels away in x and y: as (x, y), and as a difference
// of array indices.
struct BandOffset {
  int8_t x, y;
  int16_t at;
};
constexpr int32_t kOffsets = (2 * kBandReach + 1) * (2 * kBandReach + 1) - 1;
struct Offsets {
  BandOffset by_distance[kOffsets] = {};
  constexpr Offsets() {
    int32_t count = 0;
    for (int32_t square = 1; square <= 2 * kBandReach * kBandReach; ++square) {
      for (int32_t y = -kBandReach; y <= kBandReach; ++y) {
        for (int32_t x = -kBandReach; x <= kBandReach; ++x) {
          if (x * x + y * y != square) continue;
          by_distance[count++] = {
              static_cast<int8_t>(x), static_cast<int8_t>(y),
              static_cast<int16_t>(BandDisparities::At(x, y) - BandDisparities::At(0, 0))};
        }
      }
    }
  }
};
constexpr Offsets kNearestFirst;

// The two surfaces of a pixel, and what is known of its coverage before unmixing.
struct BandPixel {
  bool is_split;    // False: no edge is near, and the pixel has one surface.
  int32_t implied;  // Coverage that the disparity map implies: 0 or kWhole.
  int32_t coverage;
  int32_t low, high;   // Disparities of both surfaces.
  int32_t far_weight;  // Confidence of the pixel's light as light of the far surface.
};

// Returns the weight of a far pixel's light, given its squared distance to the edge. Pixels near an
// edge have a small weight, because the disparity map may miss a strand that lies next to another
// strand.
int16_t WeightByDistance(int32_t square) {
  return static_cast<int16_t>(square <= 2 ? kKnown / 16 : square <= 5 ? kKnown / 4 : kKnown);
}

// Finds the surfaces of a pixel from the nearest pixel beyond an edge. Among equally distant pixels,
// the one with the largest disparity counts, so that mirrored maps have mirrored surfaces.
BandPixel FindBandPixel(const BandDisparities& around, int32_t at) {
  const int32_t here = around.disparity[at];
  int32_t other = here, square = 0;  // Disparity beyond the edge, and squared distance in pixels.
  for (const BandOffset& offset : kNearestFirst.by_distance) {
    const int32_t distance = offset.x * offset.x + offset.y * offset.y;
    if (square != 0 && distance > square) break;
    const int32_t there = around.disparity[at + offset.at];
    if (Abs(there - here) <= kThinStep || (square != 0 && there <= other)) continue;
    other = there;
    square = distance;
  }
  const int32_t implied = other > here ? 0 : kWhole;
  const int32_t far_weight = other == here ? kKnown : other < here ? 0 : WeightByDistance(square);
  return {other != here, implied, implied, Min(here, other), Max(here, other), far_weight};
}

uint64_t BinsOf(const CoverageMap& map, int32_t low, int32_t high) {
  return (map.BinOf(high) << 1) - map.BinOf(low);
}

// Disparities of a row of adjacent tiles, with a border of one pixel. Beyond the picture, the
// outermost pixels of the picture are repeated.
class TileRow {
 public:
  TileRow(const Input& input, int32_t left, int32_t top, int32_t columns) {
    const int32_t right = input.width - 1;
    const int32_t first = Max(left - 1, 0), end = Min(left + columns, right) + 1;
    for (int32_t y = 0; y < kCoverageTile + 2; ++y) {
      const int16_t* from = input.disparity.Row(Clamp(top + y - 1, 0, input.height - 1));
      int16_t* to = At(-1, y - 1);
      std::memcpy(to + first - left + 1, from + first,
                  static_cast<size_t>(end - first) * sizeof(*to));
      if (first == left) to[0] = from[0];
      for (int32_t x = end - left + 1; x < columns + 2; ++x) to[x] = from[right];
    }
  }

  int16_t* At(int32_t x, int32_t y) { return samples_ + (y + 1) * kStride + x + kCoverageTile; }

  // Finds the range of the disparities of a tile and of the one-pixel border around the tile.
  void FindRange(int32_t x, int32_t* low, int32_t* high) {
    int16_t lows[kCoverageTile + 2], highs[kCoverageTile + 2];
    std::memcpy(lows, At(x - 1, -1), sizeof(lows));
    std::memcpy(highs, lows, sizeof(highs));
    for (int32_t y = 0; y <= kCoverageTile; ++y) {
      const int16_t* row = At(x - 1, y);
      for (int32_t k = 0; k < kCoverageTile + 2; ++k) {
        lows[k] = row[k] < lows[k] ? row[k] : lows[k];
        highs[k] = row[k] > highs[k] ? row[k] : highs[k];
      }
    }
    *low = INT16_MAX;
    *high = INT16_MIN;
    for (int32_t k = 0; k < kCoverageTile + 2; ++k) {
      *low = Min(*low, lows[k]);
      *high = Max(*high, highs[k]);
    }
  }

  // Returns the number of pixels of a tile that have a nearer neighbour.
  int32_t CountRagged(const simd::Kernels& kernels, int32_t x) {
    int32_t count = 0;
    for (int32_t y = 0; y < kCoverageTile; ++y) {
      uint16_t bits;
      kernels.BesideSteps(At(x, y), kStride, kCoverageTile, static_cast<int16_t>(kThinStep), &bits);
      ForEachBit(bits, [&](int32_t) { ++count; });
    }
    return count;
  }

  // Returns the number of pixels of a tile that belong to a strand one pixel wide, because two
  // opposite neighbours are farther.
  int32_t CountStrands(int32_t x) {
    int32_t count = 0;
    for (int32_t y = 0; y < kCoverageTile; ++y) {
      const int16_t* const row = At(x, y);
      for (int32_t k = 0; k < kCoverageTile; ++k) {
        const int32_t beyond = row[k] - kThinStep;
        const bool across = row[k - 1] < beyond && row[k + 1] < beyond;
        const bool down = row[k - kStride] < beyond && row[k + kStride] < beyond;
        count += across || down ? 1 : 0;
      }
    }
    return count;
  }

  static constexpr int32_t kMostTiles = 16;

 private:
  static constexpr int32_t kStride = (kMostTiles + 2) * kCoverageTile;
  int16_t samples_[(kCoverageTile + 3) * kStride];
};

// A pixel is a mixture if its given coverage differs from the coverage implied by the disparity map
// by more than kLeastMixed (kAlphaBits).
constexpr int32_t kLeastMixed = kWhole / 16;

// Writes the surfaces, the coverage and the light of the pixels of a tile. find(x, y, at) returns
// the BandPixel of pixel (x, y) of the picture, at index `at` of `around`.
template <class Disparities, class Find>
void StartPixels(const Input& input, int32_t column, int32_t row, const Disparities& around,
                 const Find& find) {
  const CoverageMap& map = *input.coverage;
  const int32_t left = column * kCoverageTile, top = row * kCoverageTile;
  const int32_t columns = Min(kCoverageTile, map.width - left);
  uint64_t bins = 0;
  int32_t low = INT16_MAX, high = INT16_MIN;
  for (int32_t y = top; y < top + kCoverageTile; ++y) {
    int16_t light[3 * kCoverageTile] = {};
    if (y < map.height) input.Light(0, left, y, columns, light);
    const size_t first = map.At(left, y);
    FarCell* const cells = &map.FarAt(left, y);
    for (int32_t k = 0; k < kCoverageTile; ++k) {
      const size_t to = first + static_cast<size_t>(k);
      const int32_t at = Disparities::At(k, y - top);
      const BandPixel pixel = find(left + k, y, at);
      const bool inside = y < map.height && k < columns;
      const int16_t near =
          pixel.is_split ? SmoothNear(around, at, pixel.high) : around.disparity[at];
      bins |= map.BinOf(near);
      if (inside && pixel.is_split) {
        low = Min(low, pixel.low);
        high = Max(high, near);
      }
      FarCell& far = cells[k];
      far.disparity = static_cast<int16_t>(pixel.low);
      far.weight = static_cast<int16_t>(inside ? pixel.far_weight : 0);
      std::memcpy(far.rgb, light + 3 * k, sizeof(far.rgb));
      map.near[to] = inside ? near : kNowhere;
      map.alpha[to] = pixel.is_split ? static_cast<uint8_t>(pixel.implied) : kUnsplit;
      map.first[to] = static_cast<uint8_t>(pixel.coverage);
    }
  }
  CoverageTile& tile = map.Tile(column, row);
  tile.near_bins = bins;
  tile.low = static_cast<int16_t>(low);
  tile.high = static_cast<int16_t>(high);
  PullTile(column, row, map);
}

}  // namespace

void FindRagged(const Input& input, int32_t first, int32_t last, int32_t row) {
  const CoverageMap& map = *input.coverage;
  for (int32_t from = first; from < last; from += TileRow::kMostTiles) {
    const int32_t count = Min(TileRow::kMostTiles, last - from);
    TileRow tiles(input, from * kCoverageTile, row * kCoverageTile, count * kCoverageTile);
    for (int32_t k = 0; k < count; ++k) {
      CoverageTile& tile = map.Tile(from + k, row);
      int32_t low, high;
      tiles.FindRange(k * kCoverageTile, &low, &high);
      const bool ragged = high - low > kThinStep &&
                          (HasGiven(input) ||
                           (tiles.CountRagged(*input.kernels, k * kCoverageTile) >= kLeastRagged &&
                            tiles.CountStrands(k * kCoverageTile) >= kLeastStrands));
      tile = {BinsOf(map, low, high), INT16_MAX, INT16_MIN, ragged ? uint8_t{1} : uint8_t{0}, 0, 0};
    }
  }
}

void ClearTile(const Input& input, int32_t column, int32_t row) {
  const CoverageMap& map = *input.coverage;
  const int32_t left = column * kCoverageTile, count = Min(kCoverageTile, map.width - left);
  for (int32_t y = row * kCoverageTile; y < Min((row + 1) * kCoverageTile, map.height); ++y) {
    const size_t to = map.At(left, y);
    for (int32_t x = count; x < kCoverageTile; ++x)
      map.near[to + static_cast<size_t>(x)] = kNowhere;
    std::memcpy(map.near + to, input.disparity.Row(y) + left,
                static_cast<size_t>(count) * sizeof(*map.near));
    std::memset(map.first + to, kWhole, kCoverageTile);
  }
}

void StartTile(const Input& input, int32_t column, int32_t row) {
  const BandDisparities around(input, column, row);
  StartPixels(input, column, row, around,
              [&](int32_t, int32_t, int32_t at) { return FindBandPixel(around, at); });
}

void StartGiven(const Input& input, int32_t column, int32_t row) {
  const GivenDisparities around(input, column, row);
  const SurfaceSearch search(around);
  CoverageTile& tile = input.coverage->Tile(column, row);
  StartPixels(input, column, row, around, [&](int32_t x, int32_t y, int32_t at) -> BandPixel {
    const int32_t here = around.disparity[at];
    Surfaces surfaces;
    if (!search.FindSurfaces(at, &surfaces)) return {false, kWhole, kWhole, here, here, kKnown};
    const int32_t implied = surfaces.IsNear(here) ? kWhole : 0;
    int32_t alpha = implied;
    if (x < input.width && y < input.height) {
      alpha = (input.given_coverage.Row(y)[x] * kWhole + 127) / 255;
    }
    if (Abs(alpha - implied) > kLeastMixed) tile.mixed = 1;
    return {true, implied, alpha, surfaces.low, surfaces.high, FarWeight(alpha)};
  });
}

}  // namespace starfocus
