// SPDX-License-Identifier: Apache-2.0
// Vector code of the functions in gather.h. This file is included once per SIMD target.
#include <cstring>

#include "simd/gather.h"
#include "simd/highway-inl.h"
#include "simd/light-inl.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

inline constexpr size_t kDiscChunk = 192;  // number of samples that are filtered together
inline constexpr size_t kDiscBorder = 3 * kMaxDisc;

// Computes the means of two rows of samples to which the disc filter applies equal weights. The
// middle row has no counterpart and is copied.
HWY_INLINE void AverageRows(const int16_t* above, const int16_t* below, size_t count,
                            uint16_t* HWY_RESTRICT means) {
  if (above == below) {
    std::memcpy(means, above, count * sizeof(*means));
    return;
  }
  const hn::ScalableTag<uint16_t> d16;
  const hn::RebindToSigned<decltype(d16)> di16;
  const auto average = [&](size_t n) HWY_ATTR {
    hn::StoreU(hn::AverageRound(hn::BitCast(d16, hn::LoadU(di16, above + n)),
                                hn::BitCast(d16, hn::LoadU(di16, below + n))),
               d16, means + n);
  };
  const size_t lanes = hn::Lanes(d16);
  size_t n = 0;
  for (; n + lanes < count; n += 2 * lanes) {
    average(n);
    average(n + lanes);
  }
  if (n < count) average(n);
}

// Means of pairs of rows to which the disc filter applies equal weights. Row y contains the means
// of two rows: y rows above and y rows below the middle row. If the second column of a pair of
// columns lies beyond the disc, the column is read with weight zero, so each row has spare samples
// at both ends.
struct DiscMeans {
  static constexpr size_t kPixel = 3, kTap = 2 * kPixel, kSpare = HWY_MAX_BYTES;
  static constexpr size_t kStride = kTap + kDiscChunk + 2 * kDiscBorder + kTap + kSpare;
  uint16_t rows[(kMaxDisc + 1) * kStride];

  // Fills `row_count` rows for `count` samples from `middle` on, plus the reach of the disc on both
  // sides.
  void Fill(const int16_t* middle, size_t in_stride, const Disc& disc, int32_t row_count,
            size_t count) {
    const size_t border = Border(disc), all = count + 2 * border;
    for (int32_t y = 0; y < row_count; ++y) {
      const ptrdiff_t offset = y * static_cast<ptrdiff_t>(in_stride);
      uint16_t* row = rows + static_cast<size_t>(y) * kStride;
      std::memset(row, 0, kTap * sizeof(*row));
      AverageRows(middle - offset - border, middle + offset - border, all, row + kTap);
      std::memset(row + kTap + all, 0, kTap * sizeof(*row));
    }
  }

  // Returns a pointer to the first of the `count` samples in row 0.
  const uint16_t* First(const Disc& disc) const { return rows + kTap + Border(disc); }

  static size_t Border(const Disc& disc) { return kPixel * static_cast<size_t>(disc.size); }
};

// Filter coefficients (taps) of a quarter of one disc or of two discs. Each `Tap` contains the
// weights of two adjacent columns. Each weight is the sum of the weights of all pixels that mirror
// each other.
struct DiscTaps {
  struct Tap {
    uint16_t weights[2], second_weights[2];
    // Distances in DiscMeans of the first column and of its mirror image from those of the previous
    // tap. The first tap has the middle column.
    int32_t right, left;
  };
  Tap taps[(kMaxDisc + 1) * (kMaxDisc / 2 + 1)];
  size_t count = 0;
  int32_t rows = 0;  // number of rows of the quarter, up to the last row with a nonzero weight
  // The sums of a disc are divided by 2^bits and multiplied by 2^whole.
  const int bits, second_bits, whole;

