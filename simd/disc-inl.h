// SPDX-License-Identifier: Apache-2.0
// Vector code of disc.h. Included once per target.
#if defined(STARFOCUS_SIMD_DISC_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STARFOCUS_SIMD_DISC_INL_H_
#undef STARFOCUS_SIMD_DISC_INL_H_
#else
#define STARFOCUS_SIMD_DISC_INL_H_
#endif

#include <cstring>

#include "simd/compat-inl.h"
#include "simd/disc.h"
#include "simd/light-inl.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

// DiscPairs holds a quarter of the disc, row by row, in pairs of columns that are multiplied
// together. A weight is that of all pixels that mirror each other there.
struct DiscPairs {
  struct Pair {
    uint16_t first, second;
  };
  Pair pairs[(kMaxDisc + 1) * (kMaxDisc / 2 + 1)];
  int32_t counts[kMaxDisc + 1];  // of the pairs of each row

  // Holds the weights of `disc`, and zeros where only `other` has some, so that both discs' pairs
  // are multiplied with the same samples.
  DiscPairs(const Disc& disc, const Disc& other) {
    Pair* pair = pairs;
    for (int32_t y = 0; y <= disc.size || y <= other.size; ++y) {
      const int32_t last = LastOf(disc, y), own = PairsUpTo(last);
      const int32_t others = PairsUpTo(LastOf(other, y));
      counts[y] = own > others ? own : others;
      for (int32_t x = 0; x <= last; x += 2) {
        *pair++ = {Weight(disc, x, y), Weight(disc, x + 1, y)};
      }
      for (int32_t k = own; k < others; ++k) *pair++ = {0, 0};
    }
  }

 private:
  // The weight at column x of row y of the disc, with those of the pixels that mirror it.
  static uint16_t Weight(const Disc& disc, int32_t x, int32_t y) {
    if (x > disc.size) return 0;
    const int32_t high = x > y ? x : y, low = x > y ? y : x;
    const int bits = (x > 0 ? 1 : 0) + (y > 0 ? 1 : 0);
    return static_cast<uint16_t>(disc.weights[high * (high + 1) / 2 + low] << bits);
  }

  // The last column of a row with a weight, -1 if there is none.
  static int32_t LastOf(const Disc& disc, int32_t y) {
    int32_t last = y > disc.size ? -1 : disc.size;
    while (last >= 0 && Weight(disc, last, y) == 0) --last;
    return last;
  }

  static int32_t PairsUpTo(int32_t last) { return last / 2 + (last >= 0); }
};

inline constexpr size_t kDiscChunk = 192;  // samples filtered together
inline constexpr size_t kDiscMargin = 3 * kMaxDisc;

// Stores the means of two rows that the disc weighs alike; the middle row comes alone.
HWY_INLINE void AverageRows(const int16_t* above, const int16_t* below, size_t count,
                            uint16_t* HWY_RESTRICT means) {
  if (above == below) {
    std::memcpy(means, above, count * sizeof(*means));
    return;
  }
  const hn::ScalableTag<uint16_t> d16;
  const hn::RebindToSigned<decltype(d16)> di16;
  for (size_t n = 0; n < count; n += hn::Lanes(d16)) {
    hn::StoreU(hn::AverageRound(hn::BitCast(d16, hn::LoadU(di16, above + n)),
                                hn::BitCast(d16, hn::LoadU(di16, below + n))),
               d16, means + n);
  }
}

// AddDiscRow adds a row of the disc to the accumulators, and with kTwo the same row of a second
// disc to its own; `means` are those of AverageRows. FinishDisc makes light of accumulators,
// divided by 2^bits and times 2^whole.
#if STARFOCUS_HAVE_PAIR_MULTIPLY

