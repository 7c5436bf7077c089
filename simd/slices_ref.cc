// SPDX-License-Identifier: Apache-2.0
#include "simd/samples.h"
#include "simd/slices.h"

namespace starfocus::simd::reference {

SliceCover SelectSlice(const SurfaceRow& row, const SliceRange& range, size_t count, size_t plane,
                       int16_t* out) {
  SliceCover cover = {0, 0};
  for (size_t strip = 0; strip < count; strip += kSliceLanes) {
    const uint64_t bit = uint64_t{1} << (strip / kSliceLanes);
    cover.all |= bit;
    for (size_t n = strip; n < strip + kSliceLanes; ++n) {
      const bool hiding = (row.hiding & bit) != 0;
      const auto inside = [&](int surface) {
        const bool end = hiding && surface == 0 && row.share[n] != kSliceWhole;
        return row.disparity[surface][n] >= range.low &&
               row.disparity[surface][n] <= (end ? range.high : range.overlap);
      };
      int next = hiding ? 1 : kSurfaces;
      while (next < kSurfaces && !inside(next)) ++next;
      const int share = hiding && row.share[n] < kSliceWhole ? row.share[n] : kSliceWhole;
      const int front = inside(0) ? share : 0;
      const int behind = next < kSurfaces ? kSliceWhole - front : 0;
      const bool found = front + behind > 0, all = front + behind == kSliceWhole;
      for (size_t c = 0; c < 3; ++c) {
        const size_t at = c * row.plane + n;
        const int16_t first = row.rgb[0][at], hidden = behind > 0 ? row.rgb[next][at] : int16_t{0};
        const int32_t part = Product15(first - hidden, front << (15 - kSliceBits));
        out[c * plane + n] =
            front == kSliceWhole ? first : static_cast<int16_t>(front > 0 ? hidden + part : hidden);
      }
      out[3 * plane + n] = static_cast<int16_t>(((front + behind) << 8) - (all ? 1 : 0));
      if (n >= count) continue;
      if (found) cover.some |= bit;
      if (!all) cover.all &= ~bit;
    }
  }
  return cover;
}

void SpreadSlice(const int16_t* in, ptrdiff_t step, const SliceTaps& taps, size_t count,
                 int16_t* out) {
  for (size_t n = 0; n < SliceSamples(count); ++n) {
    int32_t sum = Product15(in[n], taps.centre);
    for (int32_t k = 1; k <= taps.reach; ++k) {
      const int16_t* at = in + n;
      const int32_t mean = (at[-k * step] + at[k * step] + 1) >> 1;
      sum += Product15(mean, k < taps.reach ? taps.inner : taps.outer);
      if (sum > INT16_MAX) sum = INT16_MAX;
    }
    out[n] = static_cast<int16_t>(sum);
  }
}

}  // namespace starfocus::simd::reference