  // Creates a `Tap` for each pair of columns in which either disc has a nonzero weight. Rounding
  // removes the `dropped` lowest bits of the light.
  DiscTaps(const Disc& disc, const Disc& second, int dropped, int restored)
      : bits(disc.bits + dropped), second_bits(second.bits + dropped), whole(restored) {
    constexpr auto kRow = static_cast<int32_t>(DiscMeans::kStride);
    constexpr auto kTap = static_cast<int32_t>(DiscMeans::kTap);
    int32_t right = 0, left = 0;  // distances to the next tap
    for (int32_t y = 0; y <= disc.size || y <= second.size; ++y) {
      uint16_t weights[kColumns] = {}, second_weights[kColumns] = {};
      const int32_t columns = LoadRow(disc, y, weights);
      const int32_t second_columns = LoadRow(second, y, second_weights);
      const int32_t most = columns > second_columns ? columns : second_columns;
      if (most > 0) rows = y + 1;
      for (int32_t x = 0; x < most; x += 2) {
        taps[count++] = {
            {weights[x], weights[x + 1]}, {second_weights[x], second_weights[x + 1]}, right, left};
        right = kTap;
        left = -kTap;
      }
      // The next tap is in the middle column of the next row.
      const int32_t back = most > 0 ? (most - 1) / 2 * kTap : 0;
      right = (most > 0 ? 0 : right) + kRow - back;
      left = (most > 0 ? 0 : left) + kRow + back;
    }
  }

 private:
  static constexpr size_t kColumns = kMaxDisc + 2;

  // Loads row y of a disc: the weight of each pixel plus the weights of the pixel's mirror images
  // about both axes. Returns the number of columns up to the last nonzero weight.
  static int32_t LoadRow(const Disc& disc, int32_t y, uint16_t* weights) {
    if (y > disc.size) return 0;
    int32_t columns = 0;
    // In Disc::weights, the weights of a row are contiguous up to the diagonal. Beyond the
    // diagonal, adjacent weights are as far apart as the octant's rows are long.
    const uint16_t* weight = disc.weights + y * (y + 1) / 2;
    for (int32_t x = 0; x <= disc.size; ++x) {
      weights[x] = static_cast<uint16_t>(*weight << ((x > 0 ? 1 : 0) + (y > 0 ? 1 : 0)));
      if (*weight != 0) columns = x + 1;
      weight += x < y ? 1 : x + 1;
    }
    return columns;
  }
};

// Filters `count` samples with a disc: multiplies the means by the weights of the disc and adds the
// products. If kTwo is true, also computes sums weighted by a second disc. `light` and
// `second_light` need spare room, because vectors write past the last sample.
#if HWY_TARGET == HWY_SCALAR

template <bool kTwo>
inline void FilterMeans(const DiscTaps& disc, const uint16_t* HWY_RESTRICT means, size_t count,
                        int16_t* HWY_RESTRICT light, int16_t* HWY_RESTRICT second_light) {
  constexpr ptrdiff_t kPixel = DiscMeans::kPixel;
  const auto finish = [&](uint32_t sum, int bits) {
    return static_cast<int16_t>((sum + (uint32_t{1} << (bits - 1))) >> bits << disc.whole);
  };
  for (size_t n = 0; n < count; ++n) {
    const uint16_t *right = means + n, *left = right;
    uint32_t sum = 0, second_sum = 0;
    for (size_t k = 0; k < disc.count; ++k) {
      const DiscTaps::Tap& tap = disc.taps[k];
      right += tap.right;
      left += tap.left;
      const uint32_t first = (right[0] + left[0] + uint32_t{1}) >> 1;
      const uint32_t next = (right[kPixel] + left[-kPixel] + uint32_t{1}) >> 1;
      sum += first * tap.weights[0] + next * tap.weights[1];
      if (kTwo) second_sum += first * tap.second_weights[0] + next * tap.second_weights[1];
    }
    light[n] = finish(sum, disc.bits);
    if (kTwo) second_light[n] = finish(second_sum, disc.second_bits);
  }
}

#else

using MeansTag = hn::ScalableTag<uint16_t>;
using LightTag = hn::RebindToSigned<MeansTag>;
// The sums of the products of a vector of means occupy two vectors, which DemoteSums joins.
using SumsTag = hn::Repartition<int32_t, LightTag>;

// Returns the means of the samples on the right and on the left, which mirror each other.
HWY_INLINE hn::Vec<LightTag> MeansOf(const uint16_t* right, const uint16_t* left) {
  const MeansTag d16;
  return hn::BitCast(LightTag(), hn::AverageRound(hn::LoadU(d16, right), hn::LoadU(d16, left)));
}

