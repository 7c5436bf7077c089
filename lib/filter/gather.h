// SPDX-License-Identifier: Apache-2.0
// 8x8 cells of one surface: every pixel gathered from the centre view with the ideal kernel (4) of
// the blur around it. Where disparity hardly changes as far as the blur reaches, that is what all
// views of the aperture together show.
#ifndef STARFOCUS_LIB_FILTER_GATHER_H_
#define STARFOCUS_LIB_FILTER_GATHER_H_

#include <cstdint>

#include "lib/base/rules.h"
#include "lib/base/watch.h"
#include "lib/filter/blur.h"
#include "lib/input/field.h"
#include "lib/plan/block_stats.h"
#include "simd/kernels.h"

namespace starfocus {

static_assert(kMaxGather + 1 <= simd::kMaxDisc,
              "a kernel's edge lies in the pixel beyond its radius");

struct GatherJob {
  const Window* window;  // at layer 0
  const CellGrid* cells;
  const GatherMap* gathered;
  BlurScale scale;
  const BlurKernel* kernels_of_radius;
  const simd::Kernels* kernels;
  Rect rect;           // its corner a multiple of kCellSize
  Patience* patience;  // once it ends, `out` is left half made
};

// Gathers the cells of the map in job.rect into `out`, whose first row is the rectangle's; `field`
// has room for it and its border. Returns their pixels.
uint64_t GatherRectangle(const GatherJob& job, Field* field, uint8_t* out, size_t out_stride);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_FILTER_GATHER_H_
