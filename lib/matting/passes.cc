// SPDX-License-Identifier: Apache-2.0
#include "lib/matting/passes.h"

#include "lib/matting/coverage_tile.h"

namespace starfocus {
namespace {

// Returns true if the light field contains coverage, and no side view that shows far surfaces.
// StartGiven has then already read the light of the far surfaces.
bool IsGivenAlone(const CoverageInput& in) { return HasGiven(in) && in.input->views == 1; }

void Start(const CoverageInput& in, int32_t column, int32_t row) {
  if (!in.map->IsStarted(column, row)) {
    ClearTile(in, column, row);
  } else if (HasGiven(in)) {
    StartGiven(in, column, row);
  } else {
    StartTile(in, column, row);
  }
}

void Look(const CoverageInput& in, int32_t column, int32_t row) {
  CoverageTile& tile = in.map->Tile(column, row);
  const bool thin = in.map->AnyAround(column, row, 1, &CoverageTile::mixed);
  tile.thin = thin && in.map->IsStarted(column, row) ? 1 : 0;
  if (tile.thin != 0 && !IsGivenAlone(in)) LookBehindTile(in, column, row);
}

}  // namespace

void RunPass(const CoverageInput& in, int pass, int32_t first, int32_t last, int32_t row) {
  const CoverageMap& map = *in.map;
  if (pass == kFindRagged) {
    FindRagged(in, first, last, row);
    return;
  }
  // If the light field provides coverage, the first unmixing pass is not needed. Given coverage is
  // read during kUnmixFirst instead of kStart, because reading requires `ragged` of tiles up to two
  // rows ahead.
  const bool given = HasGiven(in);
  const int start = given ? kUnmixFirst : kStart;
  for (int32_t column = first; column < last; ++column) {
    const CoverageTile& tile = map.Tile(column, row);
    if (pass == start) Start(in, column, row);
    if (pass == kUnmixFirst && !given && tile.ragged != 0) UnmixFirst(in, column, row);
    if (pass == kLook) Look(in, column, row);
    if (pass != kUnmixAgain || tile.thin == 0) continue;
    if (given) {
      TakeGiven(in, column, row);
      if (IsGivenAlone(in)) AddFarDetail(in, column, row);
    } else {
      UnmixAgain(in, column, row);
    }
  }
}

}  // namespace starfocus
