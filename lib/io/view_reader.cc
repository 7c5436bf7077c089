// SPDX-License-Identifier: Apache-2.0
#include "lib/io/view_reader.h"

namespace starfocus {
namespace {

const uint8_t* PlaneCodes(const void* self, int view, int32_t x, int32_t y, int32_t, uint8_t*) {
  const auto& planes = *static_cast<const PlaneViews*>(self);
  return planes.view[view].Row(y) + 3 * static_cast<ptrdiff_t>(x);
}

void PlaneLight(const void* self, int view, int32_t x, int32_t y, int32_t count, int16_t* rgb) {
  const auto& planes = *static_cast<const PlaneViews*>(self);
  const uint8_t* const codes = PlaneCodes(self, view, x, y, count, nullptr);
#if defined(__GNUC__)
  // Side views are read in short pieces, row by row. Hardware prefetchers do not predict the
  // addresses of such short pieces. Prefetching the row after the next one saves 2 to 4 % of the
  // time on scenes with 5 views.
  if (view > 0) __builtin_prefetch(codes + 2 * planes.view[view].stride);
#endif
  if (count < 3) {
    for (int32_t n = 0; n < 3 * count; ++n) rgb[n] = planes.transfer->light[codes[n]];
    return;
  }
  planes.kernels->Decode(codes, 3 * static_cast<size_t>(count), planes.transfer->encoding, rgb);
}

}  // namespace

ViewReader ReaderOf(const PlaneViews& views) { return {PlaneLight, PlaneCodes, &views}; }

}  // namespace starfocus
