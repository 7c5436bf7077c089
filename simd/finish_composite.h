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
STARFOCUS_REFERENCE void FinishComposite(const uint32_t* sums, size_t plane, const int16_t* centre,
                                         const CompositeFinish& finish, size_t count,
                                         uint32_t* out) {
  const int shift = kInverseBits - 8 - finish.bits;
  const uint64_t white = uint64_t{255} << finish.bits, half = uint64_t{1} << (shift - 1);
  for (size_t n = 0; n < count; ++n) {
    const uint32_t covered = sums[3 * plane + n];
    const bool missing = covered < finish.least;
    const uint64_t inverse = missing ? 0 : (uint64_t{1} << kInverseBits) / covered;
    for (size_t c = 0; c < 3; ++c) {
      const uint64_t value = (sums[c * plane + n] * inverse + half) >> shift;
      out[3 * n + c] = missing
                           ? static_cast<uint32_t>(centre[3 * n + c]) << (finish.bits - kLightBits)
                           : static_cast<uint32_t>(value < white ? value : white);
    }
  }
}

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_FINISH_COMPOSITE_H_
