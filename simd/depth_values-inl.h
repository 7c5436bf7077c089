// SPDX-License-Identifier: Apache-2.0
// Vector code of the functions in depth_values.h. This file is included once per SIMD target.
#include "simd/depth_values.h"
#include "simd/highway-inl.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

using DepthTag = hn::ScalableTag<float>;
using DepthBits = hn::RebindToSigned<DepthTag>;

// Converts bytes or 16-bit numbers to floats, which represent all 16-bit numbers exactly.
template <class T>
HWY_INLINE bool WidenNumbers(const T* HWY_RESTRICT values, size_t count, float* HWY_RESTRICT z) {
  const DepthTag df;
  const DepthBits d32;
  const hn::Rebind<T, DepthTag> dvalue;
  return ForVectors(count, hn::Lanes(df), [&](size_t n) HWY_ATTR {
    const auto wide = hn::PromoteTo(d32, hn::LoadU(dvalue, values + n));
    hn::StoreU(hn::ConvertTo(df, wide), df, z + n);
  });
}

inline void BytesToDepth(const uint8_t* HWY_RESTRICT values, size_t count, float* HWY_RESTRICT z) {
  if (!WidenNumbers(values, count, z)) reference::BytesToDepth(values, count, z);
}

inline void WordsToDepth(const uint16_t* HWY_RESTRICT values, size_t count, float* HWY_RESTRICT z) {
  if (!WidenNumbers(values, count, z)) reference::WordsToDepth(values, count, z);
}

inline void HalvesToDepth(const uint16_t* HWY_RESTRICT values, size_t count,
                          float* HWY_RESTRICT z) {
  const DepthTag df;
  const DepthBits d32;
  const hn::Rebind<uint16_t, DepthTag> d16;
  const auto infinity = hn::Set(d32, 0x7F800000), nan = hn::Set(d32, 0x7FC00000);
  const bool done = ForVectors(count, hn::Lanes(df), [&](size_t n) HWY_ATTR {
    const auto half = hn::PromoteTo(d32, hn::LoadU(d16, values + n));
    const auto magnitude = hn::And(half, hn::Set(d32, 0x7FFF));
    const auto sign = hn::ShiftLeft<16>(hn::Sub(half, magnitude));
    // The biased exponent of a float is larger by 112 than that of a half-precision float. No
    // result is a denormal; some machines would flush denormals to 0.
    const auto normal = hn::Add(hn::ShiftLeft<13>(magnitude), hn::Set(d32, 112 << 23));
    const auto small =
        hn::BitCast(d32, hn::Mul(hn::ConvertTo(df, magnitude), hn::Set(df, 1.0f / (1 << 24))));
    const auto finite = hn::IfThenElse(hn::Lt(magnitude, hn::Set(d32, 1 << 10)), small, normal);
    const auto bits = hn::IfThenElse(hn::Eq(magnitude, hn::Set(d32, 0x7C00)), infinity, finite);
    const auto is_nan = hn::Gt(magnitude, hn::Set(d32, 0x7C00));
    hn::StoreU(hn::BitCast(df, hn::IfThenElse(is_nan, nan, hn::Or(bits, sign))), df, z + n);
  });
  if (!done) reference::HalvesToDepth(values, count, z);
}

inline void Depth16ToDepth(const uint16_t* HWY_RESTRICT values, size_t count,
                           float* HWY_RESTRICT z) {
  const DepthTag df;
  const DepthBits d32;
  const hn::Rebind<uint16_t, DepthTag> d16;
  const auto nan = hn::BitCast(df, hn::Set(d32, 0x7FC00000));
  const bool done = ForVectors(count, hn::Lanes(df), [&](size_t n) HWY_ATTR {
    const auto value = hn::PromoteTo(d32, hn::LoadU(d16, values + n));
    const auto distance = hn::And(value, hn::Set(d32, kDepth16Distance));
    const auto unknown = hn::RebindMask(df, hn::Eq(distance, hn::Zero(d32)));
    hn::StoreU(hn::IfThenElse(unknown, nan, hn::ConvertTo(df, distance)), df, z + n);
  });
  if (!done) reference::Depth16ToDepth(values, count, z);
}

