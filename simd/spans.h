// SPDX-License-Identifier: Apache-2.0
// SIMD kernels that move spans of samples by a fraction of a pixel. They weight two samples of the
// source, and add or store the result.
#ifndef STARFOCUS_SIMD_SPANS_H_
#define STARFOCUS_SIMD_SPANS_H_

#include <cstddef>
#include <cstdint>

namespace starfocus::simd {

// A span of samples (R, G, B interleaved) of one source surface for a line. The value of sample n
// is weight * source[n] + neighbour_weight * source[n + neighbour_offset].
struct Span {
  const int16_t* source;      // light (light.h)
  uint32_t target;            // first sample in the target line
  uint32_t samples;           // > 0
  uint16_t weight;            // [0, 32767]
  uint16_t neighbour_weight;  // [0, 32767]; 0: the neighbour is not used
  int32_t neighbour_offset;   // in samples: whole pixels, mostly +3 or -3
};

// Fractional bits of the weights of Blend.
inline constexpr int kBlendBits = 14;

namespace reference {

// Adds value n of each span to accumulators[target + n]. No sum exceeds 2^32 - 1.
void Accumulate(const Span* spans, size_t count, uint32_t* accumulators);

// Stores value n of each span in line[target + n]. The weights of a span sum to 2^kBlendBits, and
// the neighbour's is at most half of that. The difference that the neighbour makes is rounded
// halves up. Sources do not overlap the line, and nothing outside the spans is written.
void Blend(const Span* spans, size_t count, int16_t* line);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_SPANS_H_
