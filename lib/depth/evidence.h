// SPDX-License-Identifier: Apache-2.0
// Computes the evidence that is required to change a given map. If a repair contradicts only a
// small share of the map's edge pixels, the map is trusted and the required evidence is large.
#ifndef STARFOCUS_LIB_DEPTH_EVIDENCE_H_
#define STARFOCUS_LIB_DEPTH_EVIDENCE_H_

#include <cstdint>

namespace starfocus {

// Counts of pixels in a tile of a given map.
struct TileCount {
  int32_t rough;    // Pixels at edges.
  int32_t differs;  // Pixels that the repair contradicts.
};

// Required evidence as a function of the percentage of edge pixels that the repair contradicts. Up
// to `right_percent` the map is assumed to be right, and the required evidence is `right`. From
// `wrong_percent` on, the required evidence is `wrong`. Between the two percentages, the required
// evidence is interpolated.
struct EvidenceScale {
  int32_t right_percent, wrong_percent;
  int32_t right, wrong;
};

// Returns the evidence required for a change. `counts` has one element for each of the `tiles`
// tiles of the map.
int32_t LeastEvidence(const EvidenceScale& scale, const TileCount* counts, int32_t tiles);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_EVIDENCE_H_
