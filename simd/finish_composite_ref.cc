// SPDX-License-Identifier: Apache-2.0
#include "simd/finish_composite.h"

namespace starfocus::simd::reference {

void FinishComposite(const uint32_t* sums, size_t plane, const int16_t* centre,
                     const CompositeFinish& finish, size_t count, uint32_t* out) {
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

}  // namespace starfocus::simd::reference
