// SPDX-License-Identifier: Apache-2.0
// Selection rules of the paper: how many views a blur radius needs.
#ifndef STARFOCUS_LIB_BASE_RULES_H_
#define STARFOCUS_LIB_BASE_RULES_H_

#include <cstdint>

#include "lib/base/aperture_shape.h"

namespace starfocus {

// How much an opening asks of views and layers: the sharper and the narrower its bright parts, the
// more. What cat's eyes leave has corners as a polygon has.
enum class Demand { kFallOff, kDisc, kPolygon, kRing };
Demand DemandOf(const ApertureShape& opening);

// Views along the aperture radius by (9). r_max >= 0 in pixels; 0 needs the centre view alone.
int32_t ViewsByPaper(double r_max);

// N for views that each stand for their subaperture, however wide: the radius of
// the lens in subapertures, rounded up (LensInSubapertures of lib/aperture.h). At least as good as
// (9) for every smaller radius too (lib/analysis/subaperture_rule.h has the criterion). r_max in
// [0, 128]:
//
//   r_max <=  1/2  5.5   11   25   34   49   68   83  119  128
//   N           0    3    4    5    6    7    9   11   12   13
//
// Openings that don't fall off have 4 at least. Polygons and rings have corners and narrow parts:
// from 5 px on their N is 6 at least (docs/constants.md, Openings).
int32_t ViewsBySubaperture(double r_max, Demand demand = Demand::kFallOff);

// N of either rule times `scale` in [0.5, 2], rounded up; 0 and a scale of 1 change nothing.
int32_t ScaleViews(int32_t n, double scale);

// Views along the aperture radius of the benchmark: 2 * ceil(r_max).
int32_t ViewsOfBenchmark(double r_max);

// Subsampled layer, up to 2, for the smallest blur radius of a block in pixels: by (12), and the
// more careful choice beside ViewsBySubaperture, for blocks that depth edges may splat into and
// others. Of openings that don't fall off, layers keep less: they begin at larger radii, where the
// error (10) has come down to what it is at the first radius of the fall-off.
int32_t LayerByPaper(double r_min, Demand demand = Demand::kFallOff);
int32_t LayerBySubaperture(double r_min, bool depth_edges, Demand demand = Demand::kFallOff);

// Largest blur radius, in pixels, of what is gathered instead of rendered view by view: the taps of
// the gathering kernel grow with its square. Less is slower and less exact (docs/constants.md).
inline constexpr int32_t kMaxGather = 12;

// The same where no blur is larger than r_max.
constexpr double LargestGather(double r_max) { return r_max < kMaxGather ? r_max : kMaxGather; }

}  // namespace starfocus

#endif  // STARFOCUS_LIB_BASE_RULES_H_