// Multiplies two vectors of means by two weights and adds the products to the sums.
HWY_INLINE void AddMeans(hn::Vec<LightTag> first, hn::Vec<LightTag> second, const uint16_t* weights,
                         hn::Vec<SumsTag>& low, hn::Vec<SumsTag>& high) {
  AddWeighed(first, second, weights[0], weights[1], low, high);
}

HWY_INLINE void StoreSums(hn::Vec<SumsTag> low, hn::Vec<SumsTag> high, int bits, int whole,
                          int16_t* light) {
  const hn::RebindToUnsigned<SumsTag> d32;
  const auto half = hn::Set(d32, uint32_t{1} << (bits - 1));
  const auto value = [&](hn::Vec<SumsTag> sums) HWY_ATTR {
    const auto sum = hn::Add(hn::BitCast(d32, sums), half);
    return hn::BitCast(SumsTag(), hn::ShiftRightSame(sum, bits));
  };
  const auto both = DemoteSums(LightTag(), value(low), value(high));
  hn::StoreU(hn::ShiftLeftSame(both, whole), LightTag(), light);
}

// Largest numbers of adjacent vectors of means that FilterMeans filters together with one disc and
// with two discs. These vectors share loads of offsets and weights. With more vectors, the filter
// takes fewer instructions on AArch64, which has 32 vector registers, but spills registers on SSE4.
#if HWY_ARCH_ARM_A64 && !HWY_HAVE_SCALABLE
inline constexpr size_t kMeansVectors = 4, kTwoDiscsVectors = 2;
#else
inline constexpr size_t kMeansVectors = 2, kTwoDiscsVectors = 1;
#endif

// Filters kVectors adjacent vectors of means. If kTwo is true, kVectors is at most 2. The function
// is not inlined, to keep WebAssembly modules small.
template <size_t kVectors, bool kTwo>
HWY_NOINLINE void FilterVectors(const DiscTaps& disc, const uint16_t* HWY_RESTRICT means,
                                int16_t* HWY_RESTRICT light, int16_t* HWY_RESTRICT second_light) {
  const size_t lanes = hn::Lanes(MeansTag());
  constexpr ptrdiff_t kPixel = DiscMeans::kPixel;
  // Sums of four vectors. If kTwo is true, sums 2 and 3 are sums of the second disc.
  auto low0 = hn::Zero(SumsTag()), low1 = low0, low2 = low0, low3 = low0;
  auto high0 = low0, high1 = low0, high2 = low0, high3 = low0;
  const uint16_t *right = means, *left = means;
  for (size_t k = 0; k < disc.count; ++k) {
    const DiscTaps::Tap& tap = disc.taps[k];
    right += tap.right;
    left += tap.left;
    const auto add = [&](size_t n, auto& low, auto& high, auto& second_low, auto& second_high)
                         HWY_ATTR {
                           const auto first = MeansOf(right + n, left + n);
                           const auto next = MeansOf(right + n + kPixel, left + n - kPixel);
                           AddMeans(first, next, tap.weights, low, high);
                           if (kTwo)
                             AddMeans(first, next, tap.second_weights, second_low, second_high);
                         };
    add(0, low0, high0, low2, high2);
    if (kVectors > 1) add(lanes, low1, high1, low3, high3);
    if (kVectors > 2) {
      add(2 * lanes, low2, high2, low2, high2);
      add(3 * lanes, low3, high3, low3, high3);
    }
  }
  StoreSums(low0, high0, disc.bits, disc.whole, light);
  if (kVectors > 1) StoreSums(low1, high1, disc.bits, disc.whole, light + lanes);
  if (kTwo) {
    StoreSums(low2, high2, disc.second_bits, disc.whole, second_light);
    if (kVectors > 1) StoreSums(low3, high3, disc.second_bits, disc.whole, second_light + lanes);
  } else if (kVectors > 2) {
    StoreSums(low2, high2, disc.bits, disc.whole, light + 2 * lanes);
    StoreSums(low3, high3, disc.bits, disc.whole, light + 3 * lanes);
  }
}

