// SPDX-License-Identifier: Apache-2.0
// Computes the evidence that a change of a map needs. The fewer of the map's edge pixels a repair
// contradicts, the more the map is trusted.
#ifndef STARFOCUS_LIB_DEPTH_EVIDENCE_H_
#define STARFOCUS_LIB_DEPTH_EVIDENCE_H_

#include <cstdint>

namespace starfocus {

// Counts of pixels in a tile of a given map.
struct TileCount {
  int32_t rough;    // pixels at edges
  int32_t differs;  // pixels that the repair contradicts
};

// If at most `right_percent` of the pixels at edges differ, the map is right and a change needs
// evidence of `right`. If `wrong_percent` or more differ, a change needs `wrong`. In between, the
// evidence is interpolated.
struct EvidenceScale {
  int32_t right_percent, wrong_percent;
  int32_t right, wrong;
};

// Returns the evidence that a change needs in a map of `tiles` tiles.
int32_t LeastEvidence(const EvidenceScale& scale, const TileCount* counts, int32_t tiles);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_EVIDENCE_H_
