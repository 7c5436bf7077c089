// SPDX-License-Identifier: Apache-2.0
#include "simd/resample.h"

namespace starfocus::simd::reference {
namespace {

int16_t RoundTaps(int32_t sum, const SampleRange& range) {
  const int32_t value = (sum + (1 << (kTapBits - 1))) >> kTapBits;
  return static_cast<int16_t>(value < range.low    ? range.low
                              : value > range.high ? range.high
                                                   : value);
}

}  // namespace

void WidenPhases(const uint8_t* in, size_t pairs, const Encoding& encoding, int16_t* even,
                 int16_t* odd) {
  const auto sample = [&](uint8_t code) {
    int16_t light = 0;
    Decode(&code, 1, encoding, &light);
    return static_cast<int16_t>((light + 1) >> (kLightBits - kLayerBits));
  };
  for (size_t n = 0; n < pairs; ++n) {
    for (size_t c = 0; c < 3; ++c) {
      even[3 * n + c] = sample(in[6 * n + c]);
      odd[3 * n + c] = sample(in[6 * n + 3 + c]);
    }
  }
}

void SplitPhases(const int16_t* in, size_t pairs, int16_t* even, int16_t* odd) {
  for (size_t n = 0; n < pairs; ++n) {
    for (size_t c = 0; c < 3; ++c) {
      even[3 * n + c] = in[6 * n + c];
      odd[3 * n + c] = in[6 * n + 3 + c];
    }
  }
}

void Narrow(const int16_t* in, size_t count, const Encoding& encoding, uint8_t* out) {
  for (size_t n = 0; n < count; ++n) {
    if (encoding.entries != nullptr) {
      const auto light = static_cast<int16_t>(in[n] << (kLightBits - kLayerBits));
      Encode(&light, 1, encoding, out + n);
      continue;
    }
    const int odd = (in[n] >> kLayerBits) & 1;
    const int value = (in[n] + (1 << (kLayerBits - 1)) - 1 + odd) >> kLayerBits;
    out[n] = static_cast<uint8_t>(value);
  }
}

void FinishLayer(const uint32_t* accumulators, size_t count, int shift, int16_t* out) {
  const uint32_t half = uint32_t{1} << (shift - kLayerBits - 1);
  for (size_t n = 0; n < count; ++n) {
    out[n] = static_cast<int16_t>((accumulators[n] + half) >> (shift - kLayerBits));
  }
}

void FilterHalfBand(const int16_t* in, ptrdiff_t step, const HalfBand& taps, size_t count,
                    const SampleRange& range, int16_t* out) {
  for (size_t n = 0; n < count; ++n) {
    const int16_t* at = in + n;
    out[n] = RoundTaps(taps.centre * at[0] + taps.near * (at[-step] + at[step]) +
                           taps.far * (at[-3 * step] + at[3 * step]),
                       range);
  }
}

void Halve(const int16_t* even, const int16_t* odd, const HalfBand& taps, size_t count,
           int16_t* out) {
  for (size_t n = 0; n < count; ++n) {
    const int16_t* at = odd + n;
    out[n] = RoundTaps(
        taps.centre * even[n] + taps.near * (at[-3] + at[0]) + taps.far * (at[-6] + at[3]),
        {INT16_MIN, INT16_MAX});
  }
}

void Between(const int16_t* in, ptrdiff_t step, const HalfBand& taps, size_t count,
             const SampleRange& range, int16_t* out) {
  for (size_t n = 0; n < count; ++n) {
    const int16_t* at = in + n;
    out[n] =
        RoundTaps(taps.near * (at[0] + at[step]) + taps.far * (at[-step] + at[2 * step]), range);
  }
}

}  // namespace starfocus::simd::reference
