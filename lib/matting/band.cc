// SPDX-License-Identifier: Apache-2.0
// Finds the pixels near depth edges (the band), and their two surfaces.
#include <algorithm>
#include <cstring>

#include "lib/matting/coverage_tile.h"

namespace starfocus {
namespace {

// On a ramp, the steps to both adjacent pixels are at least kLeastRamp, and the larger step is at
// most kRampRatio times the smaller step.
constexpr int32_t kLeastRamp = 1 << (kDisparityBits - 1);
constexpr int32_t kRampRatio = 4;

// Returns true if the middle of three pixels is on a ramp. The arguments are the disparities of the
// pixels in kDisparityBits. Two edges are a ramp with any ratio and up to kRampRadius pixels away,
// because repaired maps of networks have narrow strips of another disparity along outlines.
bool IsRamp(int32_t before, int32_t here, int32_t after, bool adjacent) {
  if (Abs(after - before) < 2 * kLeastRamp) return false;  // most pixels
  const int32_t sign = after < before ? -1 : 1;
  const int32_t a = sign * (here - before), b = sign * (after - here);
  if (Min(a, b) > kThinStep) return true;
  return adjacent && Min(a, b) >= kLeastRamp && Max(a, b) <= kRampRatio * Min(a, b);
}

bool IsBetween(const int16_t* here) {
  constexpr int32_t kSide = GivenDisparities::kSide;
  constexpr int32_t kOpposite[] = {1, kSide - 1, kSide, kSide + 1};
  for (const int32_t step : kOpposite) {
    for (int32_t reach = 1; reach <= kRampRadius; ++reach) {
      if (IsRamp(here[-reach * step], here[0], here[reach * step], reach == 1)) return true;
    }
  }
  return false;
}

// Rank of a pixel in a search: squared distance, square around the start, row, column. The lowest
// rank wins. Scale: 12 bits for the squared distance, at most 2 kGivenRadius^2 = 2048; 6 bits for
// the square; 7 bits each for row and column.
constexpr uint32_t kNotFound = UINT32_MAX;

uint32_t RankOf(int32_t dx, int32_t dy) {
  static_assert(kGivenRadius == 32);
  const int32_t ring = Max(Abs(dx), Abs(dy));
  return static_cast<uint32_t>(dx * dx + dy * dy) << 20 | static_cast<uint32_t>(ring) << 14 |
         static_cast<uint32_t>(dy + kGivenRadius) << 7 | static_cast<uint32_t>(dx + kGivenRadius);
}
int32_t DistanceOf(uint32_t rank) { return static_cast<int32_t>(rank >> 20); }

// Disparities in and around a tile: the input for finding the pixels near edges and their near
// disparities.
using BandDisparities = DisparitiesAround<kBandRadius + 2>;

// A tile counts as thin structure if at least kLeastRagged of its pixels have a nearer neighbour,
// and if at least kLeastStrands of its pixels belong to strands one pixel wide. In tiles of hair,
// 38 or more pixels have a nearer neighbour. Tiles with a straight edge have 16 to 23 pixels with a
// nearer neighbour. Where wires two pixels wide cross, a tile has up to 54, but no such strand.
// Both counts depend on the disparity map alone, so that noise in the views cannot change them.
constexpr int32_t kLeastRagged = 36, kLeastStrands = 2;

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

// Returns the surfaces of a pixel from the disparity and the squared distance beyond an edge.
BandPixel BandPixelOf(int32_t here, int32_t beyond, int32_t square) {
  const int32_t implied = beyond > here ? 0 : kWhole;
  const int32_t far_weight = square == 0 ? kKnown : beyond < here ? 0 : WeightByDistance(square);
  return {square != 0, implied, implied, Min(here, beyond), Max(here, beyond), far_weight};
}

uint64_t BinsOf(const CoverageMap& map, int32_t low, int32_t high) {
  return (map.BinOf(high) << 1) - map.BinOf(low);
}

using TileDisparities = DisparitiesAround<1>;

// Returns the number of pixels of a tile that have a nearer neighbour.
int32_t CountRagged(const simd::Kernels& kernels, const TileDisparities& around) {
  int32_t count = 0;
  for (int32_t y = 0; y < kCoverageTile; ++y) {
    uint16_t bits;
    kernels.BesideSteps(around.disparity + TileDisparities::At(0, y), TileDisparities::kSide,
                        kCoverageTile, static_cast<int16_t>(kThinStep), &bits);
    ForEachBit(bits, [&](int32_t) { ++count; });
  }
  return count;
}

// Returns the number of pixels of a tile that belong to a strand one pixel wide, because two
// opposite neighbours are farther.
int32_t CountStrands(const TileDisparities& around) {
  int32_t count = 0;
  ForPixels({0, 0, kCoverageTile, kCoverageTile}, [&](int32_t x, int32_t y) {
    const int16_t* const here = around.disparity + TileDisparities::At(x, y);
    const int32_t beyond = *here - kThinStep;
    const bool across = here[-1] < beyond && here[1] < beyond;
    const bool down =
        here[-TileDisparities::kSide] < beyond && here[TileDisparities::kSide] < beyond;
    count += across || down ? 1 : 0;
  });
  return count;
}

// Replaces the near disparity of each pixel of a row of a tile by a weighted mean of the
// disparities in the 5x5 pixels around it that differ from it by at most 2 pixels, if there are
// any. `here` points to the disparity of the first pixel; rows are `stride` samples apart.
void SmoothNear(const int16_t* here, int32_t stride, int16_t* near) {
  constexpr int32_t kWithin = 2 << kDisparityBits;
  constexpr int16_t kWeights[5] = {1, 4, 6, 4, 1};
  int32_t sum[kCoverageTile] = {};
  int16_t weights[kCoverageTile] = {}, low[kCoverageTile], high[kCoverageTile];
  for (int32_t k = 0; k < kCoverageTile; ++k) {
    low[k] = static_cast<int16_t>(Max(near[k] - kWithin, INT16_MIN));
    high[k] = static_cast<int16_t>(Min(near[k] + kWithin, INT16_MAX));
  }
  for (int32_t y = 0; y < 5; ++y) {
    int16_t part[kCoverageTile] = {};  // At most 6 * 16 * kWithin.
    for (int32_t x = 0; x < 5; ++x) {
      const int16_t* const there = here + (y - 2) * stride + x - 2;
      const auto weight = static_cast<int16_t>(kWeights[x] * kWeights[y]);
      for (int32_t k = 0; k < kCoverageTile; ++k) {
        const bool within = there[k] >= low[k] && there[k] <= high[k];
        const int16_t counted = within ? weight : int16_t{0};
        part[k] = static_cast<int16_t>(part[k] + counted * (there[k] - near[k]));
        weights[k] = static_cast<int16_t>(weights[k] + counted);
      }
    }
    for (int32_t k = 0; k < kCoverageTile; ++k) sum[k] += part[k];
  }
  for (int32_t k = 0; k < kCoverageTile; ++k) {
    if (weights[k] == 0) continue;
    const int32_t half = sum[k] < 0 ? -(weights[k] / 2) : weights[k] / 2;
    near[k] = static_cast<int16_t>(near[k] + (sum[k] + half) / weights[k]);
  }
}

// A pixel is a mixture if its given coverage is above kPure (kAlphaBits) and below kLeastWhole. The
// tolerance hides the noise of coverage that was computed or compressed.
constexpr int32_t kPure = 2;

// Sets bit k of rows[y] if pixel (k, y) of a tile has a mixture at most kBandRadius pixels away
// along both axes.
void FindMixtures(const Input& input, int32_t column, int32_t row, uint32_t* rows) {
  constexpr int32_t kSide = kCoverageTile + 2 * kBandRadius;
  static_assert(kSide <= 32, "a row of the tile and its surroundings has one bit per pixel");
  const int32_t left = column * kCoverageTile - kBandRadius,
                top = row * kCoverageTile - kBandRadius;
  const Rect around = Clipped({left, top, kSide, kSide}, input.width, input.height);
  std::fill_n(rows, kCoverageTile, 0U);
  for (int32_t y = around.y; y < around.y + around.height; ++y) {
    uint32_t mixed = 0, wide = 0;  // bit k: column left + k
    for (int32_t x = around.x; x < around.x + around.width; ++x) {
      const int32_t alpha = GivenAlpha(input.given_coverage.Row(y)[x]);
      mixed |= uint32_t{alpha > kPure && alpha < kLeastWhole} << (x - left);
    }
    for (int32_t k = 0; k <= 2 * kBandRadius; ++k) wide |= mixed >> k;
    for (int32_t k = Max(0, y - top - 2 * kBandRadius); k <= Min(y - top, kCoverageTile - 1); ++k) {
      rows[k] |= wide;
    }
  }
}

// Writes the surfaces, the coverage and the light of the pixels of a tile. find(y, at, pixels)
// writes the BandPixels of row y of the tile, whose first pixel has the index `at` in `around`.
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
    FarLight* const patches = &map.FarAt(left, y);
    BandPixel pixels[kCoverageTile];
    const int32_t at = Disparities::At(0, y - top);
    find(y, at, pixels);
    int16_t smooth[kCoverageTile];
    for (int32_t k = 0; k < kCoverageTile; ++k) smooth[k] = static_cast<int16_t>(pixels[k].high);
    SmoothNear(around.disparity + at, Disparities::kSide, smooth);
    for (int32_t k = 0; k < kCoverageTile; ++k) {
      const size_t to = first + static_cast<size_t>(k);
      const BandPixel& pixel = pixels[k];
      const bool inside = y < map.height && k < columns;
      const int16_t near = pixel.is_split ? smooth[k] : around.disparity[at + k];
      bins |= map.BinOf(near);
      if (inside && pixel.is_split) {
        low = Min(low, pixel.low);
        high = Max(high, near);
      }
      FarLight& far = patches[k];
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
}

}  // namespace

SurfaceSearch::SurfaceSearch(const GivenDisparities& around) : around_(around) {
  for (int32_t y = kRampRadius; y < kSide - kRampRadius; ++y) {
    for (int32_t x = kRampRadius; x < kSide - kRampRadius; ++x) {
      const int32_t at = y * kSide + x;
      on_ramp_[at] = IsBetween(around.disparity + at);
      Patch& patch = patches_[y / kPatchSide * kPatches + x / kPatchSide];
      if (on_ramp_[at]) {
        patch.has_ramp = true;
      } else {
        patch.Add(around.disparity[at]);
      }
    }
  }
  for (const Patch& patch : patches_) {
    if (patch.least > patch.greatest) continue;
    all_.Add(patch.least);
    all_.Add(patch.greatest);
  }
}

Found SurfaceSearch::FindNearest(int32_t at, int32_t low, int32_t high) const {
  if (high < all_.least || low > all_.greatest) return {around_.disparity[at], INT32_MAX};
  const int32_t x = at % kSide, y = at / kSide;
  uint32_t rank = kNotFound;
  // Lowers `rank` to the ranks of the matching pixels of a patch.
  const auto search = [&](int32_t column, int32_t row) {
    const Patch& patch = patches_[row * kPatches + column];
    if (patch.greatest < low || patch.least > high) return;
    const int32_t left = Max(column * kPatchSide, x - kGivenRadius),
                  right = Min(column * kPatchSide + kPatchSide - 1, x + kGivenRadius),
                  top = Max(row * kPatchSide, y - kGivenRadius),
                  bottom = Min(row * kPatchSide + kPatchSide - 1, y + kGivenRadius);
    const int32_t nearest = Clamp(x, left, right) - x;
    if (!patch.has_ramp && patch.least >= low && patch.greatest <= high) {
      // All pixels of the patch match, and the nearest one has the lowest rank.
      rank = std::min(rank, RankOf(nearest, Clamp(y, top, bottom) - y));
      return;
    }
    for (int32_t v = top; v <= bottom; ++v) {
      if (nearest * nearest + (v - y) * (v - y) > DistanceOf(rank)) continue;
      for (int32_t u = left; u <= right; ++u) {
        const int32_t there = v * kSide + u, disparity = around_.disparity[there];
        if (on_ramp_[there] || disparity < low || disparity > high) continue;
        rank = std::min(rank, RankOf(u - x, v - y));
      }
    }
  };
  const int32_t column = x / kPatchSide, row = y / kPatchSide;
  for (int32_t r = 0; r <= kGivenRadius / kPatchSide; ++r) {
    const int32_t least = (r - 1) * kPatchSide + 1;  // distance to the nearest patch of the square
    if (r > 0 && least * least > DistanceOf(rank)) break;
    for (int32_t v = Max(row - r, 0); v <= Min(row + r, kPatches - 1); ++v) {
      const int32_t step = Abs(v - row) == r ? 1 : 2 * r;
      for (int32_t u = column - r; u <= column + r; u += step) {
        if (u >= 0 && u < kPatches) search(u, v);
      }
    }
  }
  if (rank == kNotFound) return {around_.disparity[at], INT32_MAX};
  const int32_t dy = static_cast<int32_t>(rank >> 7 & 127) - kGivenRadius,
                dx = static_cast<int32_t>(rank & 127) - kGivenRadius;
  return {around_.disparity[at + dy * kSide + dx], DistanceOf(rank)};
}

bool SurfaceSearch::FindSurfaces(int32_t at, Surfaces* surfaces) const {
  const int32_t here = around_.disparity[at];
  if (on_ramp_[at]) {
    *surfaces = {FindNearest(at, INT16_MIN, here - 1).disparity,
                 FindNearest(at, here + 1, INT16_MAX).disparity};
    if (surfaces->high - surfaces->low > kThinStep) return true;
  }
  const Found nearer = FindNearest(at, here + kThinStep + 1, INT16_MAX);
  const Found farther = FindNearest(at, INT16_MIN, here - kThinStep - 1);
  const bool is_near = farther.distance <= nearer.distance;
  *surfaces = {is_near ? farther.disparity : here, is_near ? here : nearer.disparity};
  return Min(nearer.distance, farther.distance) != INT32_MAX;
}

void FindRagged(const Input& input, int32_t column, int32_t row) {
  const CoverageMap& map = *input.coverage;
  const TileDisparities around(input, column, row);
  simd::DisparityRange ranges[2];
  static_assert(TileDisparities::kSide <= 2 * simd::kSliceLanes);
  input.kernels->FindRanges(around.disparity, TileDisparities::kSide, TileDisparities::kSide,
                            TileDisparities::kSide, ranges);
  const int32_t low = Min(ranges[0].low, ranges[1].low);
  const int32_t high = Max(ranges[0].high, ranges[1].high);
  const bool ragged = high - low > kThinStep &&
                      (HasGiven(input) || (CountRagged(*input.kernels, around) >= kLeastRagged &&
                                           CountStrands(around) >= kLeastStrands));
  map.Tile(column, row) = {BinsOf(map, low, high),           INT16_MAX, INT16_MIN,
                           ragged ? uint8_t{1} : uint8_t{0}, 0,         0};
}

void ClearTile(const Input& input, int32_t column, int32_t row) {
  const CoverageMap& map = *input.coverage;
  const int32_t left = column * kCoverageTile, count = Min(kCoverageTile, map.width - left);
  for (int32_t y = row * kCoverageTile; y < Min((row + 1) * kCoverageTile, map.height); ++y) {
    const size_t to = map.At(left, y);
    int16_t* const near = map.near + to;
    const int16_t* const from = input.disparity.Row(y) + left;
    std::memset(map.first + to, kWhole, kCoverageTile);
    if (count == kCoverageTile) {  // a known size, which takes one or two instructions to copy
      std::memcpy(near, from, kCoverageTile * sizeof(*near));
      continue;
    }
    for (int32_t x = 0; x < kCoverageTile; ++x) near[x] = x < count ? from[x] : kNowhere;
  }
}

void StartTile(const Input& input, int32_t column, int32_t row) {
  const BandDisparities around(input, column, row);
  StartPixels(input, column, row, around, [&](int32_t, int32_t at, BandPixel* pixels) {
    const int16_t* const here = around.disparity + at;
    int16_t beyond[kCoverageTile], square[kCoverageTile];
    input.kernels->FindBeyond(here, BandDisparities::kSide, static_cast<int16_t>(kThinStep), beyond,
                              square);
    for (int32_t k = 0; k < kCoverageTile; ++k) {
      pixels[k] = BandPixelOf(here[k], beyond[k], square[k]);
    }
  });
  PullTile(column, row, *input.coverage);
}

void StartGiven(const Input& input, int32_t column, int32_t row) {
  const GivenDisparities around(input, column, row);
  const SurfaceSearch search(around);
  uint32_t mixtures[kCoverageTile];
  FindMixtures(input, column, row, mixtures);
  CoverageTile& tile = input.coverage->Tile(column, row);
  const auto find = [&](int32_t x, int32_t y, int32_t at) -> BandPixel {
    const int32_t here = around.disparity[at];
    const BandPixel one_surface = {false, kWhole, kWhole, here, here, kKnown};
    Surfaces surfaces;
    if (x >= input.width || y >= input.height || !search.FindSurfaces(at, &surfaces)) {
      return one_surface;
    }
    const int32_t implied = surfaces.IsNear(here) ? kWhole : 0;
    const int32_t alpha = GivenAlpha(input.given_coverage.Row(y)[x]);
    const bool agrees =
        (implied > 0 ? alpha >= kLeastWhole : alpha <= kPure) && !search.IsOnRamp(at);
    if (agrees && (mixtures[y % kCoverageTile] >> x % kCoverageTile & 1) == 0) return one_surface;
    tile.mixed = 1;
    return {true, implied, alpha, surfaces.low, surfaces.high, FarWeight(alpha)};
  };
  StartPixels(input, column, row, around, [&](int32_t y, int32_t at, BandPixel* pixels) {
    for (int32_t k = 0; k < kCoverageTile; ++k) {
      pixels[k] = find(column * kCoverageTile + k, y, at + k);
    }
  });
  if (input.views == 1) UnmixFar(input, column, row);
  PullTile(column, row, *input.coverage);
}

}  // namespace starfocus
