// SPDX-License-Identifier: Apache-2.0
// Disparity maps of a video that do not flicker: the map of a frame is fused with the maps of the
// frames before it, which follow the motion of the picture.
#ifndef STARFOCUS_LIB_VIDEO_STABILISE_H_
#define STARFOCUS_LIB_VIDEO_STABILISE_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/arena.h"
#include "lib/base/config.h"
#include "lib/base/geometry.h"
#include "lib/base/jobs.h"
#include "lib/video/fuse.h"
#include "lib/video/motion.h"
#include "simd/kernels.h"

namespace starfocus {

// A frame, and the surfaces of its pixels. Disparities have kDisparityBits fractional bits.
struct StableFrame {
  Plane<uint8_t> rgb;
  LumaPyramid luma;
  Plane<int16_t> disparity, other;  // of the surface, and of the other surface
  Plane<uint8_t> count, others;     // measurements of both; `count` 0: the pixel is new
  Plane<uint8_t> coverage;          // valid if has_coverage is true
  bool has_coverage;
};

// Sums of a band of rows, for the change of all disparities since the frame before.
struct DriftSums {
  int64_t count, x, y, xx, xy, yy;
};

struct StabiliserReport {
  int64_t followed, kept;  // Pixels found in the frame before; those that keep their surface.
  bool is_cut;             // Too few pixels were found, so all surfaces start with this frame.
  Drift drift;
};

struct Stabiliser {
  FullConfig config;
  const simd::VideoKernels* kernels;
  Jobs* jobs;
  StableFrame frames[2];
  int32_t current;  // index of the last frame
  // Largest difference between disparities of one surface (kDisparityBits): at least a pixel, and
  // more in maps of a large range.
  int32_t tolerance;
  int32_t length;           // number of frames since the start or the last cut, at most kMostLength
  Plane<int16_t> given;     // disparities of the map of the next frame, kNoSurface: unknown
  Plane<uint8_t> coverage;  // its coverage, if its frame has coverage
  Plane<uint8_t> relations;  // see Fusion::relations
  uint32_t* columns;         // see DepthSource::columns
  MotionField motion[kMotionLevels];
  DriftSums* sums;        // of each row of blocks
  int64_t* sums_of_rows;  // of pixels
};

// Returns the address of sample x of row y of a plane with a border, which may lie in the border.
template <class T>
T* At(const Plane<T>& plane, int32_t x, int32_t y) {
  return plane.data + (ptrdiff_t{y} * static_cast<ptrdiff_t>(plane.stride) + x);
}
inline uint8_t* PixelAt(const Plane<uint8_t>& rgb, int32_t x, int32_t y) {
  return At(rgb, 3 * x, y);
}

// Repeats the pixels at the edges of the picture in the border of its plane.
void PadColours(const FullConfig& config, const Plane<uint8_t>& rgb);

// Takes the memory of a stabiliser, but not the object itself.
void TakeStabiliser(const FullConfig& config, Arena* arena, Stabiliser* stabiliser);

// Fuses the map of the next frame, which stabiliser->given contains, with its colours in the frame
// after `current`, and makes it the current frame. Returns STARFOCUS_OK, STARFOCUS_ERROR_CANCELLED
// or STARFOCUS_ERROR_RUNNER; after an error, the current frame remains.
starfocus_status Stabilise(Stabiliser* stabiliser, StabiliserReport* report);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_VIDEO_STABILISE_H_
