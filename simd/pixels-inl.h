// SPDX-License-Identifier: Apache-2.0
// Vector code of the functions in pixels.h. This file is included once per SIMD target.
#if defined(STARFOCUS_SIMD_PIXELS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STARFOCUS_SIMD_PIXELS_INL_H_
#undef STARFOCUS_SIMD_PIXELS_INL_H_
#else
#define STARFOCUS_SIMD_PIXELS_INL_H_
#endif

#include "simd/highway-inl.h"
#include "simd/pixels.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

inline void PixelsToRgb(const uint8_t* HWY_RESTRICT pixels, size_t count, const PixelOrder& order,
                        uint8_t* HWY_RESTRICT rgb) {
  const hn::ScalableTag<uint8_t> d8;
  if (count == 0) return;
  // The reference converts the last pixel, because the reference does not read the fourth byte.
  const size_t before = count - 1;
  const bool done = ForVectors(before, hn::Lanes(d8), [&](size_t n) HWY_ATTR {
    hn::Vec<decltype(d8)> a, b, c;
    if (order.step == 3) {
      hn::LoadInterleaved3(d8, pixels + 3 * n, a, b, c);
    } else {
      hn::Vec<decltype(d8)> unused;
      hn::LoadInterleaved4(d8, pixels + 4 * n, a, b, c, unused);
    }
    if (order.blue_first) {
      hn::StoreInterleaved3(c, b, a, d8, rgb + 3 * n);
    } else {
      hn::StoreInterleaved3(a, b, c, d8, rgb + 3 * n);
    }
  });
  const size_t rest = done ? before : 0;
  reference::PixelsToRgb(pixels + order.step * rest, count - rest, order, rgb + 3 * rest);
}

inline void RgbToPixels(const uint8_t* HWY_RESTRICT rgb, size_t count, const PixelOrder& order,
                        uint8_t* HWY_RESTRICT pixels) {
  const hn::ScalableTag<uint8_t> d8;
  const auto opaque = hn::Set(d8, uint8_t{255});
  const bool done = ForVectors(count, hn::Lanes(d8), [&](size_t n) HWY_ATTR {
    hn::Vec<decltype(d8)> r, g, b;
    hn::LoadInterleaved3(d8, rgb + 3 * n, r, g, b);
    const auto first = order.blue_first ? b : r, third = order.blue_first ? r : b;
    if (order.step == 3) {
      hn::StoreInterleaved3(first, g, third, d8, pixels + 3 * n);
    } else {
      hn::StoreInterleaved4(first, g, third, opaque, d8, pixels + 4 * n);
    }
  });
  if (!done) reference::RgbToPixels(rgb, count, order, pixels);
}

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();

#endif
