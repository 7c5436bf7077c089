// SPDX-License-Identifier: Apache-2.0
#include "lib/base/config.h"
#include "lib/matting/coverage.h"
#include "lib/matting/coverage_tile.h"

namespace starfocus {
namespace {

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

void Look(const Input& input, int32_t column, int32_t row) {
  CoverageTile& tile = input.coverage->Tile(column, row);
  const bool thin = !HasGiven(input) || tile.mixed != 0;
  tile.thin = thin && input.coverage->IsStarted(column, row) ? 1 : 0;
  if (tile.thin != 0 && !IsGivenAlone(input)) LookBehindTile(input, column, row);
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
  if (pass == kLook) Look(input, column, row);
  if (pass != kUnmixAgain || tile.thin == 0) return;
  if (!given) return UnmixAgain(input, column, row);
  TakeGiven(input, column, row);
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
        for (int32_t row = rows.first; row < rows.last; ++row) {
          if (!cancel.Spend(int64_t{last - first} * kCoverageTile * kCoverageTile)) return;
          for (int32_t k = first; k < last; ++k) RunPass(input, pass, k, row);
        }
      };
      const starfocus_status status = ForEach((map->columns + side - 1) / side, jobs, run);
      if (status != STARFOCUS_OK) return status;
    }
    done = Max(rows.first, rows.last);
  }
  return STARFOCUS_OK;
}

}  // namespace

int32_t CoverageBorder(const FullConfig& config) {
  if (!Has(config, STARFOCUS_FEATURE_COVERAGE)) return 0;
  return (TilesAhead(config, kFindRagged) + 1) * kCoverageTile + kBandReach + 2;
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
  map->tiles = arena->Take<CoverageTile>(tiles);
  map->first = arena->Take<uint8_t>(pixels);
  map->alpha = arena->Take<uint8_t>(pixels);
  map->near = arena->Take<int16_t>(pixels);
  for (int level = 0; level < kFarLevels; ++level) {
    map->far[level] = arena->Take<FarCell>((tiles * kCoverageTile * kCoverageTile) >> (2 * level));
  }
}

void ForgetCoverage(CoverageMap* map) {
  for (int32_t& done : map->done) done = -1;
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