// Accumulators stand in the order in which pairs of 16 bits are interleaved; FinishDisc knows it.
template <bool kTwo>
HWY_INLINE void AddDiscRow(const DiscPairs::Pair* pairs, const DiscPairs::Pair* second_pairs,
                           int32_t pair_count, const uint16_t* HWY_RESTRICT means, size_t count,
                           uint32_t* HWY_RESTRICT accumulators, uint32_t* HWY_RESTRICT seconds) {
  const hn::ScalableTag<uint16_t> d16;
  const hn::RebindToSigned<decltype(d16)> di16;
  const hn::Repartition<uint32_t, decltype(d16)> d32;
  const hn::RebindToSigned<decltype(d32)> di32;
  const size_t lanes = hn::Lanes(d16);
  const auto load = [&](const uint32_t* from)
                        HWY_ATTR { return hn::BitCast(di32, hn::LoadU(d32, from)); };
  const auto weights_of = [&](const DiscPairs::Pair& pair) HWY_ATTR {
    return hn::BitCast(di16, hn::Set(d32, pair.first | uint32_t{pair.second} << 16));
  };
  for (size_t n = 0; n < count; n += lanes) {
    const uint16_t* at = means + n;
    auto low = load(accumulators + n), high = load(accumulators + n + lanes / 2);
    auto second_low = hn::Zero(di32), second_high = second_low, unused = second_low;
    if (kTwo) {
      second_low = load(seconds + n);
      second_high = load(seconds + n + lanes / 2);
    }
    for (ptrdiff_t k = 0; k < pair_count; ++k) {
      const ptrdiff_t x = 6 * k;
      auto first = hn::LoadU(d16, at + x);
      if (k > 0) first = hn::AverageRound(first, hn::LoadU(d16, at - x));
      const auto second = hn::AverageRound(hn::LoadU(d16, at + x + 3), hn::LoadU(d16, at - x - 3));
      const auto lower = hn::BitCast(di16, hn::InterleaveLower(d16, first, second));
      const auto upper = hn::BitCast(di16, hn::InterleaveUpper(d16, first, second));
      const auto weights = weights_of(pairs[k]);
      low = hn::ReorderWidenMulAccumulate(di32, lower, weights, low, unused);
      high = hn::ReorderWidenMulAccumulate(di32, upper, weights, high, unused);
      if (kTwo) {
        const auto others = weights_of(second_pairs[k]);
        second_low = hn::ReorderWidenMulAccumulate(di32, lower, others, second_low, unused);
        second_high = hn::ReorderWidenMulAccumulate(di32, upper, others, second_high, unused);
      }
    }
    hn::StoreU(hn::BitCast(d32, low), d32, accumulators + n);
    hn::StoreU(hn::BitCast(d32, high), d32, accumulators + n + lanes / 2);
    if (kTwo) {
      hn::StoreU(hn::BitCast(d32, second_low), d32, seconds + n);
      hn::StoreU(hn::BitCast(d32, second_high), d32, seconds + n + lanes / 2);
    }
  }
}

HWY_INLINE void FinishDisc(const uint32_t* HWY_RESTRICT accumulators, size_t count, int bits,
                           int whole, int16_t* HWY_RESTRICT light) {
  const hn::ScalableTag<uint32_t> d32;
  const hn::RebindToSigned<decltype(d32)> di32;
  const hn::Repartition<int16_t, decltype(d32)> d16;
  const size_t lanes = hn::Lanes(d16);
  const auto half = hn::Set(d32, uint32_t{1} << (bits - 1));
  const auto value = [&](const uint32_t* sums) HWY_ATTR {
    return hn::BitCast(di32, hn::ShiftRightSame(hn::Add(hn::LoadU(d32, sums), half), bits));
  };
  for (size_t n = 0; n < count; n += lanes) {
    const auto both =
        hn::ReorderDemote2To(d16, value(accumulators + n), value(accumulators + n + lanes / 2));
    hn::StoreU(hn::ShiftLeftSame(both, whole), d16, light + n);
  }
}

#else

