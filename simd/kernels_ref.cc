// What each kernel computes, in plain C++: the truth the SIMD targets are tested against.
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <initializer_list>

#include "simd/kernels.h"
#include "simd/slices_ref.h"

namespace starfocus::simd {
namespace {

uint32_t SpanValue(const Span& span, uint32_t n) {
  uint32_t value = uint32_t{span.weight} * span.source[n];
  if (span.neighbour_weight != 0) {
    value += uint32_t{span.neighbour_weight} *
             span.source[static_cast<ptrdiff_t>(n) + span.neighbour_offset];
  }
  return value;
}

void Accumulate(const Span* spans, size_t count, uint32_t* accumulators) {
  for (size_t i = 0; i < count; ++i) {
    for (uint32_t n = 0; n < spans[i].samples; ++n) {
      accumulators[spans[i].target + n] += SpanValue(spans[i], n);
    }
  }
}

// value / 256, halves to the even neighbour.
uint8_t RoundBlend(uint32_t value) {
  return static_cast<uint8_t>((value + 127 + ((value >> 8) & 1)) >> 8);
}

void Blend(const Span* spans, size_t count, uint8_t* line) {
  for (size_t i = 0; i < count; ++i) {
    for (uint32_t n = 0; n < spans[i].samples; ++n) {
      line[spans[i].target + n] = RoundBlend(SpanValue(spans[i], n));
    }
  }
}

uint32_t DiscWeight(const Disc& disc, int32_t x, int32_t y) {
  const int32_t a = std::abs(x), b = std::abs(y), high = a > b ? a : b, low = a > b ? b : a;
  return disc.weights[high * (high + 1) / 2 + low];
}

void FilterDisc(const uint8_t* in, size_t in_stride, const Disc& disc, size_t rows, size_t count,
                uint8_t* out, size_t out_stride) {
  for (size_t row = 0; row < rows; ++row, in += in_stride, out += out_stride) {
    for (size_t n = 0; n < count; ++n) {
      uint32_t sum = uint32_t{1} << disc.bits >> 1;
      for (int32_t y = -disc.size; y <= disc.size; ++y) {
        const uint8_t* at = in + n + y * static_cast<ptrdiff_t>(in_stride);
        for (int32_t x = -disc.size; x <= disc.size; ++x) sum += DiscWeight(disc, x, y) * at[3 * x];
      }
      out[n] = static_cast<uint8_t>(sum >> disc.bits);
    }
  }
}

void FindRunsOfLine(const int16_t* disparity, ptrdiff_t step, size_t length,
                    const RunLimits& limits, const RunMarks& marks) {
  int low = disparity[0], high = low, before = low;
  for (size_t q = 0; q < length; ++q, disparity += step) {
    const int here = *disparity;
    low = here < low ? here : low;
    high = here > high ? here : high;
    const bool start = high - low > limits.spread;
    if (start) low = high = here;
    const bool edge = std::abs(here - before) > limits.edge;
    before = here;
    const size_t word = q / 16 * marks.stride;
    if (q % 16 == 0) marks.starts[word] = marks.edges[word] = 0;
    marks.starts[word] = static_cast<uint16_t>(marks.starts[word] | (start ? 1 << q % 16 : 0));
    marks.edges[word] = static_cast<uint16_t>(marks.edges[word] | (edge ? 1 << q % 16 : 0));
    marks.middles[q * marks.stride] = static_cast<int16_t>((low + high) >> 1);
  }
}

void AddDisparity(int16_t disparity, int16_t* low, int16_t* high) {
  if (disparity < *low) *low = disparity;
  if (disparity > *high) *high = disparity;
}

void FindRanges(const int16_t* disparity, size_t stride, size_t rows, size_t count,
                DisparityRange* ranges) {
  for (size_t chunk = 0; chunk < count; chunk += kSliceLanes) {
    DisparityRange range = {INT16_MAX, INT16_MIN};
    for (size_t row = 0; row < rows; ++row) {
      for (size_t n = chunk; n < count && n < chunk + kSliceLanes; ++n) {
        const int16_t value = disparity[row * stride + n];
        if (value != INT16_MIN) AddDisparity(value, &range.low, &range.high);
      }
    }
    ranges[chunk / kSliceLanes] = range;
  }
}

void FindWithin(const int16_t* disparity, size_t stride, size_t rows, const DisparityRange& range,
                uint16_t* within) {
  for (size_t row = 0; row < rows; ++row, disparity += stride) {
    int bits = 0;
    for (size_t k = 0; k < kSliceLanes; ++k) {
      if (disparity[k] >= range.low && disparity[k] <= range.high) bits |= 1 << k;
    }
    within[row] = static_cast<uint16_t>(bits);
  }
}

void FindRuns(const int16_t* disparity, ptrdiff_t step, size_t length, size_t lines,
              const RunLimits& limits, const RunMarks& marks) {
  for (size_t k = 0; k < lines; ++k) {
    FindRunsOfLine(disparity + k, step, length, limits,
                   {marks.starts + k, marks.edges + k, marks.middles + k, marks.stride});
  }
}

// Adds the step between neighbours along rows (0) or columns (1); `inside` tells whether both are
// the cell's.
void AddStep(int a, int b, bool inside, int along, const CellLimits& limits, CellMeasure* measure) {
  const int step = std::abs(a - b);
  const int nearer = a > b ? a : b;
  if (step > limits.edge) {
    if (nearer < measure->edge_low) measure->edge_low = static_cast<int16_t>(nearer);
    if (nearer > measure->edge_high) measure->edge_high = static_cast<int16_t>(nearer);
    if (!inside) return;
    ++measure->edges[along];
    measure->gaps[along] +=
        static_cast<uint32_t>(step < limits.gap_limit ? step : limits.gap_limit);
  } else if (inside) {
    const int counted = step < limits.slope_limit ? step : limits.slope_limit;
    measure->slopes[along] += static_cast<uint32_t>(counted);
  }
}

void MeasureCell(const int16_t* const rows[10], const CellLimits& limits, CellMeasure* measure) {
  for (int k = 0; k < 8; ++k) {
    measure->column_low[k] = measure->column_high[k] = rows[1][k];
    measure->row_low[k] = measure->row_high[k] = rows[1 + k][0];
  }
  measure->nearest = UINT16_MAX;
  measure->edge_low = INT16_MAX;
  measure->edge_high = INT16_MIN;
  for (int along = 0; along < 2; ++along) {
    measure->slopes[along] = measure->edges[along] = measure->gaps[along] = 0;
  }
  for (int y = 0; y < 8; ++y) {
    const int16_t* row = rows[1 + y];
    for (int x = 0; x < 8; ++x) {
      AddDisparity(row[x], &measure->column_low[x], &measure->column_high[x]);
      AddDisparity(row[x], &measure->row_low[y], &measure->row_high[y]);
      const int distance = std::abs(row[x] - limits.focus);
      if (distance < measure->nearest) measure->nearest = static_cast<uint16_t>(distance);
      AddStep(row[x - 1], row[x], x > 0, 0, limits, measure);
      AddStep(rows[y][x], row[x], y > 0, 1, limits, measure);
    }
    AddStep(row[7], row[8], false, 0, limits, measure);
  }
  for (int x = 0; x < 8; ++x) AddStep(rows[8][x], rows[9][x], false, 1, limits, measure);
}

// Pixels between a block of cells `around` and `around` + 1 and the cell k; negative: one of them.
int GapTo(int k, int around) {
  const int before = around - 1 - k, behind = k - around - 2;
  return kCellPixels * (before > behind ? before : behind);
}

void AddReach(int value, int16_t* largest) {
  if (value > *largest) *largest = static_cast<int16_t>(value);
}

void ReachBlock(const CellPlanes& planes, int32_t around, const int16_t margins[3],
                BlockReach* reach) {
  *reach = {};
  const int side = 2 * around + 2;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const int16_t* cell =
          planes.cells + (y - around) * static_cast<ptrdiff_t>(planes.stride) + x - around;
      const auto value = [&](int plane) -> int {
        return cell[static_cast<size_t>(plane) * planes.plane];
      };
      const int gap_x = GapTo(x, around), gap_y = GapTo(y, around);
      // Towards the block: a cell on its left reaches to the right.
      const int from_x = x < around ? kReachRight : kReachLeft;
      const int from_y = y < around ? kReachBottom : kReachTop;
      for (int layer = 0; layer < 3; ++layer) {
        if (gap_x >= 0 && value(from_x) + margins[layer] <= gap_x) continue;
        if (gap_y >= 0 && value(from_y) + margins[layer] <= gap_y) continue;
        if (layer == 0) {
          AddReach(value(kRadiusPlane), &reach->radius);
          AddReach(value(kEdgePlane), &reach->edge);
        }
        const auto inside = [&](int from) -> int {
          return layer == 0 ? value(from + kInsideLeft - kReachLeft) : kCellPixels;
        };
        int16_t(&border)[4] = reach->border[layer];
        if (gap_x >= 0) {
          AddReach(gap_x + inside(from_x), &border[x < around ? kReachLeft : kReachRight]);
        }
        if (gap_y >= 0) {
          AddReach(gap_y + inside(from_y), &border[y < around ? kReachTop : kReachBottom]);
        }
      }
    }
  }
}

