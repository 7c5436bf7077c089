// SPDX-License-Identifier: Apache-2.0
// Point-spread functions (PSFs) of blur radii, as integer weights of pixels: the ideal PSF (4) of a
// lens, integrated over pixels. lib/gather filters the centre view with these PSFs.
#ifndef STARFOCUS_LIB_OPTICS_PSF_H_
#define STARFOCUS_LIB_OPTICS_PSF_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/fixed.h"
#include "lib/base/jobs.h"
#include "lib/optics/opening.h"

namespace starfocus {

// PSFs exist for radii in steps of 1/8 pixel up to 4 pixels, and for 32 radii per octave beyond 4
// pixels. Radii have kDisparityBits fractional bits.
int32_t PsfIndex(int32_t radius);  // radius: kDisparityBits
int32_t PsfCount(double max_blur);
int32_t RadiusOfPsf(int32_t index);  // result: kDisparityBits
// Return the index of the largest radius that does not exceed `radius`, and of the smallest radius
// that is at least `radius`.
int32_t PsfBelow(int32_t radius);
int32_t PsfAbove(int32_t radius);

// Weights of a PSF: the octant 0 <= m <= n, or all weights if `full` is true. The weights of all
// pixels sum to exactly 2^sum_bits. In an octant, the sum of the equal weights of four mirrored
// pixels, or of two mirrored pixels on an axis, fits in 15 bits. Pixels farther than the focus use
// the PSF rotated by half a turn.
struct Psf {
  int32_t size;  // distance in pixels, along an axis, from the centre to the outermost weights
  int sum_bits;
  bool full;
  // octant: weight (n, m) at index n (n + 1) / 2 + m; full: rows of weights
  const uint16_t* weights;

  uint32_t Weight(int32_t n, int32_t m) const {
    return full ? weights[(m + size) * (2 * size + 1) + n + size] : OctantWeight(n, m);
  }
  uint32_t OctantWeight(int32_t n, int32_t m) const {
    const int32_t a = Abs(n), b = Abs(m), high = Max(a, b), low = Min(a, b);
    return weights[high * (high + 1) / 2 + low];
  }
};

// Returns the number of weights of all PSFs up to max_blur, counting an octant of each PSF or, if
// `full`, all weights.
size_t BlurWeightCount(bool full, double max_blur);

// Computes the PSFs of steps [first, last), first <= last. The PSFs of all steps before `first`
// must exist. The arrays must have room for psfs[PsfCount] and weights[BlurWeightCount].
// The PSFs ignore cat's eyes. Returns `last`, or the index at which the call was cancelled.
// `cancel` may be null.
int32_t MakePsfs(int32_t first, int32_t last, const ApertureShape& opening, CancelToken* cancel,
                 uint16_t* weights, Psf* psfs);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_OPTICS_PSF_H_
