// SPDX-License-Identifier: Apache-2.0
#include "simd/arithmetic_ref.h"
#include "simd/disc.h"

namespace starfocus::simd::reference {
namespace {

// Returns the disc's sum around the sample at `at`.
uint32_t DiscSum(const int16_t* at, ptrdiff_t stride, const Disc& disc) {
  uint32_t sum = 0;
  for (int32_t y = 0; y <= disc.size; ++y) {
    for (int32_t x = 0; x <= disc.size; ++x) {
      const int32_t high = x > y ? x : y, low = x > y ? y : x;
      const auto column = [&](int32_t pixel) {
        const int16_t* sample = at + 3 * ptrdiff_t{pixel};
        const ptrdiff_t down = y * stride;
        return Mean(sample[-down], sample[down]);
      };
      const int32_t pixels = (x > 0 ? 2 : 1) * (y > 0 ? 2 : 1);
      const int32_t weight = pixels * disc.weights[high * (high + 1) / 2 + low];
      sum += static_cast<uint32_t>(weight * Mean(column(-x), column(x)));
    }
  }
  return sum;
}

// Returns the light of a disc's sum without its last `dropped` bits.
int32_t LightOf(uint32_t sum, const Disc& disc, int dropped) {
  const int bits = disc.bits + dropped;
  return static_cast<int32_t>((sum + (uint32_t{1} << bits >> 1)) >> bits);
}

}  // namespace

void FilterDisc(const int16_t* in, size_t in_stride, const Disc& disc, const Encoding& encoding,
                size_t rows, size_t count, uint8_t* out, size_t out_stride) {
  const int whole = encoding.entries == nullptr ? kLightBits : 0;  // bits of light that are none
  for (size_t row = 0; row < rows; ++row, in += in_stride, out += out_stride) {
    for (size_t n = 0; n < count; ++n) {
      const uint32_t sum = DiscSum(in + n, static_cast<ptrdiff_t>(in_stride), disc);
      const auto light = static_cast<int16_t>(LightOf(sum, disc, whole) << whole);
      Encode(&light, 1, encoding, out + n);
    }
  }
}

void FilterDiscLayer(const int16_t* in, size_t in_stride, const Disc& disc, size_t rows,
                     size_t count, int16_t* out, size_t out_stride) {
  for (size_t row = 0; row < rows; ++row, in += in_stride, out += out_stride) {
    for (size_t n = 0; n < count; ++n) {
      const uint32_t sum = DiscSum(in + n, static_cast<ptrdiff_t>(in_stride), disc);
      out[n] = static_cast<int16_t>(LightOf(sum, disc, kLightBits - kLayerBits));
    }
  }
}

void FilterTwoDiscs(const int16_t* in, size_t in_stride, const Disc& less, const Disc& more,
                    size_t rows, size_t count, int16_t* out_less, int16_t* out_more,
                    size_t out_stride) {
  FilterDiscLayer(in, in_stride, less, rows, count, out_less, out_stride);
  FilterDiscLayer(in, in_stride, more, rows, count, out_more, out_stride);
}

}  // namespace starfocus::simd::reference