// Converts depths whose disparities are all in the allowed range. The function `scaled` computes
// scale * z or scale / z, in 1/64 pixel. Multiplications by 64 are exact, so the disparities are 64
// times the disparities of the reference. Returns false if a disparity is unknown or not in range,
// or if there are fewer depths than lanes.
template <class Scaled>
HWY_INLINE bool ConvertInside(const float* HWY_RESTRICT z, size_t count, const DepthRule& rule,
                              const Scaled& scaled, int16_t* HWY_RESTRICT out) {
  const DepthTag df;
  const DepthBits d32;
  const hn::Rebind<int16_t, DepthTag> d16;
  const auto offset = hn::Set(df, rule.offset * 64), half = hn::Set(df, 0.5f);
  const auto low = hn::Set(df, rule.low * 64), high = hn::Set(df, rule.high * 64);
  auto inside = hn::Eq(low, low);
  const bool done = ForVectors(count, hn::Lanes(df), [&](size_t n) HWY_ATTR {
    const auto disparity = hn::Add(scaled(hn::LoadU(df, z + n)), offset);
    const auto fits = hn::And(hn::Ge(disparity, low), hn::Le(disparity, high));
    inside = hn::And(inside, fits);
    // Only values in range can be converted to integers on every target.
    const auto known = hn::IfThenElse(fits, disparity, low);
    const auto steps = hn::ConvertTo(d32, hn::Floor(hn::Add(known, half)));
    hn::StoreU(hn::DemoteTo(d16, steps), d16, out + n);
  });
  return done && hn::AllTrue(df, inside);
}

// Converts depths to disparities. The function `scaled` computes scale * z or scale / z.
template <class Scaled>
HWY_INLINE uint32_t ConvertDepths(const float* HWY_RESTRICT z, size_t count, const DepthRule& rule,
                                  const Scaled& scaled, int16_t* HWY_RESTRICT out) {
  const DepthTag df;
  const DepthBits d32;
  const hn::Rebind<int16_t, DepthTag> d16;
  const auto offset = hn::Set(df, rule.offset), invalid = hn::Set(df, rule.invalid);
  const auto low = hn::Set(df, rule.low), high = hn::Set(df, rule.high);
  const auto none = hn::Set(d32, int32_t{kNoSurface});
  uint32_t flags = 0;
  const bool done = ForVectors(count, hn::Lanes(df), [&](size_t n) HWY_ATTR {
    const auto value = hn::LoadU(df, z + n);
    const auto disparity = hn::Add(scaled(value), offset);
    const auto inside = hn::And(hn::Ge(disparity, low), hn::Le(disparity, high));
    const auto steps =
        hn::Floor(hn::Add(hn::Mul(disparity, hn::Set(df, 64.0f)), hn::Set(df, 0.5f)));
    auto result = hn::ConvertTo(d32, hn::IfThenElseZero(inside, steps));
    // `invalid` is compared with Eq, because the result of Ne for NaN differs between targets.
    const auto is_invalid = hn::Eq(value, invalid);
    if (!hn::AllTrue(df, hn::AndNot(is_invalid, inside))) {
      const auto finite = hn::Eq(hn::Sub(disparity, disparity), hn::Zero(df));
      const auto known = hn::AndNot(is_invalid, finite);
      if (!hn::AllTrue(df, known)) flags |= kUnknownDepth;
      if (!hn::AllFalse(df, hn::AndNot(inside, known))) flags |= kDepthOutside;
      result = hn::IfThenElse(hn::RebindMask(d32, known), result, none);
    }
    hn::StoreU(hn::DemoteTo(d16, result), d16, out + n);
  });
  return done ? flags : reference::DepthToDisparity(z, count, rule, out);
}

inline uint32_t DepthToDisparity(const float* HWY_RESTRICT z, size_t count, const DepthRule& rule,
                                 int16_t* HWY_RESTRICT out) {
#if HWY_ARCH_ARM_V7  // ARMv7 vectors flush denormals to 0 and approximate divisions
  return reference::DepthToDisparity(z, count, rule, out);
#else
  const auto scale = hn::Set(DepthTag(), rule.scale);
  // A depth that equals `invalid` has an unknown disparity, even if it is in range.
  const float of_invalid = rule.reciprocal ? rule.scale / rule.invalid : rule.scale * rule.invalid;
  if (!(of_invalid + rule.offset >= rule.low && of_invalid + rule.offset <= rule.high)) {
    const auto scale64 = hn::Set(DepthTag(), rule.scale * 64);
    const auto multiply = [&](hn::Vec<DepthTag> depth) HWY_ATTR { return hn::Mul(scale64, depth); };
    const auto divide = [&](hn::Vec<DepthTag> depth) HWY_ATTR { return hn::Div(scale64, depth); };
    if (rule.reciprocal ? ConvertInside(z, count, rule, divide, out)
                        : ConvertInside(z, count, rule, multiply, out)) {
      return 0;
    }
  }
  if (!rule.reciprocal) {
    return ConvertDepths(
        z, count, rule, [&](hn::Vec<DepthTag> value) HWY_ATTR { return hn::Mul(scale, value); },
        out);
  }
  return ConvertDepths(
      z, count, rule, [&](hn::Vec<DepthTag> value) HWY_ATTR { return hn::Div(scale, value); }, out);
#endif
}

