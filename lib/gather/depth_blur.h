// SPDX-License-Identifier: Apache-2.0
// Depth-dependent blur of the centre view alone (references [13] and [14] of the paper), for
// comparison with rendered views. Each output pixel is the mean of its neighbours, weighted by the
// ideal PSF (4) of its blur radius.
#ifndef STARFOCUS_LIB_GATHER_DEPTH_BLUR_H_
#define STARFOCUS_LIB_GATHER_DEPTH_BLUR_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/jobs.h"
#include "lib/io/input.h"
#include "lib/optics/psf.h"
#include "lib/plan/cells.h"

namespace starfocus {

struct BlurJob {
  const Input* input;  // If it reads excess, BlurRectangle adds the blurred excess to `out`.
  BlurScale scale;
  const Psf* psfs_of_radius;
  Rect rect;
  int32_t border;       // Largest Psf::size in the picture, in pixels.
  CancelToken* cancel;  // Cancels the call; `out` is incomplete after cancellation.
};

// Blurs job.rect into `out`, which starts at the first pixel of the rectangle. Scratch memory:
// `rgb` holds the light of the extended rectangle in packed rows, `accumulators` 3 * rect.width
// sums.
void BlurRectangle(const BlurJob& job, int16_t* rgb, uint32_t* accumulators, uint8_t* out,
                   size_t out_stride);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_GATHER_DEPTH_BLUR_H_
