// SPDX-License-Identifier: Apache-2.0
// Depth-dependent image blurring of the centre view alone (the paper's [13], [14]): the classical
// rival, each output pixel the ideal PSF (4) of its own blur radius.
#ifndef STARFOCUS_LIB_FILTER_BLUR_H_
#define STARFOCUS_LIB_FILTER_BLUR_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/aperture_shape.h"
#include "lib/base/call_progress.h"
#include "lib/filter/add_excess.h"
#include "lib/filter/span_list.h"
#include "lib/input/window.h"
#include "lib/plan/block_stats.h"
#include "simd/kernels.h"

namespace starfocus {

// Kernels of a ladder of radii: steps of 1/8 px up to 4 px, of 1/32 of the radius beyond.
int32_t BlurStep(int32_t radius);  // of a radius with kDisparityBits
int32_t BlurStepCount(double max_blur);
int32_t RadiusOfStep(int32_t step);  // kDisparityBits
// The steps of the largest radius that is not larger, and of the smallest that is not smaller.
int32_t BlurStepBelow(int32_t radius);
int32_t BlurStepAbove(int32_t radius);

// The octant 0 <= m <= n of one PSF, or, when `full`, all of it; weights sum to exactly
// 2^sum_bits over the plane, and those of an octant that four pixels share, or two on an axis, fit
// 15 bits together. What is farther than the focus sees it turned by half a turn.
struct Psf {
  int32_t size;  // n of the outermost weights
  int sum_bits;
  bool full;
  const uint16_t* weights;  // at n (n + 1) / 2 + m, or rows m one after the other

  uint32_t Weight(int32_t n, int32_t m) const {
    return full ? weights[(m + size) * (2 * size + 1) + n + size] : OctantWeight(n, m);
  }
  uint32_t OctantWeight(int32_t n, int32_t m) const {
    const int32_t a = Abs(n), b = Abs(m), high = Max(a, b), low = Min(a, b);
    return weights[high * (high + 1) / 2 + low];
  }
};

// Weights that all kernels up to max_blur store together, of an octant or full.
size_t BlurWeightCount(bool full, double max_blur);

// Makes the kernels of steps [first, last), first <= last, behind those before, which must have
// been made; kernels[BlurStepCount], weights[BlurWeightCount]. Cat's eyes are left out. Returns
// `last`, or the step at which the call was cancelled (a null token never cancels).
int32_t MakePsfs(int32_t first, int32_t last, const ApertureShape& opening, CancelToken* cancel,
                 uint16_t* weights, Psf* kernels);

struct BlurJob {
  const Window* window;
  BlurScale scale;
  const Psf* psfs_of_radius;
  const simd::Kernels* kernels;
  Rect rect;
  int32_t border;       // largest PSF size in the picture
  ExcessSum excess;     // with a factor the window's excess is added to `out`
  CancelToken* cancel;  // once it ends, `out` is left half made
};

struct BlurScratch {
  int16_t* rgb;            // light of the extended rectangle, rows packed
  uint32_t* accumulators;  // 3 * rect.width
  SpanMemory spans;
};

// Blurs job.rect into `out`, whose first row is the rectangle's.
void BlurRectangle(const BlurJob& job, const BlurScratch& scratch, uint8_t* out, size_t out_stride);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_FILTER_BLUR_H_
