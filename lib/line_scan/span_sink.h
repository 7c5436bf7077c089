// SPDX-License-Identifier: Apache-2.0
// Converts the results of a line scan to spans for the SIMD kernels, and fills holes.
#ifndef STARFOCUS_LIB_LINE_SCAN_SPAN_SINK_H_
#define STARFOCUS_LIB_LINE_SCAN_SPAN_SINK_H_

#include <cstdint>
#include <cstring>

#include "lib/io/input.h"
#include "lib/line_scan/line_scan.h"
#include "lib/optics/view_grid.h"

namespace starfocus {

// Fills the holes of a line of a rendered view: reads colours that the centre view does not show
// from a captured side view. All members are in the orientation of the view's lines.
struct HoleFiller {
  const Input& input;
  int layer;
  const ViewGrid& grid;
  const int64_t* moves;  // ViewGrid::Move of views 0 to N along an axis
  bool transposed;       // true: lines run down the picture
  // The rendered view is (u * i, v * j), and the captured view (u, v) fills its holes. The
  // coordinates u and v are -1, 0 or 1. Their unit is the distance of the outermost views from the
  // centre, or half of this distance if i and j are at most half_views (HalfViews).
  int u, v;
  int32_t half_views;
  int32_t i, j;
  // Position of pixel 0 of the line in the picture, and distance between neighbouring pixels.
  int32_t x, y, dx, dy;

  // Writes the colours (3 samples each) of the rendered pixels [begin, end). The pixels show a
  // background of disparity `disparity`. The captured view is read at the position that the
  // disparity implies (IV-A). If the light field has 5 views, a diagonal view is interpolated from
  // its horizontal and its vertical neighbour. Each neighbour is weighted by its similarity to the
  // visible background `colour`. With only the centre view, the background colour is repeated.
  void Fill(int32_t begin, int32_t end, int32_t disparity, const int16_t* colour,
            int16_t* out) const;
};

// Buffer of spans for a SIMD kernel, so that one call processes many views of a line.
class SpanList {
 public:
  // Creates a list that adds spans to accumulators.
  SpanList(const simd::Kernels& kernels, const LineScanScratch& scratch, uint32_t* accumulators)
      : kernels_(&kernels), scratch_(scratch), spans_(scratch.spans), accumulators_(accumulators) {}
  // Creates a list that blends spans into a line.
  SpanList(const LineScanScratch& scratch, int16_t* line)
      : scratch_(scratch), spans_(scratch.spans), line_(line) {}

  // Returns the next span, which the caller must fill in.
  simd::Span* Next() {
    if (count_ == kSpanCapacity) Flush();
    return spans_ + count_++;
  }
  void Add(const simd::Span& span) { *Next() = span; }

  // Returns memory for the colours of one span of a hole. The next span that the caller adds must
  // be the span of the hole. `samples` is at most pixel_capacity.
  int16_t* Pixels(size_t samples) {
    if (used_ + samples > scratch_.hole_samples || count_ == kSpanCapacity) Flush();
    int16_t* pixels = scratch_.holes + used_;
    used_ += samples;
    return pixels;
  }

  void Flush() {
    if (count_ != 0) {
      if (accumulators_ != nullptr) {
        kernels_->Accumulate(spans_, count_, accumulators_);
      } else {
        scratch_.kernels->Blend(spans_, count_, line_);
      }
    }
    count_ = 0;
    used_ = 0;
  }

 private:
  const simd::Kernels* const kernels_ = nullptr;  // only to accumulate
  const LineScanScratch& scratch_;
  simd::Span* const spans_;
  uint32_t* const accumulators_ = nullptr;
  int16_t* const line_ = nullptr;
  size_t count_ = 0;
  size_t used_ = 0;
};

// Sink of LineScan. The sink calls holes.Fill(begin, end, disparity, colour, out) to write the
// colours of the rendered pixels [begin, end). The pixels of a hole show a surface of disparity
// `disparity`, whose visible part has the colour `colour`.
template <class Holes>
class SpanSink {
 public:
  // Rendered pixel `first` of the line is written to target pixel `pixel`. `weight` is the weight
  // of each rendered pixel; 2^simd::kBlendBits if the list blends. `disparity` receives the
  // disparities of the rendered view from `first` on; it may be null, and requires that line.step
  // is 1.
  SpanSink(const Line& line, int32_t first, uint32_t pixel, uint32_t weight, int16_t* disparity,
           const Holes& holes, SpanList* list)
      : line_(line),
        first_(first),
        pixel_(pixel),
        weight_(weight),
        disparity_(disparity),
        holes_(holes),
        list_(list) {}

