// SPDX-License-Identifier: Apache-2.0
// Fuses the map of a frame with what is known of its pixels from the frames before.
//
// Each pixel has a surface, which is the mean of the disparities that were measured on it, and the
// number of these measurements. A measurement on another surface does not change the disparity at
// once, because the outlines of maps change from frame to frame: it counts for the other surface,
// which takes over as soon as it has more measurements. A map is wrong only near its outlines, so
// farther away the measurement decides.
#ifndef STARFOCUS_LIB_VIDEO_FUSE_H_
#define STARFOCUS_LIB_VIDEO_FUSE_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/fixed.h"
#include "lib/base/geometry.h"
#include "simd/kernels.h"

namespace starfocus {

// A change of all disparities of a map: d + (scale d >> kDriftBits) + offset. |scale| <= 2^14.
struct Drift {
  int32_t scale, offset;
};
inline constexpr int kDriftBits = 16;

inline int32_t Drifted(const Drift& drift, int32_t disparity) {
  return disparity + drift.offset +
         ((drift.scale * disparity + (1 << (kDriftBits - 1))) >> kDriftBits);
}

// How a measurement relates to what is known of its pixel.
enum class Relation : uint8_t {
  kNew,      // nothing is known
  kSame,     // the measurement is on the known surface, or missing
  kKept,     // the measurement is on another surface, but too rarely so
  kReplaced  // the other surface takes over
};

// What is fused: planes of one frame. Disparities have kDisparityBits fractional bits.
struct Fusion {
  int32_t width, height;
  // Largest difference between disparities of one surface.
  int32_t tolerance;
  Drift of_map, of_before;  // changes of the map and of what is known to their mean scale
  Plane<int16_t> given;     // measurements, kNoSurface: unknown
  // What is known, which FuseRows replaces by what is known after the frame: the surface, another
  // surface, and the numbers of their measurements. A count of 0 means that nothing is known.
  Plane<int16_t> disparity, other;
  Plane<uint8_t> count, others;
  Plane<uint8_t> relations;  // elements are Relation
  // Coverage of the map and what is known of it; null: none.
  Plane<uint8_t> given_coverage, coverage;
};

// Sets the relations of rows.
void RelateRows(const Fusion& fusion, const Range& rows);

// Fuses rows, after all relations are set. Returns the number of pixels that keep their surface.
int64_t FuseRows(const Fusion& fusion, const Range& rows);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_VIDEO_FUSE_H_
