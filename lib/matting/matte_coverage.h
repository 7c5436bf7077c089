// SPDX-License-Identifier: Apache-2.0
// Computes the coverage of a light field from a matte of the subject and the depth map. The matte
// replaces the coverage that the map implies only at outlines of the subject. Other edges of the
// map, and parts of the matte that the map contradicts, keep the implied coverage.
#ifndef STARFOCUS_LIB_MATTING_MATTE_COVERAGE_H_
#define STARFOCUS_LIB_MATTING_MATTE_COVERAGE_H_

#include "lib/io/depth_map.h"
#include "starfocus/matte.h"

namespace starfocus {

// Number of pixels around an area whose disparities MatteCoverage reads.
inline constexpr int32_t kMatteReach = 35;

// Writes the coverage of `area`. out.Row(y) receives row y of the picture, starting with column
// area.x. All disparities must be known. `depth.columns` is ignored.
void MatteCoverage(const simd::ImageKernels& kernels, const starfocus_matte& matte,
                   const DepthSource& depth, const Rect& area, const Plane<uint8_t>& out);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_MATTING_MATTE_COVERAGE_H_
