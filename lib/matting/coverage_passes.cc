// SPDX-License-Identifier: Apache-2.0
// The passes over tiles that compute the coverage map, and the steps that unmix pixels.
#include <cstring>

#include "lib/base/config.h"
#include "lib/matting/colour.h"
#include "lib/matting/coverage.h"
#include "lib/matting/coverage_tile.h"

namespace starfocus {
namespace {

constexpr int32_t kAround = simd::kNearRadius;
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

// Returns the part of a pixel that the near surface covers, as far as its colours can be trusted;
// `guess` replaces the rest. `near_weight` is the sum of the weights of the samples of `near`.
int32_t AlphaOf(const int32_t* near, int32_t near_weight, const int32_t* far, const int32_t* mixed,
                int32_t guess) {
  const ColourLine line = ColourLineOf<kColourBits>(near, far, mixed);
  const int64_t contrast = line.contrast;
  if (contrast == 0) return guess;
  const int64_t beside = line.distance - line.along * line.along / contrast;
  const int64_t square = kNoise + contrast / 16;
  const int64_t part = line.along < 0 ? 0 : line.along > contrast ? contrast : line.along;
  // The difference of alpha and guess, multiplied by the trust in the contrast: at most kWhole,
  // with 8 more fractional bits.
  const int64_t change = (part * kWhole - guess * contrast) * 256 / (contrast + kContrastNoise);
  const int32_t known = Min(near_weight, 1 << kNearBits);
  return guess + static_cast<int32_t>(
                     RoundShift(change * known * square / (square + beside), 8 + kNearBits));
}

// Calls visit(x, y, alpha, patch) for each pixel (x, y) of the picture in a tile that is near an
// edge, if the light of the far surface (`patch`) is known. The function weight_of(x, y) returns
// the weight of a pixel in a mean of the near light.
template <class Weight, class Visit>
void ForEachSplit(const Input& input, int32_t column, int32_t row, const Weight& weight_of,
                  const Visit& visit) {
  const CoverageMap& map = *input.coverage;
  // Planes of the pixels in and around the tile.
  constexpr size_t kPlane = kSide * kSide;
  int16_t light[3 * kPlane] = {}, nears[kPlane] = {}, weights[kPlane] = {};
  const int32_t left = column * kCoverageTile - kAround, top = row * kCoverageTile - kAround;
  const Rect from = Clipped({left, top, kSide, kSide}, map.width, map.height);
  for (int32_t y = from.y; y < from.y + from.height; ++y) {
    int16_t rgb[3 * kSide + simd::kPadding / sizeof(int16_t)];
    const auto at = static_cast<size_t>((y - top) * kSide + from.x - left);
    const auto count = static_cast<size_t>(from.width);
    input.Light(0, from.x, y, from.width, rgb);
    input.kernels->Deinterleave(rgb, count, kPlane, light + at);
    std::memcpy(nears + at, map.near + map.At(from.x, y), count * sizeof(*nears));
    for (size_t k = 0; k < count; ++k) {
      weights[at + k] = static_cast<int16_t>(weight_of(from.x + static_cast<int32_t>(k), y));
    }
  }
  FarTile far;
  PushTile(column, row, map, &far);
  const Rect pixels = map.PixelsOf(column, row);
  for (int32_t y = 0; y < pixels.height; ++y) {
    const auto first = static_cast<size_t>((y + kAround) * kSide + kAround);
    const int16_t* const here = light + first;
    const int16_t* const colours[] = {here, here + kPlane, here + 2 * kPlane};
    int16_t sums[4][simd::kSliceLanes];
    input.kernels->SumNear(colours, nears + first, weights + first, kSide,
                           static_cast<int16_t>(kThinStep), sums);
    for (int32_t x = 0; x < pixels.width; ++x) {
      const size_t to = map.At(pixels.x + x, pixels.y + y);
      const FarLight& patch = far.At(x, y);
      if (map.alpha[to] == kUnsplit || patch.weight == 0) continue;
      int32_t alpha = map.first[to];
      const int32_t weight = sums[3][x];
      if (weight > 0) {
        int32_t near[3], beyond[3], mixed[3];
        for (int c = 0; c < 3; ++c) {
          near[c] = (sums[c][x] << 15) / weight;
          beyond[c] = patch.rgb[c];
          mixed[c] = here[static_cast<size_t>(c) * kPlane + static_cast<size_t>(x)];
        }
        alpha = AlphaOf(near, weight, beyond, mixed, alpha);
      }
      visit(pixels.x + x, pixels.y + y, alpha, patch);
    }
  }
}

// Value of CoverageMap::around if the light field has coverage, because edges are then searched up
// to two tiles away.
constexpr int32_t kAroundGiven = 2;

// Returns the number of rows of tiles by which a pass must be ahead of the last pass.
int32_t TilesAhead(const FullConfig& config, int pass) {
  // Largest movement in pixels of a nearer surface relative to a farther surface, in any view that
  // is read.
  const auto range = static_cast<int32_t>(MaxDisparity(config) - MinDisparity(config));
  const int32_t moved = config.views == 1 ? 0 : Min(range + 3, kMostMove + 1);
  // UnmixAgain fills in unknown light of the far surface from the surrounding tiles, so it requires
  // this light in the next row of tiles. The Look pass reads the coverage of surfaces that move
  // onto a tile in side views.
  constexpr int32_t kLookAhead = 1;
  const int32_t unmix_ahead = kLookAhead + Max(1, (moved + kCoverageTile - 1) / kCoverageTile);
  const int32_t ahead[kCoveragePasses] = {unmix_ahead + 2, unmix_ahead + 1, unmix_ahead, kLookAhead,
                                          0};
  return ahead[pass];
}

int32_t TilesOfSuperblock(const FullConfig& config) { return config.superblock / kCoverageTile; }

// Largest number of rows of tiles that must stay in memory, from the pass that writes a row to the
// last pass that reads the row.
int32_t MostTileRows(const FullConfig& config, int32_t border) {
  const int32_t read = (config.superblock + 2 * border) / kCoverageTile + 2;
  const int32_t looked_at = TilesOfSuperblock(config) + kMostMove / kCoverageTile + 1;
  return Max(read, looked_at) + TilesAhead(config, kFindRagged) + 1;
}

// Marks the columns of the coverage map to the left and right of the picture as empty.
void ClearAside(const CoverageMap& map) {
  for (int32_t y = 0; y < map.tile_rows * kCoverageTile; ++y) {
    for (const int32_t x : {-kAside, map.columns * kCoverageTile}) {
      int16_t* const near = map.near + map.At(x, y);
      for (int32_t k = 0; k < kAside; ++k) near[k] = kNowhere;
    }
  }
}

// Returns true if the light field contains coverage, and no side view that shows far surfaces.
// StartGiven has then already read the light of the far surfaces.
bool IsGivenAlone(const Input& input) { return HasGiven(input) && input.views == 1; }

void Start(const Input& input, int32_t column, int32_t row) {
  if (!input.coverage->IsStarted(column, row)) {
    ClearTile(input, column, row);
  } else if (HasGiven(input)) {
    StartGiven(input, column, row);
  } else {
    StartTile(input, column, row);
  }
}

void ReadBehind(const Input& input, int32_t column, int32_t row) {
  CoverageTile& tile = input.coverage->Tile(column, row);
  const bool thin = !HasGiven(input) || tile.mixed != 0;
  tile.thin = thin && input.coverage->IsStarted(column, row) ? 1 : 0;
  if (tile.thin != 0 && !IsGivenAlone(input)) ReadBehindTile(input, column, row);
}

// Runs a pass on a tile. All earlier passes must already be as many rows of tiles ahead as
// TilesAhead requires.
void RunPass(const Input& input, int pass, int32_t column, int32_t row) {
  // If the light field provides coverage, the first unmixing pass is not needed. Given coverage is
  // read during kUnmixFirst instead of kStart, because reading requires `ragged` of tiles up to two
  // rows ahead.
  const bool given = HasGiven(input);
  const CoverageTile& tile = input.coverage->Tile(column, row);
  if (pass == kFindRagged) FindRagged(input, column, row);
  if (pass == (given ? kUnmixFirst : kStart)) Start(input, column, row);
  if (pass == kUnmixFirst && !given && tile.ragged != 0) UnmixFirst(input, column, row);
  if (pass == kReadBehind) ReadBehind(input, column, row);
  if (pass != kUnmixAgain || tile.thin == 0) return;
  if (!given) return UnmixAgain(input, column, row);
  UseGiven(input, column, row);
  if (!IsGivenAlone(input)) AddFarDetail(input, column, row);
}

// Runs all passes, so that the last pass completes the rows of tiles [top, end). A job of a pass
// processes one column of superblocks.
starfocus_status RunPasses(const FullConfig& config, const Input& input, const Range& tiles,
                           Jobs* jobs, CoverageMap* map) {
  const int32_t side = TilesOfSuperblock(config);
  for (int pass = 0; pass < kCoveragePasses; ++pass) {
    const int32_t ahead = TilesAhead(config, pass);
    int32_t& done = map->done[pass];
    // For the first stripe, each pass also processes `ahead` rows of tiles above the stripe.
    const Range rows = {done >= 0 ? done : Max(0, tiles.first - ahead),
                        Min(map->Rows(), tiles.last + ahead)};
    if (rows.first < rows.last) {
      const auto run = [&](int32_t column, int32_t) {
        const int32_t first = column * side, last = Min(first + side, map->columns);
        CancelToken cancel(&jobs->call_progress);
        int32_t& next = map->next[pass * map->jobs + column];
        for (next = Max(next, rows.first); next < rows.last; ++next) {
          if (!cancel.Spend(int64_t{last - first} * kCoverageTile * kCoverageTile)) return;
          for (int32_t k = first; k < last; ++k) RunPass(input, pass, k, next);
        }
      };
      const starfocus_status status = ForEach(map->jobs, jobs, run);
      if (status != STARFOCUS_OK) return status;
    }
    done = Max(rows.first, rows.last);
  }
  return STARFOCUS_OK;
}

}  // namespace

void UnmixFirst(const Input& input, int32_t column, int32_t row) {
  const CoverageMap& map = *input.coverage;
  // Returns a weight of 0 for pixels on the far side of an edge. For other pixels, the weight
  // increases with the number of surrounding 3x3 pixels that are not on the far side.
  const auto weight_of = [&](int32_t x, int32_t y) {
    if (map.alpha[map.At(x, y)] == 0) return 0;
    int32_t count = 0;
    ForPixels(Around(x, y, 1), [&](int32_t u, int32_t v) {
      const size_t at = map.At(Clamp(u, 0, map.width - 1), Clamp(v, 0, map.height - 1));
      count += map.alpha[at] != 0 ? 1 : 0;
    });
    return 3 * count * count;
  };
  ForEachSplit(input, column, row, weight_of,
               [&](int32_t x, int32_t y, int32_t alpha, const FarLight&) {
                 map.first[map.At(x, y)] = static_cast<uint8_t>(alpha);
               });
}

void UnmixAgain(const Input& input, int32_t column, int32_t row) {
  const CoverageMap& map = *input.coverage;
  ForEachSplit(
      input, column, row,
      [&](int32_t x, int32_t y) { return EighthPower(map.first[map.At(x, y)]); },
      [&](int32_t x, int32_t y, int32_t alpha, const FarLight& far) {
        map.alpha[map.At(x, y)] = static_cast<uint8_t>(alpha);
        std::memcpy(map.FarAt(x, y).rgb, far.rgb, sizeof(far.rgb));
      });
}

void UseGiven(const Input& input, int32_t column, int32_t row) {
  const CoverageMap& map = *input.coverage;
  FarTile far;
  PushTile(column, row, map, &far);
  ForPixels(map.PixelsOf(column, row), [&](int32_t x, int32_t y) {
    const size_t to = map.At(x, y);
    const FarLight& patch = far.At(x % kCoverageTile, y % kCoverageTile);
    if (map.alpha[to] == kUnsplit) return;
    // A pixel cannot be split if the light of the far surface is not known nearby. It then belongs
    // to the near surface if the near surface covers most of it.
    map.alpha[to] = patch.weight > 0              ? map.first[to]
                    : 2 * map.first[to] >= kWhole ? uint8_t{kWhole}
                                                  : kUnsplit;
    std::memcpy(map.FarAt(x, y).rgb, patch.rgb, sizeof(patch.rgb));
  });
}

int32_t CoverageBorder(const FullConfig& config) {
  if (!Has(config, STARFOCUS_FEATURE_COVERAGE)) return 0;
  return (TilesAhead(config, kFindRagged) + 1) * kCoverageTile + kBandRadius + 2;
}

void TakeCoverage(const FullConfig& config, int32_t border, Arena* arena, CoverageMap* map) {
  if (!Has(config, STARFOCUS_FEATURE_COVERAGE)) return;
  map->width = config.width;
  map->height = config.height;
  map->columns = (config.width + kCoverageTile - 1) / kCoverageTile;
  map->tile_rows = MostTileRows(config, border);
  const float least = MinDisparity(config), range_size = MaxDisparity(config) - least;
  map->disparity_min = static_cast<int16_t>(least * (1 << kDisparityBits));
  const auto range = static_cast<int32_t>(range_size * (1 << kDisparityBits));
  map->bin_bits = 0;
  while (range >> map->bin_bits >= 64) ++map->bin_bits;
  const auto tiles = static_cast<size_t>(map->columns) * static_cast<size_t>(map->tile_rows);
  const size_t pixels = map->Stride() * static_cast<size_t>(map->tile_rows) * kCoverageTile;
  map->jobs = (map->columns + TilesOfSuperblock(config) - 1) / TilesOfSuperblock(config);
  map->next = arena->Take<int32_t>(static_cast<size_t>(kCoveragePasses * map->jobs));
  map->tiles = arena->Take<CoverageTile>(tiles);
  map->first = arena->Take<uint8_t>(pixels);
  map->alpha = arena->Take<uint8_t>(pixels);
  map->near = arena->Take<int16_t>(pixels);
  for (int level = 0; level < kFarLevels; ++level) {
    map->far[level] = arena->Take<FarLight>((tiles * kCoverageTile * kCoverageTile) >> (2 * level));
  }
}

void ForgetCoverage(CoverageMap* map) {
  for (int32_t& done : map->done) done = -1;
  for (int32_t k = 0; k < kCoveragePasses * map->jobs; ++k) map->next[k] = 0;
}

starfocus_status FindCoverage(const FullConfig& config, const Input& input, const Range& rows,
                              Jobs* jobs, CoverageMap* map) {
  map->around = HasGiven(input) ? kAroundGiven : 1;
  const int32_t top = Max(0, rows.first) / kCoverageTile;
  const int32_t end = Min(map->Rows(), rows.last / kCoverageTile + 1);
  if (map->done[kFindRagged] < 0) ClearAside(*map);
  // Processes the height of one superblock at a time, so that few rows of the coverage map are in
  // memory.
  starfocus_status status = STARFOCUS_OK;
  while (status == STARFOCUS_OK && map->done[kUnmixAgain] < end) {
    const int32_t from = Max(top, map->done[kUnmixAgain]);
    const Range tiles = {top, Min(from + TilesOfSuperblock(config), end)};
    status = RunPasses(config, input, tiles, jobs, map);
  }
  return status;
}

}  // namespace starfocus
