// SPDX-License-Identifier: Apache-2.0
// Timing model (13)-(15): predicts the time of a block.
#ifndef STARFOCUS_LIB_PLAN_TIMING_H_
#define STARFOCUS_LIB_PLAN_TIMING_H_

#include <cstdint>

#include "lib/plan/cells.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Work of refocusing one block at its layer. PredictTime multiplies the fields by the coefficients
// of starfocus_timing.
struct BlockWork {
  uint64_t field;     // Pixels of the extended rectangle.
  uint64_t a, b, c;   // Rendered pixels P_A, P_B, P_C of (13).
  uint64_t upsample;  // Pixels of the picture to upsample, 0 at layer 0.
  uint64_t span;      // Runs of equal disparity in all rendered lines.
  uint64_t hole;      // Uncovered pixels, counted as if all views were at the rim of the aperture.
};

// Adds the spans and holes of `views` views that are scanned along `lines` lines of the layer in
// one direction. `content` is the content of the block at layer 0.
void AddScans(uint64_t views, uint64_t lines, const Content& content, int32_t layer,
              BlockWork* work);

// Returns the predicted time of refocusing a block, in picoseconds. The computation uses integers,
// so that all machines choose the same partition.
uint64_t PredictTime(const starfocus_timing& timing, const BlockWork& work);

// Returns the predicted time of blurring `pixels` pixels of a layer without views, in picoseconds.
// `radius` is the largest blur radius of these pixels, in pixels of the layer (kDisparityBits). The
// blur is a filter like upsampling, so the prediction uses the coefficient of upsampling.
uint64_t PredictGather(const starfocus_timing& timing, uint64_t pixels, int32_t radius);

// Returns the default coefficients, which are the same on all machines, so that all machines split
// a picture in the same way.
starfocus_timing DefaultTiming();

}  // namespace starfocus

#endif  // STARFOCUS_LIB_PLAN_TIMING_H_