template <bool kTwo>
HWY_INLINE void AddDiscRow(const DiscPairs::Pair* pairs, const DiscPairs::Pair* second_pairs,
                           int32_t pair_count, const uint16_t* HWY_RESTRICT means, size_t count,
                           uint32_t* HWY_RESTRICT accumulators, uint32_t* HWY_RESTRICT seconds) {
  const hn::ScalableTag<uint32_t> d32;
  const hn::Rebind<uint16_t, decltype(d32)> d16;
  const size_t lanes = hn::Lanes(d32);
  const auto both = [&](const uint16_t* at, ptrdiff_t x) HWY_ATTR {
    return hn::PromoteTo(d32, hn::AverageRound(hn::LoadU(d16, at - x), hn::LoadU(d16, at + x)));
  };
  const auto weigh = [&](auto first, auto second, const DiscPairs::Pair& pair) HWY_ATTR {
    return WeighPair(d32, first, second, hn::Set(d32, pair.first), hn::Set(d32, pair.second));
  };
  for (size_t n = 0; n < count; n += lanes) {
    const uint16_t* at = means + n;
    const auto middle = hn::PromoteTo(d32, hn::LoadU(d16, at)), beside = both(at, 3);
    auto sum = hn::Add(hn::LoadU(d32, accumulators + n), weigh(middle, beside, pairs[0]));
    auto second_sum = hn::Zero(d32);
    if (kTwo) {
      second_sum = hn::Add(hn::LoadU(d32, seconds + n), weigh(middle, beside, second_pairs[0]));
    }
    for (ptrdiff_t k = 1; k < pair_count; ++k) {
      const auto first = both(at, 6 * k), second = both(at, 6 * k + 3);
      sum = hn::Add(sum, weigh(first, second, pairs[k]));
      if (kTwo) second_sum = hn::Add(second_sum, weigh(first, second, second_pairs[k]));
    }
    hn::StoreU(sum, d32, accumulators + n);
    if (kTwo) hn::StoreU(second_sum, d32, seconds + n);
  }
}

HWY_INLINE void FinishDisc(const uint32_t* HWY_RESTRICT accumulators, size_t count, int bits,
                           int whole, int16_t* HWY_RESTRICT light) {
  const hn::ScalableTag<uint32_t> d32;
  const hn::RebindToSigned<decltype(d32)> di32;
  const hn::Rebind<int16_t, decltype(d32)> d16;
  const auto half = hn::Set(d32, uint32_t{1} << (bits - 1));
  for (size_t n = 0; n < count; n += hn::Lanes(d32)) {
    const auto sum = hn::Add(hn::LoadU(d32, accumulators + n), half);
    const auto value = hn::ShiftLeftSame(hn::ShiftRightSame(sum, bits), whole);
    hn::StoreU(hn::DemoteTo(d16, hn::BitCast(di32, value)), d16, light + n);
  }
}

#endif

// What becomes of the sums of a disc, divided by 2^bits and times 2^whole: codes, or samples of a
// layer where these are null.
struct DiscOutput {
  uint8_t* codes;
  int16_t* samples;
  size_t stride;
  Encoding encoding;
  int bits, whole;
};

inline DiscOutput SamplesOf(const Disc& disc, int16_t* samples, size_t stride) {
  return {nullptr, samples, stride, {nullptr, nullptr}, disc.bits + kLightBits - kLayerBits, 0};
}

// Stores the sums of `count` samples at that place.
HWY_INLINE void StoreDisc(const uint32_t* sums, size_t count, const DiscOutput& out, size_t at) {
  int16_t light[kDiscChunk + HWY_MAX_BYTES];
  FinishDisc(sums, count, out.bits, out.whole, light);
  if (out.codes == nullptr) {
    std::memcpy(out.samples + at, light, count * sizeof(*light));
  } else {
    Encode(light, count, out.encoding, out.codes + at);
  }
}

