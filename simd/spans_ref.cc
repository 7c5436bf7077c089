// SPDX-License-Identifier: Apache-2.0
#include "simd/samples.h"
#include "simd/spans.h"

namespace starfocus::simd::reference {
namespace {

// SourceOf returns sample n of the source, and NeighbourOf the neighbour of sample n.
int32_t SourceOf(const Span& span, uint32_t n) { return span.source[n]; }
int32_t NeighbourOf(const Span& span, uint32_t n) {
  return span.source[static_cast<ptrdiff_t>(n) + span.neighbour_offset];
}

uint32_t SpanValue(const Span& span, uint32_t n) {
  uint32_t value = uint32_t{span.weight} * static_cast<uint32_t>(SourceOf(span, n));
  if (span.neighbour_weight != 0) {
    value += uint32_t{span.neighbour_weight} * static_cast<uint32_t>(NeighbourOf(span, n));
  }
  return value;
}

int16_t BlendValue(const Span& span, uint32_t n) {
  const int32_t value = SourceOf(span, n);
  if (span.neighbour_weight == 0) return static_cast<int16_t>(value);
  const int32_t weight = span.neighbour_weight << (15 - kBlendBits);
  return static_cast<int16_t>(value + Product15(NeighbourOf(span, n) - value, weight));
}

}  // namespace

void Accumulate(const Span* spans, size_t count, uint32_t* accumulators) {
  for (size_t i = 0; i < count; ++i) {
    for (uint32_t n = 0; n < spans[i].samples; ++n) {
      accumulators[spans[i].target + n] += SpanValue(spans[i], n);
    }
  }
}

void Blend(const Span* spans, size_t count, int16_t* line) {
  for (size_t i = 0; i < count; ++i) {
    for (uint32_t n = 0; n < spans[i].samples; ++n) {
      line[spans[i].target + n] = BlendValue(spans[i], n);
    }
  }
}

}  // namespace starfocus::simd::reference
