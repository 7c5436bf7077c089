// SPDX-License-Identifier: Apache-2.0
// SIMD kernel that moves spans of samples by a fraction of a pixel. The kernel computes weighted
// sums of two samples of the source, and adds the results.
#ifndef STARFOCUS_SIMD_SPANS_H_
#define STARFOCUS_SIMD_SPANS_H_

#include <cstddef>
#include <cstdint>

#include "simd/samples.h"

namespace starfocus::simd {

// A span of samples with interleaved R, G and B, which come from one source surface and go to one
// line. The value of sample n is weight * source[n] + neighbour_weight * source[n +
// neighbour_offset].
struct Span {
  const int16_t* source;  // Light of the source surface (light.h).
  uint32_t target;        // Index of the first sample in the target line.
  uint32_t samples;       // Number of samples, > 0.
  uint16_t weight;        // Weight of the sample itself, [0, 32767].
  uint16_t
      neighbour_weight;  // Weight of the neighbour, [0, 32767]; 0 if the neighbour is not used.
  // Distance in samples to the neighbour; a multiple of 3, mostly +3 or -3.
  int32_t neighbour_offset;
};

namespace reference {

// SourceOf returns sample n of the source, and NeighbourOf the neighbour of sample n.
inline int32_t SourceOf(const Span& span, uint32_t n) { return span.source[n]; }

inline int32_t NeighbourOf(const Span& span, uint32_t n) {
  return span.source[static_cast<ptrdiff_t>(n) + span.neighbour_offset];
}

inline uint32_t SpanValue(const Span& span, uint32_t n) {
  uint32_t value = uint32_t{span.weight} * static_cast<uint32_t>(SourceOf(span, n));
  if (span.neighbour_weight != 0) {
    value += uint32_t{span.neighbour_weight} * static_cast<uint32_t>(NeighbourOf(span, n));
  }
  return value;
}

// Adds value n of each span to accumulators[target + n]. Sums must not exceed 2^32 - 1.
STARFOCUS_REFERENCE void Accumulate(const Span* spans, size_t count, uint32_t* accumulators) {
  for (size_t i = 0; i < count; ++i) {
    for (uint32_t n = 0; n < spans[i].samples; ++n) {
      accumulators[spans[i].target + n] += SpanValue(spans[i], n);
    }
  }
}

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_SPANS_H_
