// SPDX-License-Identifier: Apache-2.0
// Vector code of the functions in pixels.h. This file is included once per SIMD target.
#include "simd/highway-inl.h"
#include "simd/pixels.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

inline void PixelsToRgb(const uint8_t* HWY_RESTRICT pixels, size_t count, size_t step,
                        bool blue_first, uint8_t* HWY_RESTRICT rgb) {
  const hn::ScalableTag<uint8_t> d8;
  if (count == 0) return;
  // The reference converts the last pixel, because the reference does not read the fourth byte.
  const size_t before = count - 1;
  const bool done = ForVectors(before, hn::Lanes(d8), [&](size_t n) HWY_ATTR {
    hn::Vec<decltype(d8)> a, b, c;
    if (step == 3) {
      hn::LoadInterleaved3(d8, pixels + 3 * n, a, b, c);
    } else {
      hn::Vec<decltype(d8)> unused;
      hn::LoadInterleaved4(d8, pixels + 4 * n, a, b, c, unused);
    }
    if (blue_first) {
      hn::StoreInterleaved3(c, b, a, d8, rgb + 3 * n);
    } else {
      hn::StoreInterleaved3(a, b, c, d8, rgb + 3 * n);
    }
  });
  const size_t rest = done ? before : 0;
  reference::PixelsToRgb(pixels + step * rest, count - rest, step, blue_first, rgb + 3 * rest);
}

inline void RgbToPixels(const uint8_t* HWY_RESTRICT rgb, size_t count, size_t step, bool blue_first,
                        uint8_t* HWY_RESTRICT pixels) {
  const hn::ScalableTag<uint8_t> d8;
  const auto opaque = hn::Set(d8, uint8_t{255});
  const bool done = ForVectors(count, hn::Lanes(d8), [&](size_t n) HWY_ATTR {
    hn::Vec<decltype(d8)> r, g, b;
    hn::LoadInterleaved3(d8, rgb + 3 * n, r, g, b);
    const auto first = blue_first ? b : r, third = blue_first ? r : b;
    if (step == 3) {
      hn::StoreInterleaved3(first, g, third, d8, pixels + 3 * n);
    } else {
      hn::StoreInterleaved4(first, g, third, opaque, d8, pixels + 4 * n);
    }
  });
  if (!done) reference::RgbToPixels(rgb, count, step, blue_first, pixels);
}

#if HWY_TARGET == HWY_SCALAR  // scalar vectors have one lane and cannot hold a pair
using reference::RgbToChroma;
using reference::RgbToLuma;
using reference::YuvToRgb;
#else

// A vector of codes consists of pairs of neighbouring pixels. Even and odd pixels are separate
// vectors of 16-bit lanes; lane k of both vectors shares chroma sample k.
using YuvCodes = hn::ScalableTag<uint8_t>;
using YuvPairs = hn::Repartition<int16_t, YuvCodes>;

template <class V>
HWY_INLINE hn::Vec<YuvPairs> EvenCodes(V codes) {
  return hn::And(hn::BitCast(YuvPairs(), codes), hn::Set(YuvPairs(), int16_t{255}));
}
template <class V>
HWY_INLINE hn::Vec<YuvPairs> OddCodes(V codes) {
  const hn::RebindToUnsigned<YuvPairs> du16;
  return hn::BitCast(YuvPairs(), hn::ShiftRight<8>(hn::BitCast(du16, codes)));
}
// Joins vectors of even and odd numbers in [0, 255] to a vector of codes.
template <class V>
HWY_INLINE hn::Vec<YuvCodes> JoinCodes(V even, V odd) {
  return hn::BitCast(YuvCodes(), hn::Or(even, hn::ShiftLeft<8>(odd)));
}
template <class V>
HWY_INLINE V ClampCodes(V value) {
  const YuvPairs d16;
  return hn::Min(hn::Max(value, hn::Zero(d16)), hn::Set(d16, int16_t{255}));
}

