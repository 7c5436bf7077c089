// Spans waiting for a kernel, so that one call serves many views of a line.
#ifndef STARFOCUS_LIB_SPAN_LIST_H_
#define STARFOCUS_LIB_SPAN_LIST_H_

#include <cstddef>
#include <cstdint>

#include "simd/kernels.h"

namespace starfocus {

// Memory of a list, and of the hole colours its spans point at.
struct SpanMemory {
  simd::Span* spans;
  size_t span_capacity;
  uint8_t* pixels;
  size_t pixel_capacity;  // bytes; at least one line
};

class SpanList {
 public:
  // Spans are accumulated.
  SpanList(const simd::Kernels& kernels, const SpanMemory& memory, uint32_t* accumulators)
      : kernels_(kernels), memory_(memory), accumulators_(accumulators), line_(nullptr) {}
  // Spans are blended into a line.
  SpanList(const simd::Kernels& kernels, const SpanMemory& memory, uint8_t* line)
      : kernels_(kernels), memory_(memory), accumulators_(nullptr), line_(line) {}

  void Add(const simd::Span& span) {
    if (count_ == memory_.span_capacity) Flush();
    memory_.spans[count_++] = span;
  }

  // Room for the colours of one span of a hole, which the caller adds next; bytes <=
  // pixel_capacity.
  uint8_t* Pixels(size_t bytes) {
    if (used_ + bytes > memory_.pixel_capacity || count_ == memory_.span_capacity) Flush();
    uint8_t* pixels = memory_.pixels + used_;
    used_ += bytes;
    return pixels;
  }

  void Flush() {
    if (count_ != 0) {
      if (accumulators_ != nullptr) {
        kernels_.accumulate(memory_.spans, count_, accumulators_);
      } else {
        kernels_.blend(memory_.spans, count_, line_);
      }
    }
    count_ = 0;
    used_ = 0;
  }

 private:
  const simd::Kernels& kernels_;
  const SpanMemory& memory_;
  uint32_t* accumulators_;
  uint8_t* line_;
  size_t count_ = 0;
  size_t used_ = 0;
};

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SPAN_LIST_H_
