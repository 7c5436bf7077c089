// SPDX-License-Identifier: Apache-2.0
// Kernels that move stretches of a picture by a part of a pixel: they weigh two samples of the
// source and add or store the result.
#ifndef STARFOCUS_SIMD_SPANS_H_
#define STARFOCUS_SIMD_SPANS_H_

#include <cstddef>
#include <cstdint>

namespace starfocus::simd {

// A stretch of samples (R, G, B interleaved) that one source surface gives to a line. Sample n of
// it has the value weight * source[n] + neighbour_weight * source[n + neighbour_offset].
struct Span {
  const int16_t* source;      // light (light.h)
  uint32_t target;            // the first sample in the target line
  uint32_t samples;           // > 0
  uint16_t weight;            // [0, 32767]
  uint16_t neighbour_weight;  // [0, 32767]; with 0 the neighbour counts for nothing
  int32_t neighbour_offset;   // in samples: whole pixels, mostly +3 or -3
};

// Fractional bits of the weights that Blend takes.
inline constexpr int kBlendBits = 14;

namespace reference {

// Adds value n of each span to accumulators[target + n]. No sum exceeds 2^32 - 1.
void Accumulate(const Span* spans, size_t count, uint32_t* accumulators);

// Stores what each span shows in line[target + n]: of source[n] and source[n + neighbour_offset],
// each by its weight. The weights of a span sum to 2^kBlendBits, the neighbour's being half of that
// at most, and the difference that the neighbour makes is rounded halves up. Sources don't overlap
// the line, and nothing outside the spans is written.
void Blend(const Span* spans, size_t count, int16_t* line);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_SPANS_H_
