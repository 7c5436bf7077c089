// Wide aperture cells: the box a pixel moves over within one view's cell, along a line.
#ifndef STARFOCUS_LIB_SPREAD_H_
#define STARFOCUS_LIB_SPREAD_H_

#include <cstdint>

#include "lib/line_scan.h"
#include "simd/kernels.h"

namespace starfocus {

// The taps of a box of width `cell` (kShiftBits), in (1, 7] pixels, to 1/4 pixel: what it covers of
// each pixel around it. Wider cells get 7 pixels.
simd::SpreadTaps SpreadTapsOf(int32_t cell);

// Spreads the pixels of `line` by their own cells r / N, in steps of 1/4 pixel, each over its own
// surface only: beyond a depth edge the surface's last pixel is repeated. Pixels whose cells are at
// most a pixel wide stay. The mirrored line gives the mirrored result. `runs` are the line's, in
// scan order kRightToLeft; out: line.rgb itself. surface: room for 3 * (length + 2 * kMaxSpread)
// bytes.
void SpreadLine(const simd::Kernels& kernels, const ViewGrid& grid, const Line& line,
                const Run* runs, int32_t count, uint8_t* surface, uint8_t* out);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SPREAD_H_
