// SPDX-License-Identifier: Apache-2.0
// Lens of a refocusing: the checked parameters and the values derived from them.
#ifndef STARFOCUS_LIB_ENGINE_LENS_H_
#define STARFOCUS_LIB_ENGINE_LENS_H_

#include <cstdint>

#include "lib/base/geometry.h"
#include "lib/base/jobs.h"
#include "lib/engine/borders.h"
#include "lib/engine/deblock.h"
#include "lib/engine/tables.h"
#include "lib/optics/view_weights.h"
#include "lib/plan/cells.h"
#include "starfocus/starfocus.h"

namespace starfocus {

struct Lens {
  starfocus_params params;
  Rect region;  // region of `params`, or the whole picture if no region is set
  const Renderer* renderer;
  double r_max;                  // Largest blur radius for the configured disparities, in pixels.
  const ViewWeights* apertures;  // Apertures of `renderer`, indexed by N.
  int32_t largest_n;             // Largest N of `apertures`.
  ViewWeights aperture;          // In frame modes, the aperture for the whole picture.
  BlurScale scale;
  Borders borders;
};

// Returns true if `region` is all 0, which selects the whole picture.
inline bool IsWhole(const starfocus_region& region) {
  return region.x == 0 && region.y == 0 && region.width == 0 && region.height == 0;
}

// Returns the rectangle of the picture that `params` select.
Rect RegionOf(const starfocus_config& config, const starfocus_params& params);

// Returns true if the result is a copy of the centre view, in any mode.
inline bool IsPinhole(const Lens& lens) { return lens.params.lens.aperture == 0; }

inline bool IsBlockMode(const Lens& lens) { return lens.params.mode == STARFOCUS_MODE_BLOCK; }

inline bool IsBenchmark(const Lens& lens) { return lens.params.mode == STARFOCUS_MODE_BENCHMARK; }

// Returns true if cells of smooth surfaces are blurred without views with this lens. Blurring
// without views supports only openings whose eight octants mirror each other.
inline bool Gathers(const starfocus_config& config, const Lens& lens) {
  const starfocus_lens& asked = lens.params.lens;
  const bool octant = asked.shape != STARFOCUS_SHAPE_POLYGON && asked.cats_eye == 0;
  return IsBlockMode(lens) && lens.renderer->gathers && config.tuning.gather != 0 && octant;
}

// Index of the largest PSF that blurs cells without views.
int32_t LastGatherStep(const Lens& lens);

// Returns the weights of the views of a block with n views along the radius.
inline const ViewWeights& WeightsOf(const Lens& lens, int32_t n) {
  return IsBlockMode(lens) ? lens.apertures[n] : lens.aperture;
}

// Returns true if the boundaries between blocks of different layers are smoothed.
inline bool IsDeblocking(const starfocus_config& config, const Lens& lens) {
  return IsBlockMode(lens) && config.tuning.max_layer > 0 && config.tuning.deblocking > 0;
}

// Returns the largest blur radius in pixels for the configured range of disparities.
double LargestBlur(const starfocus_config& config, const starfocus_params& params);

// Returns the largest aperture, at most 1, whose largest blur radius is at most max_blur.
double LargestAperture(const starfocus_config& config, const starfocus_lens& lens);

// Returns STARFOCUS_ERROR_BLUR if the largest blur radius exceeds max_blur, otherwise STARFOCUS_OK.
starfocus_status CheckBlur(const starfocus_config& config, const starfocus_params& params);

// Makes the lens for `params`, and the tables of the lens that do not exist yet. Returns
// STARFOCUS_ERROR_BLUR, STARFOCUS_ERROR_CANCELLED or STARFOCUS_OK. The caller must have checked all
// other requirements on `params`.
starfocus_status MakeLens(const starfocus_config& config, const starfocus_params& params,
                          CallProgress* call_progress, Tables* tables, Lens* lens);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_LENS_H_
