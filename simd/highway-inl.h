// SPDX-License-Identifier: Apache-2.0
// What the kernels add to Highway: operations that hide differences between Highway versions and
// targets, loops over samples, and vectors of at most one group. This file is included once per
// SIMD target.
#if defined(STARFOCUS_SIMD_HIGHWAY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STARFOCUS_SIMD_HIGHWAY_INL_H_
#undef STARFOCUS_SIMD_HIGHWAY_INL_H_
#else
#define STARFOCUS_SIMD_HIGHWAY_INL_H_
#endif

#include "hwy/highway.h"
#include "simd/samples.h"

#if HWY_ARCH_WASM && HWY_TARGET != HWY_SCALAR

// Operations for WebAssembly that Highway 1.0.3 computes with scalar code. The compiler prefers
// these overloads to the templates of Highway, also within other operations of Highway.
HWY_BEFORE_NAMESPACE();
namespace hwy {
namespace HWY_NAMESPACE {

// LoadInterleaved3 and StoreInterleaved3 call these functions. An index of 16 or more selects 0.
HWY_API Vec128<uint8_t> TableLookupBytesOr0(Vec128<uint8_t> bytes, Vec128<uint8_t> from) {
  return Vec128<uint8_t>{wasm_i8x16_swizzle(bytes.raw, from.raw)};
}
HWY_API Vec128<uint16_t> TableLookupBytesOr0(Vec128<int16_t> bytes, Vec128<uint16_t> from) {
  return Vec128<uint16_t>{wasm_i8x16_swizzle(bytes.raw, from.raw)};
}

HWY_API bool AllFalse(Full128<int16_t> /* tag */, Mask128<int16_t> mask) {
  return !wasm_v128_any_true(mask.raw);
}

}  // namespace HWY_NAMESPACE
}  // namespace hwy
HWY_AFTER_NAMESPACE();

#endif

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// 1 if a widening multiply-add of 16-bit lanes adds the products of two adjacent lanes, as on x86
// and WebAssembly. On other targets, a widening multiply-add adds each product to a separate sum.
#undef STARFOCUS_HAVE_PAIR_MULTIPLY
#if (HWY_ARCH_X86 || HWY_ARCH_WASM) && HWY_TARGET != HWY_SCALAR
#define STARFOCUS_HAVE_PAIR_MULTIPLY 1
#else
#define STARFOCUS_HAVE_PAIR_MULTIPLY 0
#endif

// Returns true if all lanes of a vector of integers are 0.
template <class D>
HWY_INLINE bool AllZero(D d, hn::Vec<D> v) {
#if HWY_ARCH_WASM && HWY_TARGET != HWY_SCALAR
  (void)d;
  return !wasm_v128_any_true(v.raw);
#else
  return hn::AllTrue(d, hn::Eq(v, hn::Zero(d)));
#endif
}

// Returns first, first + 1, first + 2 and so on. Iota of Highway 1.0.3 computes such lanes one by
// one unless `first` is a constant.
template <class D>
HWY_INLINE hn::Vec<D> CountFrom(D d, hn::TFromD<D> first) {
  return hn::Add(hn::Iota(d, 0), hn::Set(d, first));
}

// Returns a * wa + b * wb in 32-bit lanes, for a, b, wa, wb <= 32767.
template <class D32, class V32 = hn::Vec<D32>>
HWY_INLINE V32 WeighPair(D32 d32, V32 a, V32 b, V32 wa, V32 wb) {
#if STARFOCUS_HAVE_PAIR_MULTIPLY
  const hn::RebindToSigned<D32> di32;
  const hn::Repartition<int16_t, decltype(di32)> di16;
  const auto pixels = hn::BitCast(di16, hn::Or(a, hn::ShiftLeft<16>(b)));
  const auto weights = hn::BitCast(di16, hn::Or(wa, hn::ShiftLeft<16>(wb)));
  auto unused = hn::Zero(di32);
  return hn::BitCast(d32,
                     hn::ReorderWidenMulAccumulate(di32, pixels, weights, hn::Zero(di32), unused));
#else
  (void)d32;
  return hn::Add(hn::Mul(a, wa), hn::Mul(b, wb));
#endif
}

// 1 if AddProduct15 is one instruction, which saturates.
#undef STARFOCUS_HAVE_ROUNDING_MULTIPLY_ADD
#if HWY_ARCH_ARM_A64 && HWY_TARGET == HWY_NEON && defined(__ARM_FEATURE_QRDMX)
#define STARFOCUS_HAVE_ROUNDING_MULTIPLY_ADD 1
#else
#define STARFOCUS_HAVE_ROUNDING_MULTIPLY_ADD 0
#endif

// Returns sum + a * b for numbers with 15 fractional bits; the product is rounded half up. The
// result must not exceed the range of signed 16-bit numbers.
template <class V>
HWY_INLINE V AddProduct15(V sum, V a, V b) {
#if STARFOCUS_HAVE_ROUNDING_MULTIPLY_ADD
  return V(vqrdmlahq_s16(sum.raw, a.raw, b.raw));
#else
  return hn::Add(sum, hn::MulFixedPoint15(a, b));
#endif
}

#if HWY_TARGET != HWY_SCALAR

