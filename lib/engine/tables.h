// SPDX-License-Identifier: Apache-2.0
// The renderers of an engine, and tables that it makes when a lens first needs them.
#ifndef STARFOCUS_LIB_ENGINE_TABLES_H_
#define STARFOCUS_LIB_ENGINE_TABLES_H_

#include <cstdint>

#include "lib/base/call_progress.h"
#include "lib/base/features.h"
#include "lib/base/rules.h"
#include "lib/base/view_weights.h"
#include "lib/filter/blur.h"
#include "lib/plan/renderer.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// All renderers, by Renderer::index. An engine has the first RendererCount of them.
inline constexpr int32_t kMaxRenderers = 2;
inline constexpr const Renderer* kRenderers[kMaxRenderers] = {&kSliceRenderer, &kLineScanRenderer};
inline bool HasLineScan(const starfocus_config& config) {
  return Has(config.features, STARFOCUS_FEATURE_LINE_SCAN);
}
inline int32_t RendererCount(const starfocus_config& config) { return HasLineScan(config) ? 2 : 1; }

// Returns the largest N that the block and frame modes may need for blur radii up to r_max pixels,
// which are rounded up before N is chosen. No demand needs a larger N than kRing.
int32_t LargestN(const starfocus_config& config, const Renderer& renderer, Demand demand,
                 double r_max);

// Apertures of one renderer, by N.
struct ApertureTable {
  ViewWeights* apertures;  // of N up to LargestN for max_blur
  uint16_t* weights;
  int32_t count = 0;  // apertures made so far
  size_t used = 0;    // weights of these
};

struct Tables {
  ApertureShape opening;  // that the tables below are made for; but for its cat's eyes
  ApertureTable apertures[kMaxRenderers];
  uint16_t* benchmark_weights;  // of the one aperture of the benchmark mode
  Psf* psfs;
  uint16_t* blur_weights;
  int32_t blur_steps = 0;   // kernels made so far
  int32_t mean_square = 0;  // MeanSquare of the opening; 0: there is none yet
};

// Sets the opening, and forgets all tables if they were made for another one.
void SetOpening(const ApertureShape& opening, Tables* tables);

// Makes the renderer's apertures up to N = `last` that are not there yet. Returns STARFOCUS_OK or
// STARFOCUS_ERROR_CANCELLED; those that were made stay.
starfocus_status MakeApertures(const Renderer& renderer, int32_t last, CallProgress* call_progress,
                               Tables* tables);

// Makes the blur kernels of steps up to `steps` that are not there yet. Returns STARFOCUS_OK or
// STARFOCUS_ERROR_CANCELLED; those that were made stay.
starfocus_status MakePsfs(int32_t steps, CallProgress* call_progress, Tables* tables);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_TABLES_H_
