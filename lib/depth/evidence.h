// SPDX-License-Identifier: Apache-2.0
// How much the changes of a map must be worth: the less of the map's edges a repair gainsays, the
// more the map is trusted.
#ifndef STARFOCUS_LIB_DEPTH_EVIDENCE_H_
#define STARFOCUS_LIB_DEPTH_EVIDENCE_H_

#include <cstdint>

namespace starfocus {

// Pixels of a tile of a given map.
struct TileCount {
  int32_t rough;    // at edges
  int32_t differs;  // that the repair gainsays
};

// Where `right_percent` of the pixels at edges differ or fewer, the map is right and a change needs
// `right`; where `wrong_percent` or more do, it needs `wrong`.
struct EvidenceScale {
  int32_t right_percent, wrong_percent;
  int32_t right, wrong;
};

// Returns what a change needs in a map of `tiles` tiles.
int32_t LeastEvidence(const EvidenceScale& scale, const TileCount* counts, int32_t tiles);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_EVIDENCE_H_
