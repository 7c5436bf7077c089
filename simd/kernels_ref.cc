// What each kernel computes, in plain C++: the truth the SIMD targets are tested against.
#include <cmath>
#include <cstring>

#include "simd/kernels.h"

namespace starfocus::simd {
namespace {

uint32_t SpanValue(const Span& span, uint32_t n) {
  uint32_t value = uint32_t{span.weight} * span.source[n];
  if (span.neighbour_weight != 0) {
    value += uint32_t{span.neighbour_weight} *
             span.source[static_cast<ptrdiff_t>(n) + span.neighbour_offset];
  }
  return value;
}

void Accumulate(const Span* spans, size_t count, uint32_t* accumulators) {
  for (size_t i = 0; i < count; ++i) {
    for (uint32_t n = 0; n < spans[i].samples; ++n) {
      accumulators[spans[i].target + n] += SpanValue(spans[i], n);
    }
  }
}

// value / 256, halves to the even neighbour.
uint8_t RoundBlend(uint32_t value) {
  return static_cast<uint8_t>((value + 127 + ((value >> 8) & 1)) >> 8);
}

void Blend(const Span* spans, size_t count, uint8_t* line) {
  for (size_t i = 0; i < count; ++i) {
    for (uint32_t n = 0; n < spans[i].samples; ++n) {
      line[spans[i].target + n] = RoundBlend(SpanValue(spans[i], n));
    }
  }
}

void Spread(const uint8_t* in, const SpreadTaps& taps, size_t count, uint8_t* out) {
  for (size_t n = 0; n < count; ++n) {
    const uint8_t* at = in + n;
    uint32_t sum = uint32_t{taps.centre} * at[0];
    for (ptrdiff_t k = 1; k <= taps.reach; ++k) {
      const uint32_t tap = k < taps.reach ? taps.inner : taps.outer;
      sum += tap * (uint32_t{at[-3 * k]} + at[3 * k]);
    }
    out[n] = RoundBlend(sum);
  }
}

void Finish(const uint32_t* accumulators, size_t count, int shift, uint8_t* out) {
  const uint32_t half = uint32_t{1} << (shift - 1);
  for (size_t n = 0; n < count; ++n) {
    out[n] = static_cast<uint8_t>((accumulators[n] + half) >> shift);
  }
}

bool ConvertDisparity(const float* disparity, size_t count, float low, float high, int16_t* out) {
  bool inside = true;
  for (size_t n = 0; n < count; ++n) {
    inside = inside && disparity[n] >= low && disparity[n] <= high;
    if (!inside) return false;
    out[n] = static_cast<int16_t>(std::floor(disparity[n] * 64.0f + 0.5f));
  }
  return inside;
}

void Widen(const uint8_t* in, size_t count, int16_t* out) {
  for (size_t n = 0; n < count; ++n) out[n] = static_cast<int16_t>(in[n] << kLayerBits);
}

void Narrow(const int16_t* in, size_t count, uint8_t* out) {
  for (size_t n = 0; n < count; ++n) {
    const int odd = (in[n] >> kLayerBits) & 1;
    const int value = (in[n] + (1 << (kLayerBits - 1)) - 1 + odd) >> kLayerBits;
    out[n] = static_cast<uint8_t>(value < 0 ? 0 : value > 255 ? 255 : value);
  }
}

void FinishLayer(const uint32_t* accumulators, size_t count, int shift, int16_t* out) {
  const uint32_t half = uint32_t{1} << (shift - kLayerBits - 1);
  for (size_t n = 0; n < count; ++n) {
    out[n] = static_cast<int16_t>((accumulators[n] + half) >> (shift - kLayerBits));
  }
}

int16_t RoundTaps(int32_t sum, int16_t low, int16_t high) {
  const int32_t value = (sum + (1 << (kTapBits - 1))) >> kTapBits;
  return static_cast<int16_t>(value < low ? low : value > high ? high : value);
}

void FilterHalfBand(const int16_t* in, ptrdiff_t step, const HalfBand& taps, size_t count,
                    int16_t low, int16_t high, int16_t* out) {
  for (size_t n = 0; n < count; ++n) {
    const int16_t* at = in + n;
    out[n] = RoundTaps(taps.centre * at[0] + taps.near * (at[-step] + at[step]) +
                           taps.far * (at[-3 * step] + at[3 * step]),
                       low, high);
  }
}

void Between(const int16_t* in, ptrdiff_t step, const HalfBand& taps, size_t count, int16_t low,
             int16_t high, int16_t* out) {
  for (size_t n = 0; n < count; ++n) {
    const int16_t* at = in + n;
    out[n] = RoundTaps(taps.near * (at[0] + at[step]) + taps.far * (at[-step] + at[2 * step]), low,
                       high);
  }
}

}  // namespace

const Kernels& ReferenceKernels() {
  static constexpr Kernels kernels = {"reference", Accumulate,       Blend,  Spread,
                                      Finish,      ConvertDisparity, Widen,  Narrow,
                                      FinishLayer, FilterHalfBand,   Between};
  return kernels;
}

}  // namespace starfocus::simd
