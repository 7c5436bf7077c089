// SPDX-License-Identifier: Apache-2.0
// Vector code of the functions in words.h. This file is included once per SIMD target.
#include "simd/highway-inl.h"
#include "simd/words.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR  // scalar vectors have one lane and cannot hold a pair
using reference::DitherWords;
using reference::RgbToChromaWords;
using reference::RgbToLumaWords;
using reference::YuvWordsToRgb;
#else

// A vector of words consists of pairs of neighbouring pixels, or of samples of U and V. The first
// and second words of the pairs are separate vectors of 32-bit lanes.
using Words = hn::ScalableTag<uint16_t>;
using WordPairs = hn::Repartition<int32_t, Words>;

template <class V>
HWY_INLINE hn::Vec<WordPairs> FirstWords(V words) {
  return hn::And(hn::BitCast(WordPairs(), words), hn::Set(WordPairs(), 65535));
}
template <class V>
HWY_INLINE hn::Vec<WordPairs> SecondWords(V words) {
  const hn::RebindToUnsigned<WordPairs> du32;
  return hn::BitCast(WordPairs(), hn::ShiftRight<16>(hn::BitCast(du32, words)));
}
// Joins vectors of numbers in [0, 65535] to a vector of words.
template <class V>
HWY_INLINE hn::Vec<Words> JoinWords(V first, V second) {
  return hn::BitCast(Words(), hn::Or(first, hn::ShiftLeft<16>(second)));
}

HWY_INLINE hn::Vec<WordPairs> Set32(int32_t value) { return hn::Set(WordPairs(), value); }

template <class V>
HWY_INLINE V ScaledWord(V value, V more) {
  const auto product = hn::Add(hn::Mul(value, more), Set32(1 << 15));
  return hn::Add(value, hn::ShiftRight<16>(product));
}

template <class V>
HWY_INLINE V TenBitWord(V word) {
  const auto ten = hn::ShiftRight<6>(hn::Add(word, Set32(32)));
  return hn::ShiftLeft<6>(hn::Min(hn::Max(ten, Set32(0)), Set32(1023)));
}

// Calls step(n) for each vector of `count` pixels in whole pairs, so that n is even. Returns the
// number of processed pixels: 0, or `count` rounded down to an even number.
template <class Step>
HWY_INLINE size_t ForWordPairs(size_t count, const Step& step) {
  const bool done =
      ForVectors(count / 2, hn::Lanes(WordPairs()), [&](size_t pair) HWY_ATTR { step(2 * pair); });
  return done ? count / 2 * 2 : 0;
}

inline void YuvWordsToRgb(const uint16_t* HWY_RESTRICT y, const uint16_t* HWY_RESTRICT uv,
                          size_t count, const YuvMatrix& m, uint16_t* HWY_RESTRICT rgb) {
  const Words d16;
  const auto black = Set32(256 * m.black), scale = Set32(m.y), more = Set32(MoreOfWords(m));
  const auto luma = [&](hn::Vec<WordPairs> words) HWY_ATTR {
    const auto product = hn::Mul(hn::Sub(words, black), scale);
    return hn::Add(hn::ShiftRight<1>(product), Set32(1 << 12));
  };
  const auto code = [&](hn::Vec<WordPairs> sum) HWY_ATTR {
    const auto scaled = ScaledWord(hn::ShiftRight<13>(sum), more);
    return hn::Min(hn::Max(scaled, Set32(0)), Set32(65535));
  };
  const size_t done = ForWordPairs(count, [&](size_t n) HWY_ATTR {
    const auto words = hn::LoadU(d16, y + n), chroma = hn::LoadU(d16, uv + n);
    const auto even = luma(FirstWords(words)), odd = luma(SecondWords(words));
    const auto u = hn::Sub(FirstWords(chroma), Set32(32768));
    const auto v = hn::Sub(SecondWords(chroma), Set32(32768));
    const auto join = [&](hn::Vec<WordPairs> of_chroma) HWY_ATTR {
      return JoinWords(code(hn::Add(even, of_chroma)), code(hn::Add(odd, of_chroma)));
    };
    const auto green = hn::Add(hn::Mul(u, Set32(m.gu)), hn::Mul(v, Set32(m.gv)));
    hn::StoreInterleaved3(join(hn::Mul(v, Set32(m.rv))), join(green), join(hn::Mul(u, Set32(m.bu))),
                          d16, rgb + 3 * n);
  });
  reference::YuvWordsToRgb(y + done, uv + done, count - done, m, rgb + 3 * done);
}

// Returns the weighted sum of three colours, without 15 fractional bits, times the scale of words.
template <class V>
HWY_INLINE V WeighWords(V r, V g, V b, int32_t of_r, int32_t of_g, int32_t of_b, V more) {
  const auto sum = hn::Add(hn::Add(hn::Mul(r, Set32(of_r)), hn::Mul(g, Set32(of_g))),
                           hn::Add(hn::Mul(b, Set32(of_b)), Set32(1 << 14)));
  return ScaledWord(hn::ShiftRight<15>(sum), more);
}

inline void RgbToLumaWords(const uint16_t* HWY_RESTRICT rgb, size_t count, const YuvMatrix& m,
                           uint16_t* HWY_RESTRICT y) {
  const Words d16;
  const auto black = Set32(256 * m.black), more = Set32(MoreOfCodes(m));
  const auto luma = [&](hn::Vec<WordPairs> r, hn::Vec<WordPairs> g, hn::Vec<WordPairs> b) HWY_ATTR {
    return TenBitWord(hn::Add(black, WeighWords(r, g, b, m.yr, m.yg, m.yb, more)));
  };
  const bool done = ForVectors(count, hn::Lanes(d16), [&](size_t n) HWY_ATTR {
    hn::Vec<Words> r, g, b;
    hn::LoadInterleaved3(d16, rgb + 3 * n, r, g, b);
    hn::StoreU(JoinWords(luma(FirstWords(r), FirstWords(g), FirstWords(b)),
                         luma(SecondWords(r), SecondWords(g), SecondWords(b))),
               d16, y + n);
  });
  if (!done) reference::RgbToLumaWords(rgb, count, m, y);
}

