// SPDX-License-Identifier: Apache-2.0
// Vector code of FinishComposite (composite.h). This file is included once per SIMD target.
#include "simd/composite.h"
#include "simd/highway-inl.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR

using reference::FinishComposite;

#else

using CompositeTag = hn::CappedTag<uint32_t, kSliceLanes>;
using CompositeVec = hn::Vec<CompositeTag>;

// Inverses of coverages, split into a low and a high part of 32 bits. SIMD has no integer division,
// and the coverage of most pixels is equal to the coverage of their neighbours. A new inverse is
// therefore computed only if the coverage changes.
class Inverses {
 public:
  explicit Inverses(uint32_t least) : least_(least) {}

  HWY_INLINE void Load(CompositeVec covered) {
    const CompositeTag d32;
    const bool alike = hn::AllTrue(d32, hn::Eq(covered, hn::Set(d32, covered_)));
    if (alike && alike_) return;
    alike_ = alike;
    HWY_ALIGN uint32_t lanes[kSliceLanes];
    hn::StoreU(covered, d32, lanes);
    for (size_t k = 0; k < hn::Lanes(d32); ++k) {
      if (lanes[k] != covered_) {
        covered_ = lanes[k];
        inverse_ = covered_ < least_ ? 0 : (uint64_t{1} << kInverseBits) / covered_;
      }
      low[k] = static_cast<uint32_t>(inverse_);
      high[k] = static_cast<uint32_t>(inverse_ >> 32);
    }
  }

  HWY_ALIGN uint32_t low[kSliceLanes] = {};
  HWY_ALIGN uint32_t high[kSliceLanes] = {};

 private:
  const uint32_t least_;
  bool alike_ = true;
  uint32_t covered_ = 0;
  uint64_t inverse_ = 0;
};

// Returns min((sum * inverse + half) >> shift, white) for the even lanes.
template <class V64, class VI64>
HWY_INLINE V64 DivideEven(CompositeVec sum, CompositeVec low, CompositeVec high, V64 half,
                          int shift, VI64 white) {
  const hn::DFromV<V64> d64;
  const hn::DFromV<VI64> di64;
  const auto product = hn::Add(hn::MulEven(sum, low), hn::ShiftLeft<32>(hn::MulEven(sum, high)));
  const auto value = hn::ShiftRightSame(hn::Add(product, half), shift);
  return hn::BitCast(d64, hn::Min(hn::BitCast(di64, value), white));
}

// Converts the sums of a vector of pixels to accumulators.
HWY_INLINE void FinishGroup(const uint32_t* sums, size_t plane, const int16_t* centre,
                            uint32_t least, int bits, Inverses& inverses, uint32_t* out) {
  const CompositeTag d32;
  const hn::Repartition<uint64_t, CompositeTag> d64;
  const hn::RebindToSigned<decltype(d64)> di64;
  const auto covered = hn::LoadU(d32, sums + 3 * plane);
  const auto missing = hn::Lt(covered, hn::Set(d32, least));
  inverses.Load(covered);
  const int shift = kInverseBits - 8 - bits;
  const auto half = hn::Set(d64, uint64_t{1} << (shift - 1));
  const auto white = hn::Set(di64, int64_t{255} << bits);
  const auto low = hn::Load(d32, inverses.low), high = hn::Load(d32, inverses.high);
  const auto odd = [&](CompositeVec v) HWY_ATTR {
    return hn::BitCast(d32, hn::ShiftRight<32>(hn::BitCast(d64, v)));
  };
  const auto odd_low = odd(low), odd_high = odd(high);
  const auto divide = [&](size_t c) HWY_ATTR {
    const auto sum = hn::LoadU(d32, sums + c * plane);
    const auto even = DivideEven(sum, low, high, half, shift, white);
    const auto next = DivideEven(odd(sum), odd_low, odd_high, half, shift, white);
    return hn::BitCast(d32, hn::Or(even, hn::ShiftLeft<32>(next)));
  };
  hn::StoreInterleaved3(divide(0), divide(1), divide(2), d32, out);
  if (hn::AllFalse(d32, missing)) return;
  for (size_t n = 0; n < hn::Lanes(d32); ++n) {
    if (sums[3 * plane + n] >= least) continue;
    for (size_t c = 0; c < 3; ++c)
      out[3 * n + c] = static_cast<uint32_t>(centre[3 * n + c]) << (bits - kLightBits);
  }
}

inline void FinishComposite(const uint32_t* sums, size_t plane, const int16_t* centre,
                            uint32_t least, int bits, size_t count, uint32_t* out) {
  Inverses inverses(least);
  const bool done = ForVectors(count, hn::Lanes(CompositeTag()), [&](size_t n) HWY_ATTR {
    FinishGroup(sums + n, plane, centre + 3 * n, least, bits, inverses, out + 3 * n);
  });
  if (!done) reference::FinishComposite(sums, plane, centre, least, bits, count, out);
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();
