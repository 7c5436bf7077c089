// SPDX-License-Identifier: Apache-2.0
// Renderers of an engine, and the tables that the engine makes when a lens first uses them.
#ifndef STARFOCUS_LIB_ENGINE_TABLES_H_
#define STARFOCUS_LIB_ENGINE_TABLES_H_

#include <cstdint>

#include "lib/base/arena.h"
#include "lib/base/features.h"
#include "lib/base/jobs.h"
#include "lib/optics/psf.h"
#include "lib/optics/rules.h"
#include "lib/optics/view_weights.h"
#include "lib/plan/renderer.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// All renderers, indexed by Renderer::index. An engine uses the first RendererCount renderers.
inline constexpr int32_t kMaxRenderers = 2;
inline constexpr const Renderer* kRenderers[kMaxRenderers] = {&kSliceRenderer, &kLineScanRenderer};
inline int32_t RendererCount(const starfocus_config& config) {
  return Has(config, STARFOCUS_FEATURE_LINE_SCAN) ? 2 : 1;
}

// Returns the largest N that the block and frame modes use for blur radii up to r_max pixels. The
// modes round radii up before they choose N. Of all shapes of the opening, rings (Demand::kRing)
// require the largest N.
int32_t LargestN(const starfocus_config& config, const Renderer& renderer, Demand demand,
                 double r_max);

// Apertures of one renderer, indexed by N.
struct ApertureTable {
  ViewWeights* apertures;  // one aperture per N, up to the largest N that max_blur requires
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
void TakeTables(const starfocus_config& config, Arena* arena, Tables* tables);

// Sets the opening. Discards all tables that were made for another opening.
void SetOpening(const ApertureShape& opening, Tables* tables);

// Makes the missing apertures of the renderer up to N = `last`. Returns STARFOCUS_OK or
// STARFOCUS_ERROR_CANCELLED; finished apertures are kept.
starfocus_status MakeApertures(const Renderer& renderer, int32_t last, CallProgress* call_progress,
                               Tables* tables);

// Makes the missing PSFs of all steps (BlurStep) below `steps`. Returns STARFOCUS_OK or
// STARFOCUS_ERROR_CANCELLED; finished PSFs are kept.
starfocus_status MakePsfs(int32_t steps, CallProgress* call_progress, Tables* tables);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_TABLES_H_
