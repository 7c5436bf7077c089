// SPDX-License-Identifier: Apache-2.0
// Buffer of spans for a SIMD kernel, so that one call processes many views of a line.
#ifndef STARFOCUS_LIB_GATHER_SPAN_LIST_H_
#define STARFOCUS_LIB_GATHER_SPAN_LIST_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/arena.h"
#include "simd/kernels.h"

namespace starfocus {

// Memory of a span list, and of the hole colours that the spans point to.
struct SpanMemory {
  simd::Span* spans;
  size_t span_capacity;
  int16_t* pixels;
  size_t pixel_capacity;  // capacity of `pixels` in samples, at least one line
};

// Allocates the memory for lines of up to `side` pixels.
inline SpanMemory TakeSpans(size_t side, Arena* arena) {
  SpanMemory memory;
  memory.span_capacity = 512;
  memory.spans = arena->Take<simd::Span>(memory.span_capacity);
  memory.pixel_capacity = 3 * 2 * side;
  memory.pixels = arena->Take<int16_t>(memory.pixel_capacity);
  return memory;
}

class SpanList {
 public:
  // Creates a list that adds spans to accumulators.
  SpanList(const simd::Kernels& kernels, const SpanMemory& memory, uint32_t* accumulators)
      : kernels_(kernels), memory_(memory), accumulators_(accumulators), line_(nullptr) {}
  // Creates a list that blends spans into a line.
  SpanList(const simd::Kernels& kernels, const SpanMemory& memory, int16_t* line)
      : kernels_(kernels), memory_(memory), accumulators_(nullptr), line_(line) {}

  // Returns the next span, which the caller must fill in.
  simd::Span* Next() {
    if (count_ == memory_.span_capacity) Flush();
    return memory_.spans + count_++;
  }
  void Add(const simd::Span& span) { *Next() = span; }

  // Returns memory for the colours of one span of a hole. The next span that the caller adds must
  // be the span of the hole. `samples` is at most pixel_capacity.
  int16_t* Pixels(size_t samples) {
    if (used_ + samples > memory_.pixel_capacity || count_ == memory_.span_capacity) Flush();
    int16_t* pixels = memory_.pixels + used_;
    used_ += samples;
    return pixels;
  }

  void Flush() {
    if (count_ != 0) {
      if (accumulators_ != nullptr) {
        kernels_.Accumulate(memory_.spans, count_, accumulators_);
      } else {
        kernels_.Blend(memory_.spans, count_, line_);
      }
    }
    count_ = 0;
    used_ = 0;
  }

 private:
  const simd::Kernels& kernels_;
  const SpanMemory memory_;
  uint32_t* const accumulators_;
  int16_t* const line_;
  size_t count_ = 0;
  size_t used_ = 0;
};

}  // namespace starfocus

#endif  // STARFOCUS_LIB_GATHER_SPAN_LIST_H_
