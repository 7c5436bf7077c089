// SPDX-License-Identifier: Apache-2.0
// Vector code of the functions in motion.h. This file is included once per SIMD target.
#include "simd/highway-inl.h"
#include "simd/motion.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR
using reference::CompareSquares;
using reference::FollowBlock;
using reference::LimitBlock;
#else

using MotionBytes = hn::FixedTag<uint8_t, 16>;
using MotionHalf = hn::FixedTag<uint8_t, 8>;
using MotionLanes = hn::FixedTag<uint16_t, 8>;
using MotionVec = hn::Vec<MotionLanes>;

template <class D>
HWY_INLINE hn::Vec<D> Apart(D d, const uint8_t* a, const uint8_t* b) {
  const auto of_a = hn::LoadU(d, a), of_b = hn::LoadU(d, b);
  return hn::Or(hn::SaturatedSub(of_a, of_b), hn::SaturatedSub(of_b, of_a));
}

inline uint32_t CompareSquares(const uint8_t* HWY_RESTRICT a, const uint8_t* HWY_RESTRICT b,
                               size_t stride) {
  const MotionBytes d8;
  const hn::Repartition<uint64_t, MotionBytes> d64;
  auto sum = hn::Zero(d64);
  for (size_t y = 0; y < kCompared; ++y, a += stride, b += stride) {
    sum = hn::Add(sum, hn::SumsOf8(Apart(d8, a, b)));
  }
  return static_cast<uint32_t>(hn::GetLane(hn::SumOfLanes(d64, sum)));
}

// Rows of sums of bytes: those of 8 pixels and of one pixel on each side.
constexpr size_t kMotionSums = 32;

// Adds three neighbouring elements of `sums` for each of 24 elements, `step` apart: the sums over
// the colours of a pixel with step 1, or over three pixels with step 3.
HWY_INLINE void AddThree(size_t step, const uint16_t* HWY_RESTRICT sums, uint16_t* HWY_RESTRICT out,
                         size_t count) {
  const MotionLanes d16;
  for (size_t n = 0; n < count; n += 8) {
    const auto first = hn::LoadU(d16, sums + n), second = hn::LoadU(d16, sums + n + step);
    hn::StoreU(hn::Add(hn::Add(first, second), hn::LoadU(d16, sums + n + 2 * step)), d16, out + n);
  }
}

// Returns every third of 24 elements.
HWY_INLINE MotionVec EveryThird(const uint16_t* sums) {
  MotionVec first, second, third;
  hn::LoadInterleaved3(MotionLanes(), sums, first, second, third);
  return first;
}

// Returns the differences of 8 bytes as 16-bit lanes.
HWY_INLINE MotionVec WideApart(const uint8_t* a, const uint8_t* b) {
  return hn::PromoteTo(MotionLanes(), Apart(MotionHalf(), a, b));
}

inline void LimitBlock(const uint8_t* HWY_RESTRICT rgb, size_t stride, uint16_t base,
                       uint16_t* HWY_RESTRICT limits) {
  const MotionLanes d16;
  for (size_t y = 0; y < kFollowed; ++y, rgb += stride, limits += kFollowed) {
    uint16_t sums[kMotionSums] = {}, pixels[24];
    for (size_t n = 0; n < 24; n += 8) {
      const uint8_t* const at = rgb + n;
      hn::StoreU(hn::Add(WideApart(at - 3, at + 3), WideApart(at - stride, at + stride)), d16,
                 sums + n);
    }
    AddThree(1, sums, pixels, 24);
    const auto sum = EveryThird(pixels);
    hn::StoreU(hn::Add(hn::Set(d16, base), hn::Add(sum, sum)), d16, limits);
  }
}

inline void FollowBlock(const FollowedBlock& block, const uint16_t* HWY_RESTRICT limits,
                        uint16_t choice, uint16_t* HWY_RESTRICT costs,
                        uint16_t* HWY_RESTRICT choices) {
  const MotionLanes d16;
  const hn::RebindToSigned<MotionLanes> di16;
  // Differences of the bytes of three rows, from that above the block on.
  uint16_t rows[3][kMotionSums] = {};
  const auto read = [&](size_t row) HWY_ATTR {
    const uint8_t* const now = block.now + row * block.stride - block.stride - 3;
    const uint8_t* const before = block.before + row * block.stride - block.stride - 3;
    // Of 30 bytes, the last 8 overlap those before.
    for (const size_t k : {0, 8, 16, 22}) {
      hn::StoreU(WideApart(now + k, before + k), d16, rows[row % 3] + k);
    }
  };
  read(0);
  read(1);
  for (size_t y = 0; y < kFollowed; ++y) {
    read(y + 2);
    uint16_t sums[kMotionSums], pixels[kMotionSums] = {}, squares[24];
    for (size_t k = 0; k < kMotionSums; k += 8) {
      const auto upper = hn::Add(hn::LoadU(d16, rows[0] + k), hn::LoadU(d16, rows[1] + k));
      hn::StoreU(hn::Add(upper, hn::LoadU(d16, rows[2] + k)), d16, sums + k);
    }
    AddThree(1, sums, pixels, 24);
    pixels[24] = static_cast<uint16_t>(sums[24] + sums[25] + sums[26]);
    pixels[27] = static_cast<uint16_t>(sums[27] + sums[28] + sums[29]);
    AddThree(3, pixels, squares, 24);
    const auto colour = EveryThird(squares);
    const auto given = hn::LoadU(di16, block.given + y * block.given_stride);
    const auto known = hn::LoadU(di16, block.known + y * block.known_stride);
    const auto apart = hn::Max(hn::SaturatedSub(given, known), hn::SaturatedSub(known, given));
    const auto step = hn::BitCast(d16, hn::Min(apart, hn::Set(di16, int16_t{kMostStep})));
    const auto cost = hn::Add(colour, step);
    // Costs are below 2^15, except those of pixels without one.
    const size_t n = kFollowed * y;
    const auto least = hn::LoadU(d16, costs + n);
    const auto worse = hn::Or(hn::SaturatedSub(colour, hn::LoadU(d16, limits + n)),
                              hn::SaturatedSub(hn::Add(cost, hn::Set(d16, uint16_t{1})), least));
    const auto better = hn::Eq(worse, hn::Zero(d16));
    hn::StoreU(hn::IfThenElse(better, cost, least), d16, costs + n);
    hn::StoreU(hn::IfThenElse(better, hn::Set(d16, choice), hn::LoadU(d16, choices + n)), d16,
               choices + n);
  }
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();
