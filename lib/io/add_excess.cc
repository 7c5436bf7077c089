// SPDX-License-Identifier: Apache-2.0
#include "lib/io/add_excess.h"

namespace starfocus {

int32_t ExcessFactor(float highlights) {
  return static_cast<int32_t>((highlights - 1.0F) * (1 << kExcessBits) + 0.5F);
}

void AddExcess(const ExcessSum& excess, const uint32_t* sums, size_t count, int shift,
               uint8_t* codes) {
  constexpr size_t kAtOnce = 96;
  const int bits = shift - kLightBits + kExcessBits;
  const uint64_t half = uint64_t{1} << (bits - 1);
  int16_t light[kAtOnce];
  for (size_t begin = 0; begin < count; begin += kAtOnce) {
    const size_t end = count - begin < kAtOnce ? count : begin + kAtOnce;
    for (size_t n = begin; n < end; ++n) {
      // The product of the sum and the factor is at most 2^32 * 63 * 2^8.
      const uint64_t more =
          (uint64_t{sums[n]} * static_cast<uint64_t>(excess.factor) + half) >> bits;
      const uint64_t sum = static_cast<uint64_t>(excess.transfer->light[codes[n]]) + more;
      light[n - begin] = sum < kLightWhite ? static_cast<int16_t>(sum) : kLightWhite;
    }
    excess.kernels->Encode(light, end - begin, excess.transfer->encoding, codes + begin);
  }
}

}  // namespace starfocus
