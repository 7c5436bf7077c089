// SPDX-License-Identifier: Apache-2.0
#include "simd/spans.h"

namespace starfocus::simd::reference {
namespace {

uint32_t SpanValue(const Span& span, uint32_t n) {
  uint32_t value = uint32_t{span.weight} * span.source[n];
  if (span.neighbour_weight != 0) {
    value += uint32_t{span.neighbour_weight} *
             span.source[static_cast<ptrdiff_t>(n) + span.neighbour_offset];
  }
  return value;
}

// Returns value / 256, rounded halves to the even neighbour.
uint8_t RoundBlend(uint32_t value) {
  return static_cast<uint8_t>((value + 127 + ((value >> 8) & 1)) >> 8);
}

}  // namespace

void Accumulate(const Span* spans, size_t count, uint32_t* accumulators) {
  for (size_t i = 0; i < count; ++i) {
    for (uint32_t n = 0; n < spans[i].samples; ++n) {
      accumulators[spans[i].target + n] += SpanValue(spans[i], n);
    }
  }
}

void Blend(const Span* spans, size_t count, uint8_t* line) {
  for (size_t i = 0; i < count; ++i) {
    for (uint32_t n = 0; n < spans[i].samples; ++n) {
      line[spans[i].target + n] = RoundBlend(SpanValue(spans[i], n));
    }
  }
}

void Finish(const uint32_t* accumulators, size_t count, int shift, uint8_t* out) {
  const uint32_t half = uint32_t{1} << (shift - 1);
  for (size_t n = 0; n < count; ++n) {
    out[n] = static_cast<uint8_t>((accumulators[n] + half) >> shift);
  }
}

}  // namespace starfocus::simd::reference