// Returns the mean of two adjacent pixels and the two pixels below them.
template <class V>
HWY_INLINE hn::Vec<WordPairs> MeanOfFour(V upper, V lower) {
  const auto sum = hn::Add(hn::Add(FirstWords(upper), SecondWords(upper)),
                           hn::Add(FirstWords(lower), SecondWords(lower)));
  return hn::ShiftRight<2>(hn::Add(sum, Set32(2)));
}

inline void RgbToChromaWords(const uint16_t* HWY_RESTRICT upper, const uint16_t* HWY_RESTRICT lower,
                             size_t count, const YuvMatrix& m, uint16_t* HWY_RESTRICT uv) {
  const Words d16;
  const auto more = Set32(MoreOfCodes(m)), grey = Set32(32768);
  const size_t done = ForWordPairs(count, [&](size_t n) HWY_ATTR {
    hn::Vec<Words> r, g, b, below_r, below_g, below_b;
    hn::LoadInterleaved3(d16, upper + 3 * n, r, g, b);
    hn::LoadInterleaved3(d16, lower + 3 * n, below_r, below_g, below_b);
    const auto mean_r = MeanOfFour(r, below_r), mean_g = MeanOfFour(g, below_g);
    const auto mean_b = MeanOfFour(b, below_b);
    const auto u = WeighWords(mean_r, mean_g, mean_b, m.ur, m.ug, m.ub, more);
    const auto v = WeighWords(mean_r, mean_g, mean_b, m.vr, m.vg, m.vb, more);
    hn::StoreU(JoinWords(TenBitWord(hn::Add(grey, u)), TenBitWord(hn::Add(grey, v))), d16, uv + n);
  });
  reference::RgbToChromaWords(upper + 3 * done, lower + 3 * done, count - done, m, uv + done);
}

// Half a group of pixels of one channel.
using HalfGroup = hn::FixedTag<uint16_t, kDitherColumns / 2>;
using HalfGroupVec = hn::Vec<HalfGroup>;

HWY_INLINE HalfGroupVec Fine(HalfGroupVec codes) {
  return hn::Sub(codes, hn::ShiftRight<8>(codes));
}

// Dithers one channel of a group of two halves, in units of 1/256 of an 8-bit code.
HWY_INLINE void DitherGroup(HalfGroupVec more, HalfGroupVec& left, HalfGroupVec& right) {
  const HalfGroup d16;
  const auto start = hn::Broadcast<0>(left), range = hn::Set(d16, kDitherRange);
  const auto round = hn::Set(d16, kDitherRound);
  const auto beyond = [&](HalfGroupVec half) HWY_ATTR {
    const auto change = hn::Or(hn::SaturatedSub(half, start), hn::SaturatedSub(start, half));
    return hn::SaturatedSub(change, range);
  };
  const bool smooth = AllZero(d16, hn::Or(beyond(left), beyond(right)));
  if (!smooth) more = round;
  const auto code = [&](HalfGroupVec half) HWY_ATTR {
    const auto dark = hn::SaturatedSub(hn::Set(d16, kDitherDark), hn::ShiftRight<7>(half));
    const auto snap = hn::Add(hn::Set(d16, kDitherSnap), dark);
    const auto rest = hn::And(hn::Add(half, snap), hn::Set(d16, 255));
    const auto near = hn::Eq(hn::SaturatedSub(rest, hn::Add(snap, snap)), hn::Zero(d16));
    return hn::ShiftRight<8>(hn::Add(half, hn::IfThenElse(near, round, more)));
  };
  left = code(left);
  right = code(right);
}

inline void DitherWords(const uint16_t* HWY_RESTRICT rgb, size_t count,
                        const uint16_t* HWY_RESTRICT more, uint8_t* HWY_RESTRICT out) {
  const HalfGroup d16;
  const hn::RebindToSigned<HalfGroup> di16;
  const hn::Rebind<uint8_t, HalfGroup> d8;
  constexpr size_t kHalf = kDitherColumns / 2;
  const auto added = hn::LoadU(d16, more);
  const auto store = [&](HalfGroupVec r, HalfGroupVec g, HalfGroupVec b, uint8_t* to) HWY_ATTR {
    hn::StoreInterleaved3(hn::DemoteTo(d8, hn::BitCast(di16, r)),
                          hn::DemoteTo(d8, hn::BitCast(di16, g)),
                          hn::DemoteTo(d8, hn::BitCast(di16, b)), d8, to);
  };
  size_t n = 0;
  for (; n + kDitherColumns <= count; n += kDitherColumns) {
    HalfGroupVec r, g, b, right_r, right_g, right_b;
    hn::LoadInterleaved3(d16, rgb + 3 * n, r, g, b);
    hn::LoadInterleaved3(d16, rgb + 3 * (n + kHalf), right_r, right_g, right_b);
    r = Fine(r), g = Fine(g), b = Fine(b);
    right_r = Fine(right_r), right_g = Fine(right_g), right_b = Fine(right_b);
    DitherGroup(added, r, right_r);
    DitherGroup(added, g, right_g);
    DitherGroup(added, b, right_b);
    store(r, g, b, out + 3 * n);
    store(right_r, right_g, right_b, out + 3 * (n + kHalf));
  }
  reference::DitherWords(rgb + 3 * n, count - n, more, out + 3 * n);
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();