  // Sets the weight of subsequent pixels.
  void SetWeight(uint32_t weight) { weight_ = weight; }

  void Surface(int32_t begin, int32_t end, int32_t source, int32_t neighbour, int32_t weight) {
    constexpr uint32_t kHalf = 1 << (simd::kBlendBits - 1);
    const uint32_t neighbour_weight =
        (weight_ * static_cast<uint32_t>(weight) + kHalf) >> simd::kBlendBits;
    Add(begin, end, line_.rgb + 3 * static_cast<ptrdiff_t>(source), neighbour_weight,
        3 * neighbour);
    if (disparity_ == nullptr) return;
    CopyDisparities(line_.disparity + source, end - begin, disparity_ + (begin - first_));
  }

  void Mix(int32_t p, int32_t source, int32_t other, int32_t weight) {
    const uint32_t other_weight =
        (weight_ * static_cast<uint32_t>(weight) + kShiftOne / 2) >> kShiftBits;
    Add(p, p + 1, line_.rgb + 3 * static_cast<ptrdiff_t>(source), other_weight,
        3 * (other - source));
    if (disparity_ != nullptr) {
      disparity_[p - first_] = line_.disparity[source];
    }
  }

  void Hole(int32_t begin, int32_t end, int32_t pixel, int32_t rim, int32_t covered) {
    int16_t* pixels = list_->Pixels(3 * static_cast<size_t>(end - begin));
    const int16_t disparity = line_.disparity[pixel * line_.step];
    holes_.Fill(begin, end, disparity, line_.rgb + 3 * static_cast<ptrdiff_t>(pixel), pixels);
    const int32_t rim_at = rim < pixel ? begin : end - 1;
    if (rim >= 0) {
      const int16_t* colour = line_.rgb + 3 * static_cast<ptrdiff_t>(rim);
      int16_t* out = pixels + 3 * (rim_at - begin);
      for (int c = 0; c < 3; ++c) {
        out[c] = static_cast<int16_t>(
            (out[c] * (kShiftOne - covered) + colour[c] * covered + kShiftOne / 2) >> kShiftBits);
      }
    }
    Add(begin, end, pixels, 0, 0);
    if (disparity_ == nullptr) return;
    for (int32_t p = begin; p < end; ++p) disparity_[p - first_] = disparity;
    if (rim >= 0 && covered > kShiftOne / 2) {
      disparity_[rim_at - first_] = line_.disparity[rim];
    }
  }

 private:
  // Copies four values per move without memcpy: most copies are short, and a call of memcpy takes
  // as long as several moves.
  static void CopyDisparities(const int16_t* from, int32_t count, int16_t* to) {
    constexpr int32_t kAtOnce = 4;
    constexpr size_t kBytes = kAtOnce * sizeof(int16_t);
    if (count < kAtOnce) {
      for (int32_t k = 0; k < count; ++k) to[k] = from[k];
      return;
    }
    for (int32_t k = 0; k + kAtOnce < count; k += kAtOnce) std::memcpy(to + k, from + k, kBytes);
    std::memcpy(to + count - kAtOnce, from + count - kAtOnce, kBytes);
  }

  void Add(int32_t begin, int32_t end, const int16_t* source, uint32_t neighbour_weight,
           int32_t neighbour_offset) {
    simd::Span* span = list_->Next();
    span->source = source;
    span->target = 3 * (pixel_ + static_cast<uint32_t>(begin - first_));
    span->samples = 3 * static_cast<uint32_t>(end - begin);
    span->weight = static_cast<uint16_t>(weight_ - neighbour_weight);
    span->neighbour_weight = static_cast<uint16_t>(neighbour_weight);
    span->neighbour_offset = neighbour_offset;
  }

  const Line& line_;
  const int32_t first_;
  const uint32_t pixel_;
  uint32_t weight_;
  int16_t* const disparity_;
  const Holes& holes_;
  SpanList* list_;
};

}  // namespace starfocus

#endif  // STARFOCUS_LIB_LINE_SCAN_SPAN_SINK_H_