// Calls step(n) for each vector of `count` pixels in whole pairs, so that n is even. Returns the
// number of processed pixels: 0, or `count` rounded down to an even number.
template <class Step>
HWY_INLINE size_t ForPairs(size_t count, const Step& step) {
  const bool done =
      ForVectors(count / 2, hn::Lanes(YuvPairs()), [&](size_t pair) HWY_ATTR { step(2 * pair); });
  return done ? count / 2 * 2 : 0;
}

// Sums that exceed 16 bits are above white. The saturated value is also above white, so the clamped
// result is correct.
template <class V>
HWY_INLINE hn::Vec<YuvCodes> AddChroma(V even, V odd, V chroma) {
  return JoinCodes(ClampCodes(hn::ShiftRight<6>(hn::SaturatedAdd(even, chroma))),
                   ClampCodes(hn::ShiftRight<6>(hn::SaturatedAdd(odd, chroma))));
}

inline void YuvToRgb(const uint8_t* HWY_RESTRICT y, const uint8_t* HWY_RESTRICT u,
                     const uint8_t* HWY_RESTRICT v, size_t count, const YuvMatrix& m,
                     uint8_t* HWY_RESTRICT rgb) {
  const YuvCodes d8;
  const YuvPairs d16;
  const auto black = hn::Set(d16, m.black), scale = hn::Set(d16, m.y);
  const auto half = hn::Set(d16, int16_t{32}), grey = hn::Set(d16, int16_t{128});
  const auto luma = [&](hn::Vec<YuvPairs> codes) HWY_ATTR {
    const auto above = hn::ShiftLeft<7>(hn::Sub(codes, black));
    return hn::Add(hn::MulFixedPoint15(above, scale), half);
  };
  const auto chroma = [&](const uint8_t* from) HWY_ATTR {
    return hn::ShiftLeft<8>(hn::Sub(LoadBytes(d16, from), grey));
  };
  const size_t done = ForPairs(count, [&](size_t n) HWY_ATTR {
    const auto codes = hn::LoadU(d8, y + n);
    const auto even = luma(EvenCodes(codes)), odd = luma(OddCodes(codes));
    const auto du = chroma(u + n / 2), dv = chroma(v + n / 2);
    const auto g = hn::Add(hn::MulFixedPoint15(du, hn::Set(d16, m.gu)),
                           hn::MulFixedPoint15(dv, hn::Set(d16, m.gv)));
    hn::StoreInterleaved3(
        AddChroma(even, odd, hn::MulFixedPoint15(dv, hn::Set(d16, m.rv))), AddChroma(even, odd, g),
        AddChroma(even, odd, hn::MulFixedPoint15(du, hn::Set(d16, m.bu))), d8, rgb + 3 * n);
  });
  reference::YuvToRgb(y + done, u + done / 2, v + done / 2, count - done, m, rgb + 3 * done);
}

// Returns the weighted sum of three colours with 7 fractional bits, rounded to integers.
template <class V>
HWY_INLINE V WeighColours(V r, V g, V b, int16_t of_r, int16_t of_g, int16_t of_b) {
  const YuvPairs d16;
  const auto sum = hn::Add(hn::Add(hn::MulFixedPoint15(r, hn::Set(d16, of_r)),
                                   hn::MulFixedPoint15(g, hn::Set(d16, of_g))),
                           hn::MulFixedPoint15(b, hn::Set(d16, of_b)));
  return hn::ShiftRight<7>(hn::Add(sum, hn::Set(d16, int16_t{64})));
}

