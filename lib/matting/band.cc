// SPDX-License-Identifier: Apache-2.0
#include <cstring>

#include "lib/matting/coverage_tile.h"
#include "lib/matting/surface_search.h"

namespace starfocus {
namespace {

// Disparities in and around a tile: the input for finding the pixels near edges and their near
// disparities.
using BandDisparities = DisparitiesAround<kBandReach + 2>;

// A tile counts as thin structure if at least kLeastRagged of its pixels have a nearer neighbour.
// In tiles of hair, 38 or more pixels have a nearer neighbour. Tiles with a straight edge have 16
// to 23 pixels with a nearer neighbour, and tiles with a wire two pixels wide have up to 40.
constexpr int32_t kLeastRagged = 36;

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

// Position of a pixel relative to the nearest edge.
struct BandPixel {
  int32_t side;      // 1: on the near side, -1: on the far side, 0: no edge within kBandReach.
  int32_t other;     // Disparity of the nearest pixel beyond the edge.
  int32_t distance;  // Squared distance in pixels to the nearest pixel beyond the edge.
};

BandPixel FindBandPixel(const BandDisparities& around, int32_t at) {
  const int32_t here = around.disparity[at];
  for (const BandOffset& offset : kNearestFirst.by_distance) {
    const int32_t other = around.disparity[at + offset.at];
    if (Abs(other - here) <= kThinStep) continue;
    return {other < here ? 1 : -1, other, offset.x * offset.x + offset.y * offset.y};
  }
  return {0, here, 0};
}

// Returns the weight of a far pixel's light, given its squared distance to the edge. Pixels near an
// edge have a small weight, because the disparity map may miss a strand that lies next to another
// strand.
int16_t WeightByDistance(int32_t square) {
  return static_cast<int16_t>(square <= 2 ? kKnown / 16 : square <= 5 ? kKnown / 4 : kKnown);
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

  static constexpr int32_t kMostTiles = 16;

 private:
  static constexpr int32_t kStride = (kMostTiles + 2) * kCoverageTile;
  int16_t samples_[(kCoverageTile + 3) * kStride];
};

// A pixel is a mixture if its given coverage differs from the coverage implied by the disparity map
// by more than kLeastMixed (kAlphaBits).
constexpr int32_t kLeastMixed = kWhole / 16;

class GivenStarter {
 public:
  GivenStarter(const Input& input, int32_t column, int32_t row)
      : input_(input),
        map_(*input.coverage),
        left_(column * kCoverageTile),
        top_(row * kCoverageTile),
        around_(input_, column, row),
        search_(around_),
        tile_(map_.Tile(column, row)) {}

  void Start() {
    tile_.near_bins = 0;
    const int32_t columns = Min(kCoverageTile, map_.width - left_);
    for (int32_t y = top_; y < top_ + kCoverageTile; ++y) {
      int16_t light[3 * kCoverageTile] = {};
      const bool inside = y < map_.height;
      if (inside) input_.Light(0, left_, y, columns, light);
      for (int32_t k = 0; k < kCoverageTile; ++k) {
        StartPixel(left_ + k, y);
        FarCell& far = map_.FarAt(left_ + k, y);
        std::memcpy(far.rgb, light + 3 * k, sizeof(far.rgb));
        if (inside && k < columns) continue;
        far.weight = 0;
        map_.near[map_.At(left_ + k, y)] = kNowhere;
      }
    }
  }

 private:
  void StartPixel(int32_t x, int32_t y) {
    const size_t to = map_.At(x, y);
    const int32_t at = GivenDisparities::At(x - left_, y - top_);
    const int16_t here = around_.disparity[at];
    FarCell& far = map_.FarAt(x, y);
    Surfaces surfaces;
    if (search_.FindSurfaces(at, &surfaces)) {
      map_.near[to] = SmoothNear(around_, at, surfaces.high);
      far.disparity = static_cast<int16_t>(surfaces.low);
      map_.alpha[to] = surfaces.IsNear(here) ? uint8_t{kWhole} : uint8_t{0};
      TakePixel(x, y);
    } else {
      map_.near[to] = here;
      far.disparity = here;
      map_.alpha[to] = kUnsplit;
      map_.first[to] = kWhole;
      far.weight = kKnown;
    }
    tile_.near_bins |= map_.BinOf(map_.near[to]);
  }

  // Stores the given coverage of a pixel that has two surfaces.
  void TakePixel(int32_t x, int32_t y) {
    if (x >= map_.width || y >= map_.height) return;
    const size_t to = map_.At(x, y);
    FarCell& far = map_.FarAt(x, y);
    const int32_t alpha = (input_.given_coverage.Row(y)[x] * kWhole + 127) / 255;
    if (Abs(alpha - map_.alpha[to]) > kLeastMixed) tile_.mixed = 1;
    map_.first[to] = static_cast<uint8_t>(alpha);
    far.weight = static_cast<int16_t>(FarWeight(alpha));
    tile_.low = static_cast<int16_t>(Min(tile_.low, far.disparity));
    tile_.high = static_cast<int16_t>(Max(tile_.high, map_.near[to]));
  }

  const Input& input_;
  const CoverageMap& map_;
  const int32_t left_, top_;
  const GivenDisparities around_;
  const SurfaceSearch search_;
  CoverageTile& tile_;
};

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
      const bool ragged =
          high - low > kThinStep &&
          (HasGiven(input) || tiles.CountRagged(*input.kernels, k * kCoverageTile) >= kLeastRagged);
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
  const CoverageMap& map = *input.coverage;
  const BandDisparities around(input, column, row);
  CoverageTile& tile = map.Tile(column, row);
  tile.near_bins = 0;
  const int32_t left = column * kCoverageTile, top = row * kCoverageTile;
  const int32_t columns = Min(kCoverageTile, input.width - left);
  const int32_t rows = Min(kCoverageTile, input.height - top);
  for (int32_t y = 0; y < kCoverageTile; ++y) {
    int16_t light[3 * kCoverageTile];
    if (y < rows) input.Light(0, left, top + y, columns, light);
    for (int32_t x = 0; x < kCoverageTile; ++x) {
      const size_t to = map.At(left + x, top + y);
      const int32_t at = BandDisparities::At(x, y);
      const int16_t here = around.disparity[at];
      const BandPixel pixel = FindBandPixel(around, at);
      map.near[to] = pixel.side == 0 ? here : SmoothNear(around, at, Max(here, pixel.other));
      FarCell& far = map.FarAt(left + x, top + y);
      far.disparity = static_cast<int16_t>(Min(here, pixel.other));
      map.alpha[to] = pixel.side == 0 ? kUnsplit : pixel.side > 0 ? kWhole : 0;
      map.first[to] = pixel.side < 0 ? 0 : kWhole;
      tile.near_bins |= map.BinOf(map.near[to]);
      if (y >= rows || x >= columns) {
        far.weight = 0;
        map.near[to] = kNowhere;
        continue;
      }
      far.weight = pixel.side == 0 ? kKnown : pixel.side > 0 ? 0 : WeightByDistance(pixel.distance);
      std::memcpy(far.rgb, light + 3 * x, sizeof(far.rgb));
      if (pixel.side == 0) continue;
      tile.low = static_cast<int16_t>(Min(tile.low, far.disparity));
      tile.high = static_cast<int16_t>(Max(tile.high, map.near[to]));
    }
  }
  PullTile(column, row, map);
}

void StartGiven(const Input& input, int32_t column, int32_t row) {
  GivenStarter(input, column, row).Start();
  PullTile(column, row, *input.coverage);
}

}  // namespace starfocus