// Returns a + (b - a) * share / kColumnOne, rounded, in lanes in which a and b differ by at most
// kBlendStep, and the nearer of a and b in other lanes.
template <class D, class V>
HWY_INLINE V Blended(D d16, V a, V b, V share) {
  const auto step = hn::Set(d16, kBlendStep), down = hn::Set(d16, int16_t{-kBlendStep});
  const auto half = hn::Set(d16, int16_t{kColumnOne / 2});
  const auto difference = hn::SaturatedSub(b, a);
  const auto apart = hn::Or(hn::Gt(difference, step), hn::Lt(difference, down));
  // The product overflows only in lanes in which `apart` is true, and these lanes do not use the
  // product.
  const auto product = hn::Mul(difference, share);
  const auto between = hn::Add(a, hn::ShiftRight<kColumnBits>(hn::Add(product, half)));
  return hn::IfThenElse(apart, hn::IfThenElse(hn::Lt(share, half), a, b), between);
}

inline void BlendRows(const int16_t* HWY_RESTRICT a, const int16_t* HWY_RESTRICT b, size_t count,
                      uint32_t share, int16_t* HWY_RESTRICT out) {
  const hn::ScalableTag<int16_t> d16;
  const auto weight = hn::Set(d16, static_cast<int16_t>(share));
  const bool done = ForVectors(count, hn::Lanes(d16), [&](size_t n) HWY_ATTR {
    hn::StoreU(Blended(d16, hn::LoadU(d16, a + n), hn::LoadU(d16, b + n), weight), d16, out + n);
  });
  if (!done) reference::BlendRows(a, b, count, share, out);
}

#if HWY_TARGET == HWY_SCALAR
using reference::UpsampleRow;
#else

// The 8 pixels of a vector lie between at most 9 neighbouring elements, because positions increase
// by at most one element per pixel. A shuffle of 8 loaded elements is faster than a gather.
inline void UpsampleRow(const int16_t* HWY_RESTRICT row, const uint32_t* HWY_RESTRICT columns,
                        size_t count, uint32_t first, int16_t* HWY_RESTRICT out) {
  constexpr size_t kLanes = 8;
  const hn::FixedTag<int16_t, kLanes> d16;
  const hn::Repartition<uint8_t, decltype(d16)> d8;
  const hn::FixedTag<int16_t, kLanes / 2> dhalf;
  const hn::FixedTag<int32_t, kLanes / 2> d32;
  const hn::RebindToUnsigned<decltype(d32)> du32;
  const bool done = ForVectors(count, kLanes, [&](size_t n) HWY_ATTR {
    const uint32_t left = columns[n] >> kColumnBits;
    const auto start = hn::Set(d32, static_cast<int32_t>(left << kColumnBits));
    // Positions relative to the element `left`, less than kLanes * kColumnOne.
    const auto place = [&](size_t at) HWY_ATTR {
      const auto column = hn::BitCast(d32, hn::LoadU(du32, columns + at));
      return hn::DemoteTo(dhalf, hn::Sub(column, start));
    };
    const auto places = hn::Combine(d16, place(n + kLanes / 2), place(n));
    const auto share = hn::And(places, hn::Set(d16, int16_t{kColumnOne - 1}));
    // The low and the high byte of element k are bytes 2 k and 2 k + 1.
    const auto twice = hn::ShiftLeft<1>(hn::ShiftRight<kColumnBits>(places));
    const auto bytes = hn::Add(hn::Or(twice, hn::ShiftLeft<8>(twice)), hn::Set(d16, int16_t{256}));
    const int16_t* const from = row + (left - first);
    const auto pick = [&](const int16_t* at) HWY_ATTR {
      const auto elements = hn::BitCast(d8, hn::LoadU(d16, at));
      return hn::BitCast(d16, hn::TableLookupBytes(elements, hn::BitCast(d8, bytes)));
    };
    hn::StoreU(Blended(d16, pick(from), pick(from + 1), share), d16, out + n);
  });
  if (!done) reference::UpsampleRow(row, columns, count, first, out);
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();
