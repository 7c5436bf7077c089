// SPDX-License-Identifier: Apache-2.0
// Lens of a refocusing: the checked parameters and the values derived from them. Also defines the
// renderers of an engine, the tables that the engine makes when a lens first uses them, and the
// borders of a lens.
#ifndef STARFOCUS_LIB_ENGINE_LENS_H_
#define STARFOCUS_LIB_ENGINE_LENS_H_

#include <cstdint>

#include "lib/base/arena.h"
#include "lib/base/config.h"
#include "lib/base/geometry.h"
#include "lib/base/jobs.h"
#include "lib/optics/psf.h"
#include "lib/optics/rules.h"
#include "lib/optics/view_weights.h"
#include "lib/plan/cells.h"
#include "lib/plan/renderer.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// An engine has one renderer for slices, and may have the caller's line scan. Renderers are indexed
// by Renderer::index.
inline constexpr int32_t kMaxRenderers = 2;
inline int32_t RendererCount(const FullConfig& config) {
  return config.tuning.line_scan != nullptr ? 2 : 1;
}
inline const Renderer& RendererAt(const FullConfig& config, int32_t index) {
  return index == kSliceRenderer.index ? kSliceRenderer : config.tuning.line_scan->renderer;
}

// Returns the largest N that the block and frame modes use for blur radii up to r_max pixels. The
// modes round radii up before they choose N. Of all shapes of the opening, rings (Demand::kRing)
// require the largest N.
int32_t LargestN(const FullConfig& config, const Renderer& renderer, Demand demand, double r_max);

// Apertures of one renderer, indexed by N.
struct ApertureTable {
  ViewWeights* weights_by_n;  // one aperture per N, up to the largest N that max_blur requires
  uint16_t* weights;
  int32_t count = 0;  // Number of apertures in the table.
  size_t used = 0;    // Number of weights in use.
};

struct Tables {
  // Opening for which the tables were made. A change of the cat's eye alone does not invalidate the
  // tables.
  ApertureShape opening;
  ApertureTable apertures[kMaxRenderers];
  uint16_t* benchmark_weights;  // weights of the single aperture of benchmark mode
  Psf* psfs;
  uint16_t* blur_weights;
  int32_t blur_steps = 0;   // Number of PSFs that have been made.
  int32_t mean_square = 0;  // MeanSquare of the opening; 0: no opening is set.
};

// Allocates the tables of an engine.
void TakeTables(const FullConfig& config, Arena* arena, Tables* tables);

// Sets the opening. Discards all tables that were made for another opening.
void SetOpening(const ApertureShape& opening, Tables* tables);

// Makes the missing apertures of the renderer up to N = `last`. Returns STARFOCUS_OK or
// STARFOCUS_ERROR_CANCELLED; finished apertures are kept.
starfocus_status MakeApertures(const Renderer& renderer, int32_t last, CallProgress* call_progress,
                               Tables* tables);

// Makes the missing PSFs of all steps (PsfIndex) below `steps`. Returns STARFOCUS_OK or
// STARFOCUS_ERROR_CANCELLED; finished PSFs are kept.
starfocus_status MakePsfs(int32_t steps, CallProgress* call_progress, Tables* tables);

// Borders: numbers of pixels that the engine reads on each side of a superblock, or of its stripe.
// The border of a processing step's input includes the borders of all later steps (borders.cc).
struct Borders {
  int32_t deblocked = 0;                 // Finished pixels around a region, for deblocking.
  int32_t whole_block = 0;               // Pixels around a block that is planned without cells.
  int32_t layer[STARFOCUS_LAYERS] = {};  // Pixels of each layer around any possible block.
  int32_t cells = 0;                     // Number of cells (not pixels) around a superblock.
  int32_t matting = 0;                   // Pixels of the coverage map.
  int32_t centre = 0;                    // Pixels of the centre view and the disparity map.
  // Distance of the farthest highlights that affect a superblock; 0: no highlights.
  int32_t highlights = 0;
  int32_t views = 0;     // Pixels of any view.
  int32_t streamed = 0;  // Rows around a stripe of a stream, rounded up to even for images.
};

