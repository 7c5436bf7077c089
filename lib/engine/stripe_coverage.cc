// SPDX-License-Identifier: Apache-2.0
// Computes the coverage map (lib/matting) for the rows that a stripe reads.
#include <initializer_list>

#include "lib/base/features.h"
#include "lib/engine/stripe.h"

namespace starfocus {
namespace {

int32_t TilesOfSuperblock(const starfocus_config& config) {
  return config.superblock / kCoverageTile;
}

// Largest number of rows of tiles that must stay in memory, from the pass that writes a row to the
// last pass that reads the row.
int32_t MostTileRows(const starfocus_config& config, int32_t border) {
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

// Returns true if the engine computes coverage for its lens. Only the slice renderer uses coverage.
bool FindsCoverage(const EngineState& engine) {
  const Lens& lens = engine.lens;
  return Has(engine.config, STARFOCUS_FEATURE_COVERAGE) && lens.renderer->gathers &&
         lens.params.mode != STARFOCUS_MODE_BLUR && !IsPinhole(lens);
}

// Runs all coverage passes, so that the last pass completes the rows of tiles before row `end`. A
// job of a pass processes one column of superblocks.
starfocus_status RunPasses(int32_t top, int32_t end, EngineState* engine) {
  CoverageState& state = engine->stripe.coverage;
  const CoverageInput in = {&engine->input, &state.map};
  const int32_t side = TilesOfSuperblock(engine->config);
  for (int pass = 0; pass < kCoveragePasses; ++pass) {
    const int32_t ahead = TilesAhead(engine->config, pass);
    int32_t& done = state.done[pass];
    // For the first stripe, each pass also processes `ahead` rows of tiles above `top`.
    const Range rows = {done >= 0 ? done : Max(0, top - ahead), Min(state.map.Rows(), end + ahead)};
    if (rows.first < rows.last) {
      const auto run = [&](int32_t column, int32_t worker) {
        const int32_t first = column * side, last = Min(first + side, state.map.columns);
        CancelToken& cancel = engine->scratch[worker].cancel;
        for (int32_t row = rows.first; row < rows.last; ++row) {
          if (!cancel.Spend(int64_t{last - first} * kCoverageTile * kCoverageTile)) return;
          RunPass(in, pass, first, last, row);
        }
      };
      const starfocus_status status = ForEach(Columns(engine->config), engine->jobs, run);
      if (status != STARFOCUS_OK) return status;
    }
    done = Max(rows.first, rows.last);
  }
  return STARFOCUS_OK;
}

}  // namespace

void TakeCoverage(const starfocus_config& config, int32_t border, Arena* arena,
                  CoverageState* state) {
  if (!Has(config, STARFOCUS_FEATURE_COVERAGE)) return;
  CoverageMap& map = state->map;
  map.width = config.width;
  map.height = config.height;
  map.columns = (config.width + kCoverageTile - 1) / kCoverageTile;
  map.tile_rows = MostTileRows(config, border);
  const float least = MinDisparity(config), range_size = MaxDisparity(config) - least;
  map.disparity_min = static_cast<int16_t>(least * (1 << kDisparityBits));
  const auto range = static_cast<int32_t>(range_size * (1 << kDisparityBits));
  map.bin_bits = 0;
  while (range >> map.bin_bits >= 64) ++map.bin_bits;
  const auto tiles = static_cast<size_t>(map.columns) * static_cast<size_t>(map.tile_rows);
  const size_t pixels = map.Stride() * static_cast<size_t>(map.tile_rows) * kCoverageTile;
  map.tiles = arena->Take<CoverageTile>(tiles);
  map.first = arena->Take<uint8_t>(pixels);
  map.alpha = arena->Take<uint8_t>(pixels);
  map.near = arena->Take<int16_t>(pixels);
  for (int level = 0; level < kFarLevels; ++level) {
    map.far[level] = arena->Take<FarCell>((tiles * kCoverageTile * kCoverageTile) >> (2 * level));
  }
}

starfocus_status FindCoverage(const Stripe& stripe, EngineState* engine) {
  CoverageState& state = engine->stripe.coverage;
  const bool finds = FindsCoverage(*engine);
  engine->input.coverage = finds ? &state.map : nullptr;
  if (!finds) return STARFOCUS_OK;
  const bool given = engine->input.given_coverage.data != nullptr;
  state.map.around = given ? kAroundGiven : 1;
  const int32_t border = engine->lens.borders.parted;
  const int32_t top = Max(0, stripe.y - border) / kCoverageTile;
  const int32_t end =
      Min(state.map.Rows(), (stripe.y + stripe.height + border) / kCoverageTile + 1);
  if (state.done[kFindRagged] < 0) ClearAside(state.map);
  // Processes the height of one superblock at a time, so that few rows of the coverage map are in
  // memory.
  starfocus_status status = STARFOCUS_OK;
  while (status == STARFOCUS_OK && state.done[kUnmixAgain] < end) {
    const int32_t from = Max(top, state.done[kUnmixAgain]);
    status = RunPasses(top, Min(from + TilesOfSuperblock(engine->config), end), engine);
  }
  return status;
}

}  // namespace starfocus
