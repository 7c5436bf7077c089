// SPDX-License-Identifier: Apache-2.0
// The timing model (13)-(15).
#ifndef STARFOCUS_LIB_PLAN_TIMING_H_
#define STARFOCUS_LIB_PLAN_TIMING_H_

#include <cstdint>

#include "lib/base/aperture.h"
#include "lib/base/geometry.h"
#include "lib/plan/block_stats.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// The work of refocusing one block, all at its layer: what the coefficients of sf_timing multiply.
struct BlockWork {
  uint64_t field;     // pixels of the extended rectangle
  uint64_t a, b, c;   // rendered pixels P_A, P_B, P_C of (13)
  uint64_t upsample;  // picture pixels, 0 at layer 0
  uint64_t span;      // stretches of one disparity in all rendered lines
  uint64_t hole;      // pixels that they leave uncovered, as if each view were an outermost one
};

// Views of each type inside the disc of N.
struct ViewCounts {
  uint32_t a, b, c;
};
ViewCounts CountViews(int32_t n);
// Counts the views of subapertures: those on the axes as type A, all others as type C.
ViewCounts CountSubapertures(const Aperture& aperture);

// The work of `rect` with `border`, both in pixels of the layer, and N views along the radius.
// `subapertures`: by the rule of subapertures. `content`: what the block holds at layer 0 along
// rows and along columns.
BlockWork MeasureWork(const Rect& rect, const Border& border, const ViewCounts& views,
                      bool subapertures, uint64_t upsampled_pixels, const Content (&content)[2],
                      int32_t layer);

// Picoseconds; exact in integers, so that a partition is the same on every machine.
uint64_t PredictTime(const sf_timing& timing, const BlockWork& work);

// The same for gathering `pixels` of a layer, which is as much a filter as upsampling, so that this
// has no coefficient of its own; for pixels that are blurred by `radius` pixels of that layer
// (kDisparityBits) at most.
uint64_t PredictGather(const sf_timing& timing, uint64_t pixels, int32_t radius);

// The same coefficients on every machine, so that all of them part a picture alike.
sf_timing DefaultTiming();

}  // namespace starfocus

#endif  // STARFOCUS_LIB_PLAN_TIMING_H_