// Adds a * wa + b * wb of 16-bit lanes to 32-bit sums. The order of the lanes in the two vectors of
// sums depends on the target; read the sums with DemoteSums.
template <class V16, class V32>
HWY_INLINE void AddWeighed(V16 a, V16 b, int32_t wa, int32_t wb, V32& low, V32& high) {
  const hn::DFromV<V16> d16;
  const hn::Repartition<int32_t, decltype(d16)> d32;
#if STARFOCUS_HAVE_PAIR_MULTIPLY
  const auto pair =
      hn::Set(d32, static_cast<int32_t>((wa & 0xFFFF) | static_cast<uint32_t>(wb) << 16));
  const auto weights = hn::BitCast(d16, pair);
  auto unused = hn::Zero(d32);
  low = hn::ReorderWidenMulAccumulate(d32, hn::InterleaveLower(d16, a, b), weights, low, unused);
  high = hn::ReorderWidenMulAccumulate(d32, hn::InterleaveUpper(d16, a, b), weights, high, unused);
#else
  const auto weight_a = hn::Set(d16, static_cast<int16_t>(wa));
  const auto weight_b = hn::Set(d16, static_cast<int16_t>(wb));
  low = hn::ReorderWidenMulAccumulate(d32, a, weight_a, low, high);
  low = hn::ReorderWidenMulAccumulate(d32, b, weight_b, low, high);
#endif
}

// Returns the sums of AddWeighed, saturated, as one vector of 16-bit lanes in the order of the
// inputs.
template <class D16, class V32>
HWY_INLINE hn::Vec<D16> DemoteSums(D16 d16, V32 low, V32 high) {
#if HWY_ARCH_ARM_V7  // ReorderDemote2To of Highway 1.0.3 swaps the halves
  const hn::Half<D16> half;
  return hn::Combine(d16, hn::DemoteTo(half, high), hn::DemoteTo(half, low));
#else
  return hn::ReorderDemote2To(d16, low, high);
#endif
}

#endif

// Loads bytes as lanes of 16 or 32 bits.
template <class D>
HWY_INLINE hn::Vec<D> LoadBytes(D d, const uint8_t* at) {
  return hn::PromoteTo(d, hn::LoadU(hn::Rebind<uint8_t, D>(), at));
}

// Stores signed lanes of 16 or 32 bits as bytes, clamped to [0, 255].
template <class D>
HWY_INLINE void StoreBytes(D d, hn::Vec<D> values, uint8_t* at) {
  const hn::Rebind<uint8_t, D> d8;
  (void)d;
  hn::StoreU(hn::DemoteTo(d8, values), d8, at);
}

// Returns reference::ColourDistance of the pixels at `a` and `b`, or 255 if it is larger.
template <class D8>
HWY_INLINE hn::Vec<D8> ColourDistance(D8 d8, const uint8_t* a, const uint8_t* b, size_t plane) {
  const auto apart = [=](size_t at) HWY_ATTR {
    const auto of_a = hn::LoadU(d8, a + at), of_b = hn::LoadU(d8, b + at);
    return hn::Or(hn::SaturatedSub(of_a, of_b), hn::SaturatedSub(of_b, of_a));
  };
  return hn::SaturatedAdd(hn::SaturatedAdd(apart(0), apart(plane)), apart(2 * plane));
}

// Rows whose length is not a whole number of vectors are handled in one of three ways:
// - Rows that are padded to whole groups of kSliceLanes by contract have no remainder.
// - All other kernels store with ForVectors. The last vector overlaps the previous vector and
// stores
//   equal values again. If there are fewer samples than lanes, the kernel calls its reference. Only
//   Blend stores a part of a vector, because most spans of Blend are short.
// - Kernels that add to accumulators must add each sample once. These kernels mask the last vector
//   (`AddSpan` in gather-inl.h).

// Calls step(n) for each vector of `count` samples. The last vector ends at the last sample and may
// overlap the previous vector. If there are fewer samples than lanes, returns false without calling
// step.
template <class Step>
HWY_INLINE bool ForVectors(size_t count, size_t lanes, const Step& step) {
  if (count < lanes) return false;
  for (size_t n = 0; n < count - lanes; n += lanes) step(n);
  step(count - lanes);
  return true;
}

// Splits pixels into planes of R, G and B, `plane` samples apart. If there are fewer pixels than
// lanes, returns false and writes nothing.
template <class D, class T = hn::TFromD<D>>
HWY_INLINE bool SplitColours(D d, const T* HWY_RESTRICT rgb, size_t count, size_t plane,
                             T* HWY_RESTRICT out) {
  return ForVectors(count, hn::Lanes(d), [&](size_t n) HWY_ATTR {
    hn::Vec<D> r, g, b;
    hn::LoadInterleaved3(d, rgb + 3 * n, r, g, b);
    hn::StoreU(r, d, out + n);
    hn::StoreU(g, d, out + plane + n);
    hn::StoreU(b, d, out + 2 * plane + n);
  });
}

// A vector holds at most one group, because rows are padded to whole groups only, and because the
// bits of a mask belong to one group.
using LanesTag = hn::CappedTag<int16_t, kSliceLanes>;
using LanesVec = hn::Vec<LanesTag>;

// Returns the mask of a full vector as an integer. Bit k is set if lane k of the mask is true.
template <class D>
HWY_INLINE uint32_t BitsOf(D d, hn::Mask<D> mask) {
#if HWY_ARCH_WASM && HWY_TARGET != HWY_SCALAR
  // Highway 1.0.3 computes the bits with scalar code.
  (void)d;
  return static_cast<uint32_t>(sizeof(hn::TFromD<D>) == 1 ? wasm_i8x16_bitmask(mask.raw)
                                                          : wasm_i16x8_bitmask(mask.raw));
#else
  uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, mask, bytes);
  return uint32_t{bytes[0]} | uint32_t{bytes[1]} << 8;
#endif
}

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();

#endif