// Adds the borders of all processing steps for blur radii up to `max_blur`. `deblocks` is true if
// blocks are deblocked.
Borders AddBorders(const FullConfig& config, double max_blur, bool deblocks);

// Returns the borders for the largest configured blur radius.
inline Borders LargestBorders(const FullConfig& config) {
  return AddBorders(config, config.max_blur, true);
}

// Number of columns of superblocks.
inline int32_t Columns(const FullConfig& config) {
  return (config.width + config.superblock - 1) / config.superblock;
}

// Largest number of rows of a layer that a stripe reads.
inline int32_t LayerRows(const FullConfig& config, int layer) {
  return (config.superblock >> layer) + 2 * LargestBorders(config).layer[layer];
}

struct Lens {
  FullParams params;
  Rect region;  // region of `params`, or the whole picture if no region is set
  const Renderer* renderer;
  double r_max;  // Largest blur radius for the configured disparities, in pixels.
  const ViewWeights* weights_by_n;  // Apertures of `renderer`, indexed by N.
  int32_t largest_n;                // Largest N of `weights_by_n`.
  ViewWeights frame_weights;        // In frame modes, the aperture for the whole picture.
  BlurScale scale;
  Borders borders;
};

// Returns true if `region` is all 0, which selects the whole picture.
inline bool IsWhole(const starfocus_region& region) {
  return region.x == 0 && region.y == 0 && region.width == 0 && region.height == 0;
}

// Returns the rectangle of the picture that `params` select.
Rect RegionOf(const FullConfig& config, const FullParams& params);

// Returns true if the result is a copy of the centre view, in any mode.
inline bool IsPinhole(const Lens& lens) { return lens.params.aperture == 0; }

inline bool IsBlockMode(const Lens& lens) { return lens.params.mode == STARFOCUS_MODE_BLOCK; }

inline bool IsBenchmark(const Lens& lens) { return lens.params.mode == STARFOCUS_MODE_BENCHMARK; }

// Returns true if cells of smooth surfaces are blurred without views with this lens. Blurring
// without views supports only openings whose eight octants mirror each other.
inline bool Gathers(const FullConfig& config, const Lens& lens) {
  const FullParams& asked = lens.params;
  const bool octant = asked.shape != STARFOCUS_SHAPE_POLYGON && asked.cats_eye == 0;
  return IsBlockMode(lens) && lens.renderer->gathers && config.tuning.gather != 0 && octant;
}

// Index of the largest PSF that blurs cells without views.
int32_t LastGatherPsf(const Lens& lens);

// Returns the weights of the views of a block with n views along the radius.
inline const ViewWeights& WeightsOf(const Lens& lens, int32_t n) {
  return IsBlockMode(lens) ? lens.weights_by_n[n] : lens.frame_weights;
}

// Returns true if the boundaries between blocks of different layers are smoothed.
inline bool IsDeblocking(const FullConfig& config, const Lens& lens) {
  return IsBlockMode(lens) && config.tuning.max_layer > 0 && config.tuning.deblocking > 0;
}

// Returns the largest blur radius in pixels for the configured range of disparities.
double LargestBlur(const FullConfig& config, const FullParams& params);

// Returns the largest aperture, at most 1, whose largest blur radius is at most max_blur.
double LargestAperture(const FullConfig& config, const starfocus_params& params);

// Returns STARFOCUS_ERROR_BLUR if the largest blur radius exceeds max_blur, otherwise STARFOCUS_OK.
starfocus_status CheckBlur(const FullConfig& config, const FullParams& params);

// Makes the lens for `params`, and the tables of the lens that do not exist yet. Returns
// STARFOCUS_ERROR_BLUR, STARFOCUS_ERROR_CANCELLED or STARFOCUS_OK. The caller must have checked all
// other requirements on `params`.
starfocus_status MakeLens(const FullConfig& config, const FullParams& params,
                          CallProgress* call_progress, Tables* tables, Lens* lens);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_LENS_H_
