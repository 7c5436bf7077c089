// Wide aperture cells: the box a pixel moves over within one view's cell, along a line.
#ifndef STARFOCUS_LIB_SPREAD_H_
#define STARFOCUS_LIB_SPREAD_H_

#include <cstdint>

#include "lib/line_scan.h"
#include "simd/kernels.h"

namespace starfocus {

// The taps of a box of width `cell` (kShiftBits), in (1, 7] pixels, to 1/8 pixel: what it covers of
// each pixel around it. Wider cells get 7 pixels.
simd::SpreadTaps SpreadTapsOf(int32_t cell);

// Spreads the pixels of `line` by their own cells r / N, in steps of 1/8 pixel, into `out`, each
// over its own surface only: beyond a depth edge the surface's last pixel is repeated. Where cells
// are at most a pixel wide the line is copied. The mirrored line gives the mirrored result.
// `cell_move` is ViewGrid::Move(1). surface: room for 3 * (length + 2 * kMaxSpread) bytes.
void SpreadLine(const simd::Kernels& kernels, const ViewGrid& grid, int64_t cell_move,
                const Line& line, uint8_t* surface, uint8_t* out);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SPREAD_H_