void SurroundCells(const CellPlanes& planes, int32_t around, size_t count,
                   const CellRanges& ranges) {
  for (size_t n = 0; n < SliceSamples(count); ++n) {
    const int16_t* cell = planes.cells + n;
    int16_t low = INT16_MAX, high = INT16_MIN, edge = 0;
    int widest = 0;
    for (int y = -around; y <= around; ++y) {
      for (int x = -around; x <= around; ++x) {
        const int16_t* at = cell + y * static_cast<ptrdiff_t>(planes.stride) + x;
        const int away = std::abs(x) > std::abs(y) ? std::abs(x) : std::abs(y);
        const int own = cell[kReachPlane * planes.plane], other = at[kReachPlane * planes.plane];
        if ((away - 1) * kCellPixels >= (own > other ? own : other)) continue;
        const int16_t first = at[kLowPlane * planes.plane], last = at[kHighPlane * planes.plane];
        low = first < low ? first : low;
        high = last > high ? last : high;
        widest = last - first > widest ? last - first : widest;
        AddReach(at[kEdgePlane * planes.plane], &edge);
      }
    }
    ranges.low[n] = low;
    ranges.high[n] = high;
    ranges.widest[n] = static_cast<uint16_t>(widest);
    ranges.edge[n] = edge;
  }
}

