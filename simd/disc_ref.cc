// SPDX-License-Identifier: Apache-2.0
#include "simd/disc.h"
#include "simd/samples.h"

namespace starfocus::simd::reference {
namespace {

// Returns the weighted sum of the disc around sample n of a row.
uint32_t DiscSum(const SampleRows& in, size_t row, size_t n, const Disc& disc) {
  const auto stride = static_cast<ptrdiff_t>(in.stride);
  const int16_t* at = in.samples + row * in.stride + n;
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

// Converts the weighted sum of a disc to light. Rounding removes the `dropped` lowest bits of the
// light.
int32_t LightOf(uint32_t sum, const Disc& disc, int dropped) {
  const int bits = disc.bits + dropped;
  return static_cast<int32_t>((sum + (uint32_t{1} << bits >> 1)) >> bits);
}

}  // namespace

void FilterDisc(const SampleRows& in, const Disc& disc, const Encoding& encoding, uint8_t* out,
                size_t out_stride) {
  // Number of fractional bits of the light that rounding removes before the light is encoded.
  const int whole = encoding.entries == nullptr ? kLightBits : 0;
  for (size_t row = 0; row < in.rows; ++row, out += out_stride) {
    for (size_t n = 0; n < in.count; ++n) {
      const uint32_t sum = DiscSum(in, row, n, disc);
      const auto light = static_cast<int16_t>(LightOf(sum, disc, whole) << whole);
      Encode(&light, 1, encoding, out + n);
    }
  }
}

void FilterDiscLayer(const SampleRows& in, const Disc& disc, int16_t* out, size_t out_stride) {
  for (size_t row = 0; row < in.rows; ++row, out += out_stride) {
    for (size_t n = 0; n < in.count; ++n) {
      const uint32_t sum = DiscSum(in, row, n, disc);
      out[n] = static_cast<int16_t>(LightOf(sum, disc, kLightBits - kLayerBits));
    }
  }
}

void FilterTwoDiscs(const SampleRows& in, const Disc& less, const Disc& more, int16_t* out_less,
                    int16_t* out_more, size_t out_stride) {
  FilterDiscLayer(in, less, out_less, out_stride);
  FilterDiscLayer(in, more, out_more, out_stride);
}

}  // namespace starfocus::simd::reference
