// SPDX-License-Identifier: Apache-2.0
// The lens of a refocusing.
#ifndef STARFOCUS_LIB_ENGINE_LENS_H_
#define STARFOCUS_LIB_ENGINE_LENS_H_

#include <cstdint>

#include "lib/base/call_progress.h"
#include "lib/base/geometry.h"
#include "lib/base/view_weights.h"
#include "lib/engine/borders.h"
#include "lib/engine/tables.h"
#include "lib/filter/deblock.h"
#include "lib/plan/block_stats.h"
#include "starfocus/starfocus.h"

namespace starfocus {

struct Lens {
  starfocus_params params;
  Rect region;  // of params, the whole picture when they have none
  const Renderer* renderer;
  double r_max;  // largest blur radius of the configured range of disparities, pixels
  const ViewWeights* apertures;  // the renderer's, by N
  int32_t largest_n;             // of these
  ViewWeights aperture;          // frame modes: of the one N
  BlurScale scale;
  Borders borders;
};

// Whether no region is asked for, which means the whole picture.
inline bool IsWhole(const starfocus_region& region) {
  return region.x == 0 && region.y == 0 && region.width == 0 && region.height == 0;
}

// The rectangle that params ask for.
Rect RegionOf(const starfocus_config& config, const starfocus_params& params);

// Whether the picture is the centre view itself, in any mode.
inline bool IsPinhole(const Lens& lens) { return lens.params.lens.aperture == 0; }

inline bool IsBlockMode(const Lens& lens) { return lens.params.mode == STARFOCUS_MODE_BLOCK; }

inline bool IsBenchmark(const Lens& lens) { return lens.params.mode == STARFOCUS_MODE_BENCHMARK; }

// Whether smooth cells are gathered: the kernel for that knows no lens but those that an octant
// tells.
inline bool Gathers(const starfocus_config& config, const Lens& lens) {
  const starfocus_lens& asked = lens.params.lens;
  const bool octant = asked.shape != STARFOCUS_SHAPE_POLYGON && asked.cats_eye == 0;
  return IsBlockMode(lens) && lens.renderer->gathers && config.tuning.gather != 0 && octant;
}

// The last step of the kernels that are made for gathering.
int32_t LastGatherStep(const Lens& lens);

// The aperture of a block with the rule's N.
inline const ViewWeights& WeightsOf(const Lens& lens, int32_t n) {
  return IsBlockMode(lens) ? lens.apertures[n] : lens.aperture;
}

// Whether blocks of different layers are joined.
inline bool IsDeblocking(const starfocus_config& config, const Lens& lens) {
  return IsBlockMode(lens) && config.tuning.max_layer > 0 && config.tuning.deblocking > 0;
}

// Blur radius of the configured range's farther end.
double LargestBlur(const starfocus_config& config, const starfocus_params& params);

// Returns STARFOCUS_ERROR_BLUR if the engine is not made for the largest blur of the params, else
// STARFOCUS_OK.
starfocus_status CheckBlur(const starfocus_config& config, const starfocus_params& params);

// Makes the lens for params, and the tables that it needs and that are not there yet. Returns
// STARFOCUS_ERROR_BLUR, STARFOCUS_ERROR_CANCELLED or STARFOCUS_OK. The other fields of params must
// have been checked.
starfocus_status MakeLens(const starfocus_config& config, const starfocus_params& params,
                          CallProgress* call_progress, Tables* tables, Lens* lens);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_LENS_H_
