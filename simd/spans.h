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
  const uint8_t* source;
  uint32_t target;            // the first sample in the target line
  uint32_t samples;           // > 0
  uint16_t weight;            // [0, 32767]
  uint16_t neighbour_weight;  // [0, 32767]; with 0 the neighbour counts for nothing
  int32_t neighbour_offset;   // in samples: whole pixels, mostly +3 or -3
};

namespace reference {

// Adds value n of each span to accumulators[target + n]. No sum exceeds 2^32 - 1.
void Accumulate(const Span* spans, size_t count, uint32_t* accumulators);

// Stores value n of each span, divided by 256, in line[target + n]. The weights of a span sum to
// 256. Halves are rounded to the even neighbour: rounding them up would brighten pictures that are
// shifted by half pixels by 1/4 gray level. Sources don't overlap the line, and nothing outside the
// spans is written.
void Blend(const Span* spans, size_t count, uint8_t* line);

// Makes bytes of accumulators: out[n] = (accumulators[n] + 2^(shift - 1)) >> shift. `shift` lies in
// [1, 24], and results fit a byte. Nothing past out[count - 1] is written.
void Finish(const uint32_t* accumulators, size_t count, int shift, uint8_t* out);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_SPANS_H_
