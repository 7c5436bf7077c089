// SPDX-License-Identifier: Apache-2.0
// SIMD kernel that converts the sums of composited views to a picture's accumulators.
#ifndef STARFOCUS_SIMD_FINISH_COMPOSITE_H_
#define STARFOCUS_SIMD_FINISH_COMPOSITE_H_

#include <cstddef>
#include <cstdint>

#include "simd/light.h"
#include "simd/samples.h"

namespace starfocus::simd {

// Parameters of FinishComposite. Pixels with a coverage below `least` get the colour of the centre
// view. Accumulators have `bits` fractional bits.
struct CompositeFinish {
  uint32_t least;  // Smallest coverage by which colours are divided, > 0.
  int bits;        // Fractional bits of accumulators, [kLightBits, 24].
};
inline constexpr int kInverseBits = 48;

namespace reference {

// Divides colours by coverage. Colour c of pixel n is sums[c * plane + n], and its coverage is
// covered = sums[3 * plane + n]. If covered >= least, out[3 n + c] is sums[c * plane + n] *
// (2^kInverseBits / covered) in units of 2^-bits. The division truncates; the product is rounded
// half up and limited to 255. If covered < least, out[3 n + c] is the light centre[3 n + c],
// converted to units of 2^-bits. Sums are read in whole groups of kSliceLanes; nothing past out[3
// count - 1] is written.
void FinishComposite(const uint32_t* sums, size_t plane, const int16_t* centre,
                     const CompositeFinish& finish, size_t count, uint32_t* out);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_FINISH_COMPOSITE_H_
