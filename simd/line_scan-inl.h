// SPDX-License-Identifier: Apache-2.0
// Vector code of the functions in line_scan.h. This file is included once per SIMD target.
#include <cstring>

#include "simd/highway-inl.h"
#include "simd/line_scan.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

// Splits adjacent lines into runs, one line in each lane of a vector.
template <class D16>
HWY_INLINE void FindRunsOfVector(D16 d16, const int16_t* HWY_RESTRICT disparity, ptrdiff_t step,
                                 size_t length, int16_t spread_limit, int16_t edge_limit,
                                 const RunMarks& marks) {
  uint16_t *HWY_RESTRICT starts = marks.starts, *HWY_RESTRICT edges = marks.edges;
  int16_t* HWY_RESTRICT middles = marks.middles;
  const size_t stride = marks.stride;
  const hn::RebindToUnsigned<D16> du16;
  const auto spread = hn::Set(d16, spread_limit), edge = hn::Set(d16, edge_limit);
  const auto last_bit = hn::Set(du16, uint16_t{0x8000});
  auto before = hn::LoadU(d16, disparity);
  auto low = before, high = before;
  auto start_bits = hn::Zero(du16), edge_bits = hn::Zero(du16);
  for (size_t q = 0; q < length; ++q, disparity += step, middles += stride) {
    const auto here = hn::LoadU(d16, disparity);
    const auto wide_low = hn::Min(low, here), wide_high = hn::Max(high, here);
    // Differences saturate, so that ranges wider than 16 bits are also detected.
    const auto start = hn::Gt(hn::SaturatedSub(wide_high, wide_low), spread);
    low = hn::IfThenElse(start, here, wide_low);
    high = hn::IfThenElse(start, here, wide_high);
    hn::StoreU(hn::Add(low, hn::ShiftRight<1>(hn::Sub(high, low))), d16, middles);
    const auto rise = hn::SaturatedSub(hn::Max(before, here), hn::Min(before, here));
    const auto at_edge = hn::Gt(rise, edge);
    before = here;
    const auto bit = [&](auto mask) HWY_ATTR {
      return hn::And(hn::BitCast(du16, hn::VecFromMask(d16, mask)), last_bit);
    };
    start_bits = hn::Or(hn::ShiftRight<1>(start_bits), bit(start));
    edge_bits = hn::Or(hn::ShiftRight<1>(edge_bits), bit(at_edge));
    if (q % 16 == 15) {
      hn::StoreU(start_bits, du16, starts);
      hn::StoreU(edge_bits, du16, edges);
      starts += stride;
      edges += stride;
    }
  }
  if (length % 16 != 0) {
    const int missing = static_cast<int>(16 - length % 16);
    hn::StoreU(hn::ShiftRightSame(start_bits, missing), du16, starts);
    hn::StoreU(hn::ShiftRightSame(edge_bits, missing), du16, edges);
  }
}

inline void FindRuns(const int16_t* disparity, ptrdiff_t step, size_t length, size_t lines,
                     int16_t spread, int16_t edge, const RunMarks& marks) {
  const hn::CappedTag<int16_t, kRunLanes> d16;
  for (size_t line = 0; line < lines; line += hn::Lanes(d16)) {
    RunMarks of_vector = marks;
    of_vector.starts += line;
    of_vector.edges += line;
    of_vector.middles += line;
    FindRunsOfVector(d16, disparity + line, step, length, spread, edge, of_vector);
  }
}

HWY_INLINE void BlendSpan(const Span& span, int16_t* HWY_RESTRICT line) {
  const hn::ScalableTag<int16_t> d16;
  const auto weight =
      hn::Set(d16, static_cast<int16_t>(span.neighbour_weight << (15 - kBlendBits)));
  const int16_t* HWY_RESTRICT source = span.source;
  const int16_t* HWY_RESTRICT neighbour = source + span.neighbour_offset;
  int16_t* HWY_RESTRICT target = line + span.target;
  const auto blended = [&](size_t n) HWY_ATTR {
    const auto value = hn::LoadU(d16, source + n);
    const auto more = hn::Sub(hn::LoadU(d16, neighbour + n), value);
    return hn::Add(value, hn::MulFixedPoint15(more, weight));
  };
  const bool done = ForVectors(span.samples, hn::Lanes(d16),
                               [&](size_t n) HWY_ATTR { hn::StoreU(blended(n), d16, target + n); });
  if (done) return;
  // Processes a span that is shorter than a vector, as most spans of line scans are. For spans
  // shorter than a vector, the reference would be slower than vector code.
  int16_t whole[HWY_MAX_BYTES / sizeof(int16_t)];
  hn::StoreU(blended(0), d16, whole);
  std::memcpy(target, whole, span.samples * sizeof(*target));
}

inline void Blend(const Span* HWY_RESTRICT spans, size_t count, int16_t* HWY_RESTRICT line) {
  for (size_t i = 0; i < count; ++i) {
    if (spans[i].neighbour_weight == 0) {
      std::memcpy(line + spans[i].target, spans[i].source, spans[i].samples * sizeof(*line));
    } else {
      BlendSpan(spans[i], line);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();
