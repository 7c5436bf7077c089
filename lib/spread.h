// Wide aperture cells: the box a pixel moves over within one view's cell, along a line.
#ifndef STARFOCUS_LIB_SPREAD_H_
#define STARFOCUS_LIB_SPREAD_H_

#include <cstdint>

#include "lib/runs.h"
#include "simd/kernels.h"

namespace starfocus {

// The taps that make linear interpolation a box of width `cell` (kShiftBits), in (1, 7] pixels: of
// the same variance, a mixture of the two odd boxes around it. Wider cells get 7 pixels.
simd::SpreadTaps SpreadTapsOf(int32_t cell);

// Spreads the pixels of a line, in place, by their own cells r / N, each over its own surface only:
// beyond a depth edge the surface's last pixel is repeated. Pixels whose cells are at most a pixel
// wide stay. `runs` are the line's, in scan order kRightToLeft.
// surface: room for 3 * (length + 2 * kMaxSpread) bytes.
void SpreadLine(const simd::Kernels& kernels, const Run* runs, int32_t count, int32_t length,
                uint8_t* surface, uint8_t* rgb);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SPREAD_H_
