// SPDX-License-Identifier: Apache-2.0
// The timing model (13)-(15).
#ifndef STARFOCUS_LIB_PLAN_TIMING_H_
#define STARFOCUS_LIB_PLAN_TIMING_H_

#include <cstdint>

#include "lib/plan/block_stats.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// The work of refocusing one block, all at its layer: what the coefficients of starfocus_timing
// multiply.
struct BlockWork {
  uint64_t field;     // pixels of the extended rectangle
  uint64_t a, b, c;   // rendered pixels P_A, P_B, P_C of (13)
  uint64_t upsample;  // picture pixels, 0 at layer 0
  uint64_t span;      // stretches of one disparity in all rendered lines
  uint64_t hole;      // pixels that they leave uncovered, as if each view were an outermost one
};

// Adds the spans and holes of `views` views of a block with `content` at layer 0 that are scanned
// along `lines` lines of the layer, all in one direction.
void AddScans(uint64_t views, uint64_t lines, const Content& content, int32_t layer,
              BlockWork* work);

// Picoseconds; exact in integers, so that a partition is the same on every machine.
uint64_t PredictTime(const starfocus_timing& timing, const BlockWork& work);

// The same for gathering `pixels` of a layer, which is as much a filter as upsampling, so that this
// has no coefficient of its own; for pixels that are blurred by `radius` pixels of that layer
// (kDisparityBits) at most.
uint64_t PredictGather(const starfocus_timing& timing, uint64_t pixels, int32_t radius);

// The same coefficients on every machine, so that all of them part a picture alike.
starfocus_timing DefaultTiming();

}  // namespace starfocus

#endif  // STARFOCUS_LIB_PLAN_TIMING_H_