void Transpose(const uint8_t* in, size_t in_stride, size_t rows, size_t columns, uint8_t* out,
               size_t out_stride) {
  for (size_t row = 0; row < rows; ++row) {
    for (size_t column = 0; column < columns; ++column) {
      std::memcpy(out + column * out_stride + 3 * row, in + row * in_stride + 3 * column, 3);
    }
  }
}

void Finish(const uint32_t* accumulators, size_t count, int shift, uint8_t* out) {
  const uint32_t half = uint32_t{1} << (shift - 1);
  for (size_t n = 0; n < count; ++n) {
    out[n] = static_cast<uint8_t>((accumulators[n] + half) >> shift);
  }
}

bool ConvertDisparity(const float* disparity, size_t count, float low, float high, int16_t* out) {
  bool inside = true;
  for (size_t n = 0; n < count; ++n) {
    inside = inside && disparity[n] >= low && disparity[n] <= high;
    if (!inside) return false;
    out[n] = static_cast<int16_t>(std::floor(disparity[n] * 64.0f + 0.5f));
  }
  return inside;
}

void WidenPhases(const uint8_t* in, size_t pairs, int16_t* even, int16_t* odd) {
  for (size_t n = 0; n < pairs; ++n) {
    for (size_t c = 0; c < 3; ++c) {
      even[3 * n + c] = static_cast<int16_t>(in[6 * n + c] << kLayerBits);
      odd[3 * n + c] = static_cast<int16_t>(in[6 * n + 3 + c] << kLayerBits);
    }
  }
}