// Filters rows of samples by chunks, with kTwo by a second, smaller disc as well.
template <bool kTwo>
inline void FilterRows(const int16_t* in, size_t in_stride, const Disc& disc, const Disc& smaller,
                       size_t rows, size_t count, const DiscOutput& out,
                       const DiscOutput& second_out) {
  constexpr size_t kSpare = HWY_MAX_BYTES;
  const Disc none = {-1, 0, nullptr};
  const DiscPairs quarter(disc, kTwo ? smaller : none);
  const DiscPairs second(kTwo ? smaller : none, kTwo ? disc : none);
  const size_t margin = 3 * static_cast<size_t>(disc.size);
  // The second column of a pair may lie a pixel beyond the disc. Its weight is zero, but it is
  // read.
  uint16_t padded[3 + kDiscChunk + 2 * kDiscMargin + 3 + kSpare] = {};
  uint16_t* const means = padded + 3;
  uint32_t accumulators[kDiscChunk + kSpare], seconds[kTwo ? kDiscChunk + kSpare : 1];
  for (size_t begin = 0; begin < count; begin += kDiscChunk) {
    const size_t chunk = count - begin < kDiscChunk ? count - begin : kDiscChunk;
    for (size_t row = 0; row < rows; ++row) {
      const int16_t* middle = in + row * in_stride + begin;
      const DiscPairs::Pair *pairs = quarter.pairs, *second_pairs = second.pairs;
      std::memset(accumulators, 0, (chunk + kSpare) * sizeof(*accumulators));
      if (kTwo) std::memset(seconds, 0, (chunk + kSpare) * sizeof(*seconds));
      for (int32_t y = 0; y <= disc.size; ++y) {
        const int32_t pair_count = quarter.counts[y];
        if (pair_count == 0) continue;
        const ptrdiff_t offset = y * static_cast<ptrdiff_t>(in_stride);
        AverageRows(middle - offset - margin, middle + offset - margin, chunk + 2 * margin, means);
        std::memset(means + chunk + 2 * margin, 0, 3 * sizeof(*means));
        AddDiscRow<kTwo>(pairs, second_pairs, pair_count, means + margin, chunk, accumulators,
                         seconds);
        pairs += pair_count;
        second_pairs += pair_count;
      }
      StoreDisc(accumulators, chunk, out, row * out.stride + begin);
      if (kTwo) StoreDisc(seconds, chunk, second_out, row * second_out.stride + begin);
    }
  }
}

inline void FilterDisc(const int16_t* HWY_RESTRICT in, size_t in_stride, const Disc& disc,
                       const Encoding& encoding, size_t rows, size_t count,
                       uint8_t* HWY_RESTRICT out, size_t out_stride) {
  const int whole = encoding.entries == nullptr ? kLightBits : 0;  // bits of light that are none
  const DiscOutput codes = {out, nullptr, out_stride, encoding, disc.bits + whole, whole};
  FilterRows<false>(in, in_stride, disc, disc, rows, count, codes, codes);
}

inline void FilterDiscLayer(const int16_t* HWY_RESTRICT in, size_t in_stride, const Disc& disc,
                            size_t rows, size_t count, int16_t* HWY_RESTRICT out,
                            size_t out_stride) {
  const DiscOutput samples = SamplesOf(disc, out, out_stride);
  FilterRows<false>(in, in_stride, disc, disc, rows, count, samples, samples);
}

inline void FilterTwoDiscs(const int16_t* HWY_RESTRICT in, size_t in_stride, const Disc& less,
                           const Disc& more, size_t rows, size_t count,
                           int16_t* HWY_RESTRICT out_less, int16_t* HWY_RESTRICT out_more,
                           size_t out_stride) {
  const DiscOutput first = SamplesOf(more, out_more, out_stride);
  const DiscOutput second = SamplesOf(less, out_less, out_stride);
  FilterRows<true>(in, in_stride, more, less, rows, count, first, second);
}

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();

#endif
