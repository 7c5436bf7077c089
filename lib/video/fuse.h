// SPDX-License-Identifier: Apache-2.0
// Fuses the map of a frame with the surfaces of its pixels in the frames before.
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

// Relation of a measurement to the surface of its pixel.
enum class Relation : uint8_t {
  kNew,      // the pixel has no surface yet
  kSame,     // the measurement is on the surface, or missing
  kKept,     // the measurement is on another surface, which has too few of them
  kReplaced  // the other surface replaces the surface
};

// Planes of a frame to fuse. Disparities have kDisparityBits fractional bits.
struct Fusion {
  int32_t width, height;
  // Largest difference between disparities of one surface.
  int32_t tolerance;
  Drift of_map, of_before;  // from the map, and from the frame before, to their mean scale
  Plane<int16_t> given;     // measurements, kNoSurface: unknown
  // Disparities of the surface and of another surface of each pixel, and the numbers of their
  // measurements; a count of 0: no surface. FuseRows changes them from the frame before to this
  // one.
  Plane<int16_t> disparity, other;
  Plane<uint8_t> count, others;
  Plane<uint8_t> relations;  // elements are Relation
  // Coverage of the frame, and mean coverage, which FuseRows changes; null: none.
  Plane<uint8_t> given_coverage, coverage;
};

// Sets the relations of rows.
void RelateRows(const Fusion& fusion, const Range& rows);

// Fuses rows, after all relations are set. Returns the number of pixels that keep their surface.
int64_t FuseRows(const Fusion& fusion, const Range& rows);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_VIDEO_FUSE_H_
