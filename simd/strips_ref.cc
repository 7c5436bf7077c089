// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstring>

#include "simd/samples.h"
#include "simd/strips.h"

namespace starfocus::simd::reference {
namespace {

int16_t Between15(int16_t from, int16_t to, int16_t fraction) {
  return static_cast<int16_t>(to + Product15(to - from, fraction));
}

// Interpolates between a sample and the following samples, which are `next` apart. `covered` points
// to the coverage of the first sample.
int16_t Between15(const int16_t* at, const int16_t* covered, size_t next,
                  const SliceFraction& fraction) {
  const bool alike = covered[0] == covered[next];
  int value = Between15(at[0], at[next], alike ? fraction.inside : fraction.edge);
  if (fraction.third != 0) value += Product15(at[next] - at[2 * next], fraction.third);
  if (fraction.fourth != 0) value += Product15(at[2 * next] - at[3 * next], fraction.fourth);
  return static_cast<int16_t>(value);
}

// Approximates light / covered, both in units of kSliceOne, by the series 1 - excess (1 + open +
// open^2). `open` is the part of the pixel that the slice does not cover. The result is exact if
// `open` is 0 or the excess is small, and at most 4 * light.
int16_t SliceShare(int16_t covered, int16_t light) {
  const int32_t excess = covered - light, open = kSliceOne - covered;
  const int16_t first = Product15(excess, open), second = Product15(first, open);
  const int32_t share = kSliceOne - Saturated(excess + first + second);
  return static_cast<int16_t>(share < 4 * light ? share : Saturated(4 * light));
}

}  // namespace

void ShiftSlice(const SlicePlanes& in, const SliceFraction& fraction, size_t rows, size_t plane,
                int16_t* out, int8_t* near) {
  // Number of consecutive fully covered rows up to and including the current row.
  size_t all_covered = 0;
  for (size_t row = 0; row < rows; ++row) {
    const int16_t* covered = in.samples + (4 * row + 3) * in.plane;
    for (size_t c = 0; c < 4; ++c) {
      const int16_t* from = in.samples + (4 * row + c) * in.plane;
      int16_t* to = out + c * plane + row * kSliceLanes;
      for (size_t n = 0; n < kSliceLanes; ++n)
        to[n] = Between15(from + n, covered + n, 1, fraction);
    }
    const int16_t *shown = out + 3 * plane + row * kSliceLanes, *end = shown + kSliceLanes;
    int8_t* last = near + row;
    if (std::any_of(shown, end, [](int16_t sample) { return sample != 0; })) {
      for (int k = 0; k <= int{kRowsAhead}; ++k) last[-k] = std::min(last[-k], int8_t(k));
    }
    const bool all = std::all_of(shown, end, [](int16_t sample) { return sample == kSliceOne; });
    all_covered = all ? all_covered + 1 : 0;
    if (all_covered > kRowsAhead) last[-int{kRowsAhead}] = kCoveredNear;
  }
}

void Composite(const SliceViews& views, size_t rows, uint32_t* sums) {
  for (size_t y = 0; y < rows; ++y, sums += 4 * kSliceLanes) {
    const size_t row = views.row + y;
    for (size_t n = 0; n < kSliceLanes; ++n) {
      uint32_t given[4] = {0, 0, 0, 0};
      for (size_t view = 0; view < views.views; ++view) {
        const int16_t weight = views.weights[view];
        int16_t light = kSliceOne;
        for (size_t k = 0; k < views.shown_count; ++k) {
          const StripSlice& slice = views.slices[views.shown[k]];
          const SliceOffset& offset = views.offsets[view * views.count + views.shown[k]];
          const ptrdiff_t moved = static_cast<ptrdiff_t>(row) + offset.whole;
          if (slice.near[moved] == kNothingNear) continue;
          const int16_t* from = slice.samples + moved * ptrdiff_t{kSliceLanes} + n;
          const auto value = [&](size_t c) {
            return Between15(from + c * slice.plane, from + 3 * slice.plane, kSliceLanes,
                             offset.fraction);
          };
          const int16_t covered = value(3);
          for (size_t c = 0; c < 4; ++c) {
            const int16_t lit =
                covered > light ? Product15(value(c), SliceShare(covered, light)) : value(c);
            given[c] += static_cast<uint32_t>(Product15(weight, lit));
          }
          light = static_cast<int16_t>(covered > light ? 0 : light - covered);
        }
      }
      const uint32_t half = uint32_t{1} << views.extra_bits >> 1;
      for (size_t c = 0; c < 4; ++c) {
        sums[n + c * kSliceLanes] += (given[c] + half) >> views.extra_bits;
      }
    }
  }
}

}  // namespace starfocus::simd::reference
