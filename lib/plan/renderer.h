// SPDX-License-Identifier: Apache-2.0
// Interface of the two renderers: slices, and the paper's line scan. Each lens uses one renderer.
// The engine accesses both renderers only through this interface. A renderer also measures the work
// of a block, from which the timing model (lib/plan/partition.h) predicts the time.
#ifndef STARFOCUS_LIB_PLAN_RENDERER_H_
#define STARFOCUS_LIB_PLAN_RENDERER_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/arena.h"
#include "lib/base/config.h"
#include "lib/base/geometry.h"
#include "lib/base/jobs.h"
#include "lib/io/input.h"
#include "lib/optics/rules.h"
#include "lib/optics/view_grid.h"
#include "lib/optics/view_weights.h"
#include "lib/plan/cells.h"
#include "lib/plan/smooth_cells.h"
#include "starfocus/experimental.h"
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
inline void AddScans(uint64_t views, int32_t lines, const Content& content, int32_t layer,
                     BlockWork* work) {
  // Layer L has 1 / 2^L as many lines as layer 0. Along a line of layer L, slopes start 1 / 2^L as
  // many runs, and gaps are 1 / 2^L as wide. The number of depth edges along a line is equal at all
  // layers.
  const uint64_t runs = (content.slopes >> 2 * layer) + (content.edges >> layer);
  work->span += views * static_cast<uint64_t>(lines) + views * runs / kContentOne;
  work->hole += views * (content.gaps >> 2 * layer) / kContentOne;
}

// Task of rendering all views of one rectangle of a layer. `border` is the distance from which
// pixels splat into the rectangle.
struct RenderJob {
  const Input* input;
  int layer;
  const ViewGrid* grid;
  Rect rect;
  Border border;
  CancelToken* cancel;             // Null: the job is never cancelled.
  const BlockCells* gathered;      // Null: all cells are rendered from views.
  double r_max;                    // Largest blur radius of the lens in pixels.
  bool is_benchmark;               // True: benchmark mode, which renders finer slices.
  starfocus_layer_report* counts;  // The slice renderer adds the pixels that its stages touch.
};

// Scratch memory of a renderer for one worker. Each renderer derives its own structure.
struct RendererScratch {};

struct Renderer {
  int32_t index;           // Index of the renderer's tables and scratch memory in an engine.
  bool gathers;            // True: block mode blurs smooth cells without views.
  int32_t benchmark_side;  // Side in pixels of the blocks that benchmark mode renders.

  // Returns the number of views N along the radius for a block whose largest blur radius is r_max
  // pixels.
  int32_t (*view_count)(double r_max, Demand demand);
  // Returns the layer at which a block with these statistics is rendered.
  int32_t (*layer)(const BlockStats& stats, Demand demand);
  // Computes the weights of all views of an aperture with N views along the radius. Fills
  // weights[ViewWeightsSize(opening, n)].
  ViewWeights (*make_aperture)(int32_t n, const ApertureShape& opening, uint16_t* weights);
  // Returns the work for `rect` with `border`, both in pixels of the layer, without upsampling.
  // `content` is the content of the block at layer 0, along rows and along columns.
  BlockWork (*measure_work)(const Rect& rect, const Border& border, const ViewWeights& aperture,
                            const Content (&content)[2], int32_t layer);

  size_t scratch_bytes;
  // Allocates the scratch memory of one worker and stores its pointers at `scratch`. If `scratch`
  // is null, the function only counts the bytes. `extended` is the largest side of a rectangle with
  // its border, max_n the largest N.
  void (*take_scratch)(const FullConfig& config, size_t extended, size_t max_n, Arena* arena,
                       RendererScratch* scratch);

  // Returns true if no view moves any pixel of the rectangle. The refocused rectangle is then an
  // exact copy of the centre view.
  bool (*nothing_moves)(const RenderJob& job);
  // Writes the weighted sums of the views over job.rect to `sums`: rows of 3 * width values with
  // sum_bits(aperture) fractional bits. Returns the number of samples rendered in each view. After
  // cancellation `sums` is unspecified.
  uint64_t (*render)(const RenderJob& job, RendererScratch* scratch, uint32_t* sums);
  int (*sum_bits)(const ViewWeights& aperture);
};

// Renderer with slices: each view represents a subaperture of the lens (lib/slices).
extern const Renderer kSliceRenderer;
}  // namespace starfocus

// The paper's line scan: views at most about one pixel apart (lib/line_scan). The engine knows this
// renderer only by the pointer in starfocus_tuning, so that other programs do not link it.
struct starfocus_line_scan {
  starfocus::Renderer renderer;
};

#endif  // STARFOCUS_LIB_PLAN_RENDERER_H_
