// SPDX-License-Identifier: Apache-2.0
// The paper's primitive: refocuses one rectangle of the picture with a given N at one layer. The
// views of the aperture form eight triangles and are rendered as types A, B and C (section IV-B).
#ifndef STARFOCUS_LIB_LINE_SCAN_TRIANGLES_H_
#define STARFOCUS_LIB_LINE_SCAN_TRIANGLES_H_

#include <cstdint>

#include "lib/filter/span_list.h"
#include "lib/input/block_pixels.h"
#include "lib/line_scan/runs.h"
#include "lib/plan/renderer.h"
#include "simd/kernels.h"

namespace starfocus {

// Number of type A lines that are rendered before they are transposed together.
inline constexpr int32_t kStripRows = 16;

// Scratch memory of one worker. E is the largest side of an extended rectangle, and R the largest
// side of a rectangle without border. Each buffer is followed by simd::kPadding bytes.
struct LineScanScratch {
  int16_t* field_rgb[2];        // E rows of RgbStride(E): rows and columns
  int16_t* field_disparity[2];  // E^2 each
  int16_t* diagonal_rgb;        // 3 E^2
  int16_t* diagonal_disparity;  // E^2
  uint32_t* diagonal_offsets;   // 2 E
  int64_t* moves;               // N + 1: ViewGrid::Move of each view
  simd::RunMarks marks;         // for E lines of E positions
  Run* runs;                    // E^2: all lines of a field
  int32_t* run_counts;          // E
  Run* line_runs;               // E: one line
  int16_t* strip_rgb;           // 3 R kStripRows: type A lines before they are transposed
  int16_t* view_disparity;      // R E: the type A view, one line per row
  int16_t* columns_rgb;         // R rows of RgbStride(E): the type A view, one line per column
  uint32_t* column_sums;        // 3 R^2: sums of the pass over rows, in column order
  uint32_t* line_accumulators;  // 3 E
  SpanMemory spans;
};

// Returns the largest i of the type B views (i, i) for N views along the radius.
constexpr int32_t LastOnDiagonal(int32_t n) {
  int32_t last = 0;
  while (2 * (last + 1) * (last + 1) <= n * n) ++last;
  return last;
}

// Implements Renderer::render for line scans. `scratch` is a LineScanScratch. N > 0.
uint64_t RefocusRectangle(const RenderJob& job, void* scratch, uint32_t* sums);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_LINE_SCAN_TRIANGLES_H_