void SplitPhases(const int16_t* in, size_t pairs, int16_t* even, int16_t* odd) {
  for (size_t n = 0; n < pairs; ++n) {
    for (size_t c = 0; c < 3; ++c) {
      even[3 * n + c] = in[6 * n + c];
      odd[3 * n + c] = in[6 * n + 3 + c];
    }
  }
}

void Narrow(const int16_t* in, size_t count, uint8_t* out) {
  for (size_t n = 0; n < count; ++n) {
    const int odd = (in[n] >> kLayerBits) & 1;
    const int value = (in[n] + (1 << (kLayerBits - 1)) - 1 + odd) >> kLayerBits;
    out[n] = static_cast<uint8_t>(value < 0 ? 0 : value > 255 ? 255 : value);
  }
}

void FinishLayer(const uint32_t* accumulators, size_t count, int shift, int16_t* out) {
  const uint32_t half = uint32_t{1} << (shift - kLayerBits - 1);
  for (size_t n = 0; n < count; ++n) {
    out[n] = static_cast<int16_t>((accumulators[n] + half) >> (shift - kLayerBits));
  }
}

int16_t RoundTaps(int32_t sum, int16_t low, int16_t high) {
  const int32_t value = (sum + (1 << (kTapBits - 1))) >> kTapBits;
  return static_cast<int16_t>(value < low ? low : value > high ? high : value);
}

void FilterHalfBand(const int16_t* in, ptrdiff_t step, const HalfBand& taps, size_t count,
                    int16_t low, int16_t high, int16_t* out) {
  for (size_t n = 0; n < count; ++n) {
    const int16_t* at = in + n;
    out[n] = RoundTaps(taps.centre * at[0] + taps.near * (at[-step] + at[step]) +
                           taps.far * (at[-3 * step] + at[3 * step]),
                       low, high);
  }
}

void Halve(const int16_t* even, const int16_t* odd, const HalfBand& taps, size_t count,
           int16_t* out) {
  for (size_t n = 0; n < count; ++n) {
    const int16_t* at = odd + n;
    out[n] = RoundTaps(
        taps.centre * even[n] + taps.near * (at[-3] + at[0]) + taps.far * (at[-6] + at[3]),
        INT16_MIN, INT16_MAX);
  }
}

void Between(const int16_t* in, ptrdiff_t step, const HalfBand& taps, size_t count, int16_t low,
             int16_t high, int16_t* out) {
  for (size_t n = 0; n < count; ++n) {
    const int16_t* at = in + n;
    out[n] = RoundTaps(taps.near * (at[0] + at[step]) + taps.far * (at[-step] + at[2 * step]), low,
                       high);
  }
}

}  // namespace

const Kernels& ReferenceKernels() {
  using namespace reference;
  static constexpr Kernels kernels = {
      "reference", Accumulate,  Blend,         FilterDisc,  Split,           FindEdges,
      FindRanges,  FindWithin,  FindSteps,     BesideSteps, LookBehind,      Interpolate,
      SelectSlice, SpreadSlice, ShiftSlice,    Composite,   FinishComposite, FindRuns,
      MeasureCell, ReachBlock,  SurroundCells, Transpose,   Finish,          ConvertDisparity,
      WidenPhases, SplitPhases, Narrow,        FinishLayer, FilterHalfBand,  Halve,
      Between};
  return kernels;
}

}  // namespace starfocus::simd
