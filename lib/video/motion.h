// SPDX-License-Identifier: Apache-2.0
// Motion between the centre views of two frames, by block matching from coarse to fine.
#ifndef STARFOCUS_LIB_VIDEO_MOTION_H_
#define STARFOCUS_LIB_VIDEO_MOTION_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/arena.h"
#include "lib/base/geometry.h"
#include "lib/base/jobs.h"
#include "simd/kernels.h"

namespace starfocus {

inline constexpr int32_t kMotionBlock = 8;  // side of a block, pixels of its level
inline constexpr int32_t kMotionLevels = 5;

// A motion in whole pixels: the point at (x, y) of a frame was at (x + across, y + down) in the
// frame before.
struct Motion {
  int16_t across, down;
};

inline bool operator==(const Motion& a, const Motion& b) {
  return a.across == b.across && a.down == b.down;
}

// Luma of a frame at half the resolution of the level below. Level 0 has that of the picture.
struct LumaLevel {
  int32_t width, height;
  Plane<uint8_t> luma;
};

struct LumaPyramid {
  int32_t levels;
  LumaLevel level[kMotionLevels];
};

// Number of blocks across or down `pixels` pixels.
constexpr int32_t MotionBlocks(int32_t pixels) {
  return (pixels + kMotionBlock - 1) / kMotionBlock;
}

// Motions of blocks, of which the last column and row may have fewer pixels.
struct MotionField {
  int32_t columns, rows;
  Motion* blocks;

  Motion& At(int32_t column, int32_t row) const { return blocks[row * columns + column]; }
};

// Takes memory of a frame of width x height pixels.
LumaPyramid TakePyramid(int32_t width, int32_t height, Arena* arena);
// Takes memory for the motions of all levels of a pyramid.
void TakeMotion(const LumaPyramid& pyramid, Arena* arena, MotionField fields[kMotionLevels]);

// Computes the luma of packed RGB rows, and the levels above it.
starfocus_status FillPyramid(const Plane<const uint8_t>& rgb, const LumaPyramid& pyramid,
                             Jobs* jobs);

// Finds the motion of each block of the pyramid `now` since `before`. The motions of the picture
// are those of fields[0].
starfocus_status FindMotion(const simd::VideoKernels& kernels, const LumaPyramid& before,
                            const LumaPyramid& now, const MotionField fields[kMotionLevels],
                            Jobs* jobs);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_VIDEO_MOTION_H_
