// SPDX-License-Identifier: Apache-2.0
#include "lib/coverage/passes.h"

#include "lib/coverage/band.h"
#include "lib/coverage/look.h"
#include "lib/coverage/unmix.h"

namespace starfocus {

void RunPass(const CoverageInput& in, int pass, int32_t first, int32_t last, int32_t row) {
  const CoverageMap& map = *in.map;
  if (pass == kFindRagged) {
    FindRagged(in, first, last, row);
    return;
  }
  for (int32_t column = first; column < last; ++column) {
    CoverageTile& tile = map.Tile(column, row);
    if (pass == kStart) StartTile(in, column, row);
    if (pass == kUnmixFirst && tile.ragged != 0) UnmixFirst(in, column, row);
    if (pass == kLook) {
      tile.thin = map.AnyAround(column, row, 1, &CoverageTile::mixed) ? 1 : 0;
      if (tile.thin != 0) LookBehindTile(in, column, row);
    }
    if (pass == kUnmixAgain && tile.thin != 0) UnmixAgain(in, column, row);
  }
}

}  // namespace starfocus
