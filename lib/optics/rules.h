// SPDX-License-Identifier: Apache-2.0
// Rules that choose the number of views and the layer for a blur radius.
#ifndef STARFOCUS_LIB_OPTICS_RULES_H_
#define STARFOCUS_LIB_OPTICS_RULES_H_

#include <cstdint>

#include "lib/optics/opening.h"

namespace starfocus {

// Class of an opening, which decides the number of views and the layers. Openings with sharper or
// narrower bright parts require more views and finer layers. Cat's eyes create corners and count as
// polygons.
enum class Demand { kFallOff, kDisc, kPolygon, kRing };
Demand DemandOf(const ApertureShape& opening);

// Returns the number of views along the aperture radius by (9). r_max >= 0 is in pixels. At r_max =
// 0 the result is 0, which stands for the centre view alone.
int32_t ViewsByPaper(double r_max);

// Returns N for views that each represent a subaperture: the radius of the lens in subapertures
// (LensInSubapertures of lib/optics/view_weights.h), rounded up. At r_max and at every smaller
// radius, the error of the PSF is at most the error with N from (9).
// examples/lab/analysis/subaperture_rule.h states the criterion. r_max is in [0, 128] pixels:
//
//   r_max <=  1/2  5.5   11   25   34   49   68   83  119  128
//   N           0    3    4    5    6    7    9   11   12   13
//
// For openings without fall-off, N is 0 or at least 4. For polygons and rings, which have corners
// and narrow parts, N is at least 6 above 5 pixels (docs/constants.md, Openings).
int32_t ViewsBySubaperture(double r_max, Demand demand = Demand::kFallOff);

// Returns n * scale, rounded up, where `n` is the result of ViewsByPaper or ViewsBySubaperture.
// `scale` is in [0.5, 2]; the result for n = 0 is 0.
int32_t ScaleViews(int32_t n, double scale);

// Returns the number of views along the aperture radius in benchmark mode: 2 * ceil(r_max).
int32_t ViewsOfBenchmark(double r_max);

// Return the layer, 0 to 2, for the smallest blur radius of a block in pixels. LayerByPaper
// implements (12). LayerBySubaperture is the more careful rule that complements ViewsBySubaperture;
// `depth_edges` is true if depth edges may splat into the block. For openings without fall-off,
// subsampling has a larger error. Without fall-off, layers begin at the radii where the error (10)
// is as small as at the first radius of openings with fall-off.
int32_t LayerByPaper(double r_min, Demand demand = Demand::kFallOff);
int32_t LayerBySubaperture(double r_min, bool depth_edges, Demand demand = Demand::kFallOff);

// Largest blur radius, in pixels, that is computed by filtering (gathering) instead of rendering
// views. The number of filter taps grows with the square of the radius. With a smaller limit,
// rendering is slower and less exact (docs/constants.md).
inline constexpr int32_t kMaxGather = 12;

// Returns the largest blur radius that is computed by filtering (gathering), if all blur radii are
// at most r_max.
constexpr double LargestGather(double r_max) { return r_max < kMaxGather ? r_max : kMaxGather; }

}  // namespace starfocus

#endif  // STARFOCUS_LIB_OPTICS_RULES_H_
