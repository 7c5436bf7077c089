// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>

#include "simd/disc.h"

namespace starfocus::simd::reference {
namespace {

uint32_t DiscWeight(const Disc& disc, int32_t x, int32_t y) {
  const int32_t a = std::abs(x), b = std::abs(y), high = a > b ? a : b, low = a > b ? b : a;
  return disc.weights[high * (high + 1) / 2 + low];
}

}  // namespace

void FilterDisc(const uint8_t* in, size_t in_stride, const Disc& disc, size_t rows, size_t count,
                uint8_t* out, size_t out_stride) {
  for (size_t row = 0; row < rows; ++row, in += in_stride, out += out_stride) {
    for (size_t n = 0; n < count; ++n) {
      uint32_t sum = uint32_t{1} << disc.bits >> 1;
      for (int32_t y = -disc.size; y <= disc.size; ++y) {
        const uint8_t* at = in + n + y * static_cast<ptrdiff_t>(in_stride);
        for (int32_t x = -disc.size; x <= disc.size; ++x) sum += DiscWeight(disc, x, y) * at[3 * x];
      }
      out[n] = static_cast<uint8_t>(sum >> disc.bits);
    }
  }
}

}  // namespace starfocus::simd::reference