inline void RgbToLuma(const uint8_t* HWY_RESTRICT rgb, size_t count, const YuvMatrix& m,
                      uint8_t* HWY_RESTRICT y) {
  const YuvCodes d8;
  const YuvPairs d16;
  const auto black = hn::Set(d16, m.black);
  const auto luma = [&](hn::Vec<YuvPairs> r, hn::Vec<YuvPairs> g, hn::Vec<YuvPairs> b) HWY_ATTR {
    return hn::Add(black, WeighColours(hn::ShiftLeft<7>(r), hn::ShiftLeft<7>(g),
                                       hn::ShiftLeft<7>(b), m.yr, m.yg, m.yb));
  };
  const bool done = ForVectors(count, hn::Lanes(d8), [&](size_t n) HWY_ATTR {
    hn::Vec<YuvCodes> r, g, b;
    hn::LoadInterleaved3(d8, rgb + 3 * n, r, g, b);
    hn::StoreU(JoinCodes(luma(EvenCodes(r), EvenCodes(g), EvenCodes(b)),
                         luma(OddCodes(r), OddCodes(g), OddCodes(b))),
               d8, y + n);
  });
  if (!done) reference::RgbToLuma(rgb, count, m, y);
}

// Returns 32 times the sum over two adjacent pixels and the two pixels below them.
template <class V>
HWY_INLINE hn::Vec<YuvPairs> SumPairs(V upper, V lower) {
  const auto sum = hn::Add(hn::Add(EvenCodes(upper), OddCodes(upper)),
                           hn::Add(EvenCodes(lower), OddCodes(lower)));
  return hn::ShiftLeft<5>(sum);
}

inline void RgbToChroma(const uint8_t* HWY_RESTRICT upper, const uint8_t* HWY_RESTRICT lower,
                        size_t count, const YuvMatrix& m, uint8_t* HWY_RESTRICT u,
                        uint8_t* HWY_RESTRICT v) {
  const YuvCodes d8;
  const YuvPairs d16;
  const auto grey = hn::Set(d16, int16_t{128});
  const size_t done = ForPairs(count, [&](size_t n) HWY_ATTR {
    hn::Vec<YuvCodes> r, g, b, below_r, below_g, below_b;
    hn::LoadInterleaved3(d8, upper + 3 * n, r, g, b);
    hn::LoadInterleaved3(d8, lower + 3 * n, below_r, below_g, below_b);
    const auto sum_r = SumPairs(r, below_r), sum_g = SumPairs(g, below_g);
    const auto sum_b = SumPairs(b, below_b);
    const auto of_u = WeighColours(sum_r, sum_g, sum_b, m.ur, m.ug, m.ub);
    const auto of_v = WeighColours(sum_r, sum_g, sum_b, m.vr, m.vg, m.vb);
    StoreBytes(d16, hn::Add(grey, of_u), u + n / 2);
    StoreBytes(d16, hn::Add(grey, of_v), v + n / 2);
  });
  reference::RgbToChroma(upper + 3 * done, lower + 3 * done, count - done, m, u + done / 2,
                         v + done / 2);
}

#endif

inline void DeinterleavePairs(const uint8_t* HWY_RESTRICT pairs, size_t count,
                              uint8_t* HWY_RESTRICT first, uint8_t* HWY_RESTRICT second) {
  const hn::ScalableTag<uint8_t> d8;
  const bool done = ForVectors(count, hn::Lanes(d8), [&](size_t n) HWY_ATTR {
    hn::Vec<decltype(d8)> a, b;
    hn::LoadInterleaved2(d8, pairs + 2 * n, a, b);
    hn::StoreU(a, d8, first + n);
    hn::StoreU(b, d8, second + n);
  });
  if (!done) reference::DeinterleavePairs(pairs, count, first, second);
}

inline void JoinPairs(const uint8_t* HWY_RESTRICT first, const uint8_t* HWY_RESTRICT second,
                      size_t count, uint8_t* HWY_RESTRICT pairs) {
  const hn::ScalableTag<uint8_t> d8;
  const bool done = ForVectors(count, hn::Lanes(d8), [&](size_t n) HWY_ATTR {
    hn::StoreInterleaved2(hn::LoadU(d8, first + n), hn::LoadU(d8, second + n), d8, pairs + 2 * n);
  });
  if (!done) reference::JoinPairs(first, second, count, pairs);
}

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();
