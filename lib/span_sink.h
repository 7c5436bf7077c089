// Turns what a line scan finds into spans for the kernels.
#ifndef STARFOCUS_LIB_SPAN_SINK_H_
#define STARFOCUS_LIB_SPAN_SINK_H_

#include <cstdint>
#include <cstring>

#include "lib/line_scan.h"
#include "lib/span_list.h"

namespace starfocus {

// A sink of LineScan. holes.Fill(begin, end, disparity, colour, out) writes the colours of rendered
// pixels [begin, end), behind which a surface of `disparity` and `colour` goes on.
template <class Holes>
class SpanSink {
 public:
  // Each pixel gets `weight`: 256 when the list blends. disparity_out, when not null, receives the
  // rendered view's disparity from out_begin on.
  SpanSink(const Line& line, int32_t out_begin, uint32_t weight, const Holes& holes,
           int16_t* disparity_out, SpanList* list)
      : line_(line),
        out_begin_(out_begin),
        weight_(weight),
        holes_(holes),
        disparity_out_(disparity_out),
        list_(list) {}

  void Surface(int32_t begin, int32_t end, int32_t source, int32_t neighbour, int32_t weight) {
    const uint32_t neighbour_weight =
        (weight_ * static_cast<uint32_t>(weight) + kShiftOne / 2) >> kShiftBits;
    Add(begin, end, line_.rgb + 3 * static_cast<ptrdiff_t>(source), neighbour_weight,
        3 * neighbour);
    if (disparity_out_ == nullptr) return;
    std::memcpy(disparity_out_ + (begin - out_begin_), line_.disparity + source,
                sizeof(int16_t) * static_cast<size_t>(end - begin));
  }

  void Hole(int32_t begin, int32_t end, int32_t disparity, int32_t pixel) {
    uint8_t* pixels = list_->Pixels(3 * static_cast<size_t>(end - begin));
    holes_.Fill(begin, end, disparity, line_.rgb + 3 * static_cast<ptrdiff_t>(pixel), pixels);
    Add(begin, end, pixels, 0, 0);
    if (disparity_out_ == nullptr) return;
    for (int32_t p = begin; p < end; ++p) {
      disparity_out_[p - out_begin_] = static_cast<int16_t>(disparity);
    }
  }

 private:
  void Add(int32_t begin, int32_t end, const uint8_t* source, uint32_t neighbour_weight,
           int32_t neighbour_offset) {
    simd::Span span;
    span.source = source;
    span.target = 3 * static_cast<uint32_t>(begin - out_begin_);
    span.samples = 3 * static_cast<uint32_t>(end - begin);
    span.weight = static_cast<uint16_t>(weight_ - neighbour_weight);
    span.neighbour_weight = static_cast<uint16_t>(neighbour_weight);
    span.neighbour_offset = neighbour_offset;
    list_->Add(span);
  }

  const Line& line_;
  int32_t out_begin_;
  uint32_t weight_;
  const Holes& holes_;
  int16_t* disparity_out_;
  SpanList* list_;
};

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SPAN_SINK_H_
