// SPDX-License-Identifier: Apache-2.0
// The paper's primitive: refocuses one rectangle of the picture with a given N at one layer. The
// views of the aperture form eight triangles and are rendered as types A, B and C (section IV-B).
#ifndef STARFOCUS_LIB_LINE_SCAN_TRIANGLES_H_
#define STARFOCUS_LIB_LINE_SCAN_TRIANGLES_H_

#include <cstdint>

#include "lib/gather/span_list.h"
#include "lib/io/block_pixels.h"
#include "lib/line_scan/line_scan.h"
#include "lib/plan/renderer.h"
#include "simd/kernels.h"

namespace starfocus {

// Number of type A lines that are rendered before they are transposed together.
inline constexpr int32_t kStripRows = 16;

// Scratch memory of one worker. E is the largest side of an extended rectangle, and R the largest
// side of a rectangle without border. The comments of the members state the number of elements of
// each buffer. Each buffer is followed by simd::kPadding bytes.
struct LineScanScratch : RendererScratch {
  // Light of the field and of the transposed field: E rows of RgbStride(E) each.
  int16_t* field_rgb[2];
  int16_t* field_disparity[2];  // Disparities of both fields: E^2 each.
  int16_t* diagonal_rgb;        // Light of all diagonal lines: 3 E^2.
  int16_t* diagonal_disparity;  // Disparities of all diagonal lines: E^2.
  uint32_t* diagonal_offsets;   // Number of pixels before each diagonal line: 2 E.
  int64_t* moves;               // ViewGrid::Move of views 0 to N along an axis: N + 1.
  simd::RunMarks marks;         // Marks of the runs of E lines with E positions each.
  Run* runs;                    // Runs of all lines of a field: E^2.
  int32_t* run_counts;          // Number of runs of each line: E.
  Run* line_runs;               // Runs of one line: E.
  int16_t* strip_rgb;           // Type A lines before they are transposed: 3 R kStripRows.
  int16_t* view_disparity;      // Disparities of the type A view, one line per row: R E.
  int16_t* columns_rgb;   // Light of the type A view, one line per column: R rows of RgbStride(E).
  uint32_t* column_sums;  // Sums of the pass over rows, in column order: 3 R^2.
  uint32_t* line_accumulators;  // Accumulators of one line: 3 E.
  SpanMemory spans;
};

// Returns the largest i of the type B views (i, i) for N views along the radius.
constexpr int32_t LastOnDiagonal(int32_t n) {
  int32_t last = 0;
  while (2 * (last + 1) * (last + 1) <= n * n) ++last;
  return last;
}

// Implements Renderer::render for line scans. `scratch` is a LineScanScratch. N > 0.
uint64_t RefocusRectangle(const RenderJob& job, RendererScratch* scratch, uint32_t* sums);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_LINE_SCAN_TRIANGLES_H_
