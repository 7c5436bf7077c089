#include "lib/timing.h"

namespace starfocus {

ViewCounts CountViews(int32_t n) {
  ViewCounts views = {4 * static_cast<uint32_t>(n), 0, 0};
  for (int32_t i = 1; i <= n; ++i) {
    if (2 * i * i <= n * n) views.b += 4;
    for (int32_t j = 1; j < i && i * i + j * j <= n * n; ++j) views.c += 8;
  }
  return views;
}

BlockWork MeasureWork(const Rect& rect, const Border& border, const ViewCounts& views,
                      uint64_t upsampled_pixels) {
  const auto width = static_cast<uint64_t>(rect.width), height = static_cast<uint64_t>(rect.height);
  const uint64_t extended_width = width + static_cast<uint64_t>(border.left + border.right);
  const uint64_t extended_height = height + static_cast<uint64_t>(border.top + border.bottom);
  BlockWork work;
  work.field = extended_width * extended_height;
  // Half of the type A views lie on either axis; each is rendered over the border of the other.
  work.a = views.a / 2 * (width * extended_height + extended_width * height);
  work.b = views.b * width * height;
  work.c = views.c * width * height;
  work.upsample = upsampled_pixels;
  return work;
}

uint64_t PredictTime(const sf_timing& timing, const BlockWork& work) {
  return timing.block + timing.field * work.field + timing.a * work.a + timing.b * work.b +
         timing.c * work.c + timing.upsample * work.upsample;
}

sf_timing DefaultTiming() {
  // block, field, a, b, c, upsample
  return {4000000, 12000, 5000, 4000, 3000, 6000};
}

}  // namespace starfocus