template <bool kTwo>
inline void FilterMeans(const DiscTaps& disc, const uint16_t* HWY_RESTRICT means, size_t count,
                        int16_t* HWY_RESTRICT light, int16_t* HWY_RESTRICT second_light) {
  constexpr size_t kMost = kTwo ? kTwoDiscsVectors : kMeansVectors;
  // Three vectors are filtered as four, which takes as many instructions as two and one.
  constexpr size_t kLeast = kMost > 2 ? 3 : kMost;
  const size_t lanes = hn::Lanes(MeansTag());
  size_t n = 0;
  const auto second = [&] { return kTwo ? second_light + n : nullptr; };
  for (; n + (kLeast - 1) * lanes < count; n += kMost * lanes) {
    FilterVectors<kMost, kTwo>(disc, means + n, light + n, second());
  }
  if (kMost > 2 && n + lanes < count) {
    FilterVectors<2, kTwo>(disc, means + n, light + n, second());
    n += 2 * lanes;
  }
  if (n < count) FilterVectors<1, kTwo>(disc, means + n, light + n, second());
}

#endif

// Filters rows of samples in chunks. If kTwo is true, also filters the rows with a second, smaller
// disc. store(light, second_light, count, row, begin) stores `count` samples of a row from sample
// `begin` on.
template <bool kTwo, class Store>
inline void FilterRows(const SampleRows& in, const Disc& disc, const Disc& smaller, int dropped,
                       int whole, const Store& store) {
  const Disc none = {-1, 0, nullptr};
  const DiscTaps taps(disc, kTwo ? smaller : none, dropped, whole);
  DiscMeans means;
  constexpr size_t kLight = kDiscChunk + HWY_MAX_BYTES;
  int16_t light[kLight], second_light[kTwo ? kLight : 1];
  for (size_t begin = 0; begin < in.count; begin += kDiscChunk) {
    const size_t chunk = in.count - begin < kDiscChunk ? in.count - begin : kDiscChunk;
    for (size_t row = 0; row < in.rows; ++row) {
      means.Fill(in.samples + row * in.stride + begin, in.stride, disc, taps.rows, chunk);
      FilterMeans<kTwo>(taps, means.First(disc), chunk, light, second_light);
      store(light, second_light, chunk, row, begin);
    }
  }
}

inline void FilterDisc(const SampleRows& in, const Disc& disc, const Encoding& encoding,
                       uint8_t* HWY_RESTRICT out, size_t out_stride) {
  // Number of fractional bits of the light that rounding removes before the light is encoded.
  const int whole = encoding.entries == nullptr ? kLightBits : 0;
  FilterRows<false>(
      in, disc, disc, whole, whole,
      [&](const int16_t* light, const int16_t*, size_t count, size_t row, size_t begin)
          HWY_ATTR { Encode(light, count, encoding, out + row * out_stride + begin); });
}

inline void FilterDiscLayer(const SampleRows& in, const Disc& disc, int16_t* HWY_RESTRICT out,
                            size_t out_stride) {
  FilterRows<false>(
      in, disc, disc, kLightBits - kLayerBits, 0,
      [&](const int16_t* light, const int16_t*, size_t count, size_t row, size_t begin) {
        std::memcpy(out + row * out_stride + begin, light, count * sizeof(*light));
      });
}

inline void FilterTwoDiscs(const SampleRows& in, const Disc& less, const Disc& more,
                           int16_t* HWY_RESTRICT out_less, int16_t* HWY_RESTRICT out_more,
                           size_t out_stride) {
  FilterRows<true>(
      in, more, less, kLightBits - kLayerBits, 0,
      [&](const int16_t* light, const int16_t* less_light, size_t count, size_t row, size_t begin) {
        const size_t at = row * out_stride + begin;
        std::memcpy(out_more + at, light, count * sizeof(*light));
        std::memcpy(out_less + at, less_light, count * sizeof(*light));
      });
}

inline void MixSamples(const int16_t* HWY_RESTRICT less, const int16_t* HWY_RESTRICT more,
                       const int16_t* HWY_RESTRICT mix, size_t count, int16_t* HWY_RESTRICT out) {
  const hn::CappedTag<int16_t, kSliceLanes> d16;
  for (size_t n = 0; n < SliceSamples(count); n += hn::Lanes(d16)) {
    const auto from = hn::LoadU(d16, less + n);
    const auto rest = hn::Sub(hn::LoadU(d16, more + n), from);
    hn::StoreU(hn::Add(from, hn::MulFixedPoint15(rest, hn::LoadU(d16, mix + n))), d16, out + n);
  }
}

