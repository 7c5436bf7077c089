// SPDX-License-Identifier: Apache-2.0
// SIMD kernels that downsample pictures by two into layers, and that upsample layers to full size.
#ifndef STARFOCUS_SIMD_RESAMPLE_H_
#define STARFOCUS_SIMD_RESAMPLE_H_

#include <cstddef>
#include <cstdint>

#include "simd/light.h"
#include "simd/samples.h"

namespace starfocus::simd {

// Samples of layers have kLayerBits fractional bits. The valid range is [0, kLayerWhite]. Filtered
// samples may lie outside the valid range by less than a fifth of white on either side.
inline constexpr int kLayerBits = kLightBits - 1;
inline constexpr int16_t kLayerWhite = 255 << kLayerBits;

// Taps of a symmetric half-band filter with kTapBits fractional bits. The seven taps are far, 0,
// near, centre, near, 0, far. Taps lie in [-2^kTapBits, 2^kTapBits], and sums of products fit in 32
// bits.
inline constexpr int kTapBits = 14;
struct HalfBand {
  int32_t centre, near, far;
};

// A rectangle of `rows` rows of `count` samples. Rows are `stride` samples apart.
struct SampleRows {
  const int16_t* samples;
  size_t stride, rows, count;
};

namespace reference {

inline int16_t RoundTaps(int32_t sum, int16_t low, int16_t high) {
  const int32_t value = (sum + (1 << (kTapBits - 1))) >> kTapBits;
  return static_cast<int16_t>(value < low ? low : value > high ? high : value);
}

// Splits a line of codes into samples of even and odd pixels, for n < pairs. Sample even[3 n + c]
// is the light of in[6 n + c], and odd[3 n + c] is the light of in[6 n + 3 + c], both rounded half
// up to samples. Nothing past the end of `in` is read, and nothing past the end of `even` and `odd`
// is written.
STARFOCUS_REFERENCE void WidenPhases(const uint8_t* in, size_t pairs, const Encoding& encoding,
                                     int16_t* even, int16_t* odd) {
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

// Splits a line of samples into the samples of even and odd pixels, like WidenPhases without the
// conversion. One sample past the end of `even` and of `odd` may be written.
STARFOCUS_REFERENCE void DeinterleavePhases(const int16_t* in, size_t pairs, int16_t* even,
                                            int16_t* odd) {
  for (size_t n = 0; n < pairs; ++n) {
    for (size_t c = 0; c < 3; ++c) {
      even[3 * n + c] = in[6 * n + c];
      odd[3 * n + c] = in[6 * n + 3 + c];
    }
  }
}

// Sets out[n] to the code of the sample in[n], which must be in the valid range. If light is the
// code itself, the sample is rounded half to even.
STARFOCUS_REFERENCE void Narrow(const int16_t* in, size_t count, const Encoding& encoding,
                                uint8_t* out) {
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

// Converts accumulators to samples: out[n] = (accumulators[n] + 2^(shift - 7)) >> (shift - 6).
// `shift` is in [7, 24]. Results must be in the valid range.
STARFOCUS_REFERENCE void FinishLayer(const uint32_t* accumulators, size_t count, int shift,
                                     int16_t* out) {
  const uint32_t half = uint32_t{1} << (shift - kLayerBits - 1);
  for (size_t n = 0; n < count; ++n) {
    out[n] = static_cast<int16_t>((accumulators[n] + half) >> (shift - kLayerBits));
  }
}

// Filters samples that are `step` apart. Output out[n] is
//   centre in[n] + near (in[n - step] + in[n + step]) + far (in[n - 3 step] + in[n + 3 step]),
// rounded half up to a sample and clamped to [low, high].
STARFOCUS_REFERENCE void FilterHalfBand(const int16_t* in, ptrdiff_t step, const HalfBand& taps,
                                        size_t count, int16_t low, int16_t high, int16_t* out) {
  for (size_t n = 0; n < count; ++n) {
    const int16_t* at = in + n;
    out[n] = RoundTaps(taps.centre * at[0] + taps.near * (at[-step] + at[step]) +
                           taps.far * (at[-3 * step] + at[3 * step]),
                       low, high);
  }
}

// Filters a line and keeps the even pixels. `even` and `odd` are the output of DeinterleavePhases.
// Output out[n] is
//   centre even[n] + near (odd[n - 3] + odd[n]) + far (odd[n - 6] + odd[n + 3]),
// rounded half up to a sample and saturated to 16 bits. Input samples must be in the valid range.
STARFOCUS_REFERENCE void Halve(const int16_t* even, const int16_t* odd, const HalfBand& taps,
                               size_t count, int16_t* out) {
  for (size_t n = 0; n < count; ++n) {
    const int16_t* at = odd + n;
    out[n] = RoundTaps(
        taps.centre * even[n] + taps.near * (at[-3] + at[0]) + taps.far * (at[-6] + at[3]),
        INT16_MIN, INT16_MAX);
  }
}

// Interpolates the samples halfway between in[n] and in[n + step]. out[n] is
//   near (in[n] + in[n + step]) + far (in[n - step] + in[n + 2 step]),
// rounded half up to a sample and clamped to [low, high].
STARFOCUS_REFERENCE void Between(const int16_t* in, ptrdiff_t step, const HalfBand& taps,
                                 size_t count, int16_t low, int16_t high, int16_t* out) {
  for (size_t n = 0; n < count; ++n) {
    const int16_t* at = in + n;
    out[n] = RoundTaps(taps.near * (at[0] + at[step]) + taps.far * (at[-step] + at[2 * step]), low,
                       high);
  }
}

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_RESAMPLE_H_