inline void MoveSamples(const SampleRows& in, const HalfMove& move, int16_t* HWY_RESTRICT out,
                        size_t out_stride) {
  const size_t stride = in.stride, whole = SliceSamples(in.count);
  const hn::CappedTag<int16_t, kSliceLanes> d16;
  const auto across = hn::Set(d16, move.across), down = hn::Set(d16, move.down);
  const auto white = hn::Set(d16, kLayerWhite);
  const int16_t* HWY_RESTRICT row = in.samples;
  for (size_t y = 0; y < in.rows; ++y, row += stride, out += out_stride) {
    const auto change = [&](const int16_t* from, const int16_t* to) HWY_ATTR {
      return hn::SaturatedSub(hn::LoadU(d16, to), hn::LoadU(d16, from));
    };
    for (size_t n = 0; n < whole; n += hn::Lanes(d16)) {
      const int16_t* at = row + n;
      auto value =
          hn::SaturatedAdd(hn::LoadU(d16, at), hn::MulFixedPoint15(change(at - 3, at + 3), across));
      value = hn::SaturatedAdd(value, hn::MulFixedPoint15(change(at - stride, at + stride), down));
      hn::StoreU(hn::Min(hn::Max(value, hn::Zero(d16)), white), d16, out + n);
    }
  }
}

// Adds value(n, keep) to the accumulators of a span, one vector at a time. In the last vector,
// `keep` zeroes the samples beyond the span before the weighting. The samples beyond the span may
// be uninitialised, and valgrind treats two lanes that are multiplied and added in pairs as one
// value.
template <class D32, class Value>
HWY_INLINE void AddSpan(D32 d32, uint32_t samples, uint32_t* HWY_RESTRICT target,
                        const Value& value) {
  using V32 = hn::Vec<D32>;
  const size_t lanes = hn::Lanes(d32);
  const auto keep_all = [](V32 pixels) HWY_ATTR { return pixels; };
  size_t n = 0;
  for (; n + lanes <= samples; n += lanes) {
    hn::StoreU(hn::Add(hn::LoadU(d32, target + n), value(n, keep_all)), d32, target + n);
  }
  if (n == samples) return;
  const auto mask = hn::FirstN(d32, samples - n);
  const auto keep = [&](V32 pixels) HWY_ATTR { return hn::IfThenElseZero(mask, pixels); };
  hn::StoreU(hn::Add(hn::LoadU(d32, target + n), value(n, keep)), d32, target + n);
}

inline void Accumulate(const Span* HWY_RESTRICT spans, size_t count,
                       uint32_t* HWY_RESTRICT accumulators) {
  const hn::ScalableTag<uint32_t> d32;
  const hn::Rebind<uint16_t, decltype(d32)> d16;
  for (size_t i = 0; i < count; ++i) {
    const Span& span = spans[i];
    const auto* HWY_RESTRICT source = reinterpret_cast<const uint16_t*>(span.source);
    uint32_t* HWY_RESTRICT target = accumulators + span.target;
    const auto weight = hn::Set(d32, span.weight);
    const auto neighbour_weight = hn::Set(d32, span.neighbour_weight);
    if (span.neighbour_weight == 0) {
      AddSpan(d32, span.samples, target, [&](size_t n, const auto& keep) HWY_ATTR {
        const auto a = keep(hn::PromoteTo(d32, hn::LoadU(d16, source + n)));
        return WeighPair(d32, a, hn::Zero(d32), weight, hn::Zero(d32));
      });
    } else {
      const uint16_t* HWY_RESTRICT neighbour = source + span.neighbour_offset;
      AddSpan(d32, span.samples, target, [&](size_t n, const auto& keep) HWY_ATTR {
        const auto a = keep(hn::PromoteTo(d32, hn::LoadU(d16, source + n)));
        const auto b = keep(hn::PromoteTo(d32, hn::LoadU(d16, neighbour + n)));
        return WeighPair(d32, a, b, weight, neighbour_weight);
      });
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();
