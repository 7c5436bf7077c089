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
inline constexpr size_t kDiscMargin = 3 * kMaxDisc;

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
  for (size_t n = 0; n < count; n += hn::Lanes(d16)) {
    hn::StoreU(hn::AverageRound(hn::BitCast(d16, hn::LoadU(di16, above + n)),
                                hn::BitCast(d16, hn::LoadU(di16, below + n))),
               d16, means + n);
  }
}

// Means of pairs of rows to which the disc filter applies equal weights. Row y contains the means
// of two rows: y rows above and y rows below the middle row. If the second column of a pair of
// columns lies beyond the disc, the column is read with weight zero, so each row has spare samples
// at both ends.
struct DiscMeans {
  static constexpr size_t kPixel = 3, kTap = 2 * kPixel, kSpare = HWY_MAX_BYTES;
  static constexpr size_t kStride = kTap + kDiscChunk + 2 * kDiscMargin + kTap + kSpare;
  uint16_t rows[(kMaxDisc + 1) * kStride];

  // Fills `row_count` rows for `count` samples from `middle` on, plus the reach of the disc on both
  // sides.
  void Fill(const int16_t* middle, size_t in_stride, const Disc& disc, int32_t row_count,
            size_t count) {
    const size_t margin = Margin(disc), all = count + 2 * margin;
    for (int32_t y = 0; y < row_count; ++y) {
      const ptrdiff_t offset = y * static_cast<ptrdiff_t>(in_stride);
      uint16_t* row = rows + static_cast<size_t>(y) * kStride;
      std::memset(row, 0, kTap * sizeof(*row));
      AverageRows(middle - offset - margin, middle + offset - margin, all, row + kTap);
      std::memset(row + kTap + all, 0, kTap * sizeof(*row));
    }
  }

  // Returns a pointer to the first of the `count` samples in row 0.
  const uint16_t* First(const Disc& disc) const { return rows + kTap + Margin(disc); }

  static size_t Margin(const Disc& disc) { return kPixel * static_cast<size_t>(disc.size); }
};

// Filter coefficients (taps) of a quarter of one disc or of two discs. Each `Tap` contains the
// weights of two adjacent columns. Each weight is the sum of the weights of all pixels that mirror
// each other.
struct DiscTaps {
  struct Tap {
    uint16_t weights[2], second_weights[2];
    int32_t right, left;  // offsets in DiscMeans of the first column and of its mirror image
  };
  Tap taps[(kMaxDisc + 1) * (kMaxDisc / 2 + 1)];
  size_t count = 0;
  int32_t rows = 0;  // number of rows of the quarter, up to the last row with a nonzero weight

  // Creates a `Tap` for each pair of columns in which either disc has a nonzero weight.
  DiscTaps(const Disc& disc, const Disc& second) {
    constexpr auto kRow = static_cast<int32_t>(DiscMeans::kStride);
    constexpr auto kPixel = static_cast<int32_t>(DiscMeans::kPixel);
    for (int32_t y = 0; y <= disc.size || y <= second.size; ++y) {
      const int32_t last = LastOf(disc, y), second_last = LastOf(second, y);
      if (last >= 0 || second_last >= 0) rows = y + 1;
      for (int32_t x = 0; x <= last || x <= second_last; x += 2) {
        taps[count++] = {{Weight(disc, x, y), Weight(disc, x + 1, y)},
                         {Weight(second, x, y), Weight(second, x + 1, y)},
                         y * kRow + kPixel * x,
                         y * kRow - kPixel * x};
      }
    }
  }

 private:
  // Returns the weight of pixel (x, y) of the disc plus the weights of the pixel's mirror images
  // about both axes.
  static uint16_t Weight(const Disc& disc, int32_t x, int32_t y) {
    if (x > disc.size || y > disc.size) return 0;
    const int32_t high = x > y ? x : y, low = x > y ? y : x;
    const int bits = (x > 0 ? 1 : 0) + (y > 0 ? 1 : 0);
    return static_cast<uint16_t>(disc.weights[high * (high + 1) / 2 + low] << bits);
  }

  // Returns the last column of row y with a nonzero weight, or -1. In Disc::weights, the weights of
  // a row are contiguous up to the diagonal. Beyond the diagonal, adjacent weights are as far apart
  // as the octant's rows are long.
  static int32_t LastOf(const Disc& disc, int32_t y) {
    if (y > disc.size) return -1;
    int32_t x = disc.size;
    const uint16_t* weight = disc.weights + x * (x + 1) / 2 + y;
    for (; x > y; weight -= x--) {
      if (*weight != 0) return x;
    }
    for (; x >= 0; --x, --weight) {
      if (*weight != 0) return x;
    }
    return -1;
  }
};

// Scale of the sums of a disc. Sums are divided by 2^bits and multiplied by 2^whole.
struct DiscScale {
  int bits, whole;
};

// Filters `count` samples with a disc: multiplies the means by the weights of the disc and adds the
// products. If kTwo is true, also computes sums weighted by a second disc. `light` and
// `second_light` need spare room, because vectors write past the last sample.
#if HWY_TARGET == HWY_SCALAR

template <bool kTwo>
inline void FilterMeans(const DiscTaps& disc, const uint16_t* HWY_RESTRICT means, size_t count,
                        const DiscScale& scale, int16_t* HWY_RESTRICT light,
                        const DiscScale& second_scale, int16_t* HWY_RESTRICT second_light) {
  constexpr ptrdiff_t kPixel = DiscMeans::kPixel;
  const auto finish = [](uint32_t sum, const DiscScale& by) {
    const uint32_t half = uint32_t{1} << (by.bits - 1);
    return static_cast<int16_t>((sum + half) >> by.bits << by.whole);
  };
  for (size_t n = 0; n < count; ++n) {
    const uint16_t* at = means + n;
    uint32_t sum = 0, second_sum = 0;
    for (size_t k = 0; k < disc.count; ++k) {
      const DiscTaps::Tap& tap = disc.taps[k];
      const uint16_t *right = at + tap.right, *left = at + tap.left;
      const uint32_t first = (right[0] + left[0] + uint32_t{1}) >> 1;
      const uint32_t next = (right[kPixel] + left[-kPixel] + uint32_t{1}) >> 1;
      sum += first * tap.weights[0] + next * tap.weights[1];
      if (kTwo) second_sum += first * tap.second_weights[0] + next * tap.second_weights[1];
    }
    light[n] = finish(sum, scale);
    if (kTwo) second_light[n] = finish(second_sum, second_scale);
  }
}

#else

// Operations on a vector of means and on the sums of its products. The sums occupy two vectors,
// which DemoteSums joins.
struct DiscSums {
  static constexpr hn::ScalableTag<uint16_t> d16{};
  static constexpr hn::RebindToSigned<decltype(d16)> di16{};
  static constexpr hn::Repartition<uint32_t, decltype(d16)> d32{};
  static constexpr hn::RebindToSigned<decltype(d32)> di32{};
  using V16 = hn::Vec<decltype(d16)>;
  using V32 = hn::Vec<decltype(di32)>;

  // Returns the means of the samples on the right and on the left, which mirror each other.
  static HWY_INLINE V16 Mean(const uint16_t* right, const uint16_t* left) {
    return hn::AverageRound(hn::LoadU(d16, right), hn::LoadU(d16, left));
  }

  // Multiplies two vectors of means by two weights and adds the products to the sums.
  static HWY_INLINE void Add(V16 first, V16 second, const uint16_t* weights, V32& low, V32& high) {
    AddWeighed(hn::BitCast(di16, first), hn::BitCast(di16, second), weights[0], weights[1], low,
               high);
  }

  static HWY_INLINE void Store(V32 low, V32 high, const DiscScale& scale, int16_t* light) {
    const auto half = hn::Set(d32, uint32_t{1} << (scale.bits - 1));
    const auto value = [&](V32 sums) HWY_ATTR {
      const auto sum = hn::Add(hn::BitCast(d32, sums), half);
      return hn::BitCast(di32, hn::ShiftRightSame(sum, scale.bits));
    };
    const auto both = DemoteSums(di16, value(low), value(high));
    hn::StoreU(hn::ShiftLeftSame(both, scale.whole), di16, light);
  }
};

// Second result that FilterMeansVector computes together with the first result, so that both share
// loads of means or weights.
enum class Beside { kNothing, kNextVector, kSecondDisc };

// Filters a vector of means. The function is not inlined, to keep WebAssembly modules small.
template <Beside kBeside>
HWY_NOINLINE void FilterMeansVector(const DiscTaps& disc, const uint16_t* HWY_RESTRICT means,
                                    const DiscScale& scale, int16_t* HWY_RESTRICT light,
                                    const DiscScale& other_scale,
                                    int16_t* HWY_RESTRICT other_light) {
  const size_t lanes = hn::Lanes(DiscSums::d16);
  constexpr ptrdiff_t kPixel = DiscMeans::kPixel;
  auto low = hn::Zero(DiscSums::di32), high = low, other_low = low, other_high = low;
  for (size_t k = 0; k < disc.count; ++k) {
    const DiscTaps::Tap& tap = disc.taps[k];
    const uint16_t *right = means + tap.right, *left = means + tap.left;
    const auto first = DiscSums::Mean(right, left);
    const auto next = DiscSums::Mean(right + kPixel, left - kPixel);
    DiscSums::Add(first, next, tap.weights, low, high);
    if (kBeside == Beside::kNextVector) {
      right += lanes;
      left += lanes;
      DiscSums::Add(DiscSums::Mean(right, left), DiscSums::Mean(right + kPixel, left - kPixel),
                    tap.weights, other_low, other_high);
    } else if (kBeside == Beside::kSecondDisc) {
      DiscSums::Add(first, next, tap.second_weights, other_low, other_high);
    }
  }
  DiscSums::Store(low, high, scale, light);
  if (kBeside != Beside::kNothing) {
    DiscSums::Store(other_low, other_high, other_scale, other_light);
  }
}

template <bool kTwo>
inline void FilterMeans(const DiscTaps& disc, const uint16_t* HWY_RESTRICT means, size_t count,
                        const DiscScale& scale, int16_t* HWY_RESTRICT light,
                        const DiscScale& second_scale, int16_t* HWY_RESTRICT second_light) {
  const size_t lanes = hn::Lanes(DiscSums::d16);
  size_t n = 0;
  if (kTwo) {
    for (; n < count; n += lanes) {
      FilterMeansVector<Beside::kSecondDisc>(disc, means + n, scale, light + n, second_scale,
                                             second_light + n);
    }
    return;
  }
  for (; n + lanes < count; n += 2 * lanes) {
    FilterMeansVector<Beside::kNextVector>(disc, means + n, scale, light + n, scale,
                                           light + n + lanes);
  }
  if (n < count) {
    FilterMeansVector<Beside::kNothing>(disc, means + n, scale, light + n, scale, nullptr);
  }
}

#endif

// Destination of the filtered light: 8-bit codes, or samples of a layer if `codes` is null.
struct DiscOutput {
  uint8_t* codes;
  int16_t* samples;
  size_t stride;
  Encoding encoding;
  DiscScale scale;

  void Store(const int16_t* light, size_t count, size_t at) const {
    if (codes == nullptr) {
      std::memcpy(samples + at, light, count * sizeof(*light));
    } else {
      Encode(light, count, encoding, codes + at);
    }
  }
};

inline DiscOutput SamplesOf(const Disc& disc, int16_t* samples, size_t stride) {
  return {nullptr, samples, stride, {nullptr, nullptr}, {disc.bits + kLightBits - kLayerBits, 0}};
}

// Filters rows of samples in chunks. If kTwo is true, also filters the rows with a second, smaller
// disc.
template <bool kTwo>
inline void FilterRows(const SampleRows& in, const Disc& disc, const Disc& smaller,
                       const DiscOutput& out, const DiscOutput& second_out) {
  const Disc none = {-1, 0, nullptr};
  const DiscTaps taps(disc, kTwo ? smaller : none);
  DiscMeans means;
  constexpr size_t kLight = kDiscChunk + HWY_MAX_BYTES;
  int16_t light[kLight], second_light[kTwo ? kLight : 1];
  for (size_t begin = 0; begin < in.count; begin += kDiscChunk) {
    const size_t chunk = in.count - begin < kDiscChunk ? in.count - begin : kDiscChunk;
    for (size_t row = 0; row < in.rows; ++row) {
      means.Fill(in.samples + row * in.stride + begin, in.stride, disc, taps.rows, chunk);
      FilterMeans<kTwo>(taps, means.First(disc), chunk, out.scale, light, second_out.scale,
                        second_light);
      out.Store(light, chunk, row * out.stride + begin);
      if (kTwo) second_out.Store(second_light, chunk, row * second_out.stride + begin);
    }
  }
}

inline void FilterDisc(const SampleRows& in, const Disc& disc, const Encoding& encoding,
                       uint8_t* HWY_RESTRICT out, size_t out_stride) {
  // Number of fractional bits of the light that rounding removes before the light is encoded.
  const int whole = encoding.entries == nullptr ? kLightBits : 0;
  const DiscOutput codes = {out, nullptr, out_stride, encoding, {disc.bits + whole, whole}};
  FilterRows<false>(in, disc, disc, codes, codes);
}

inline void FilterDiscLayer(const SampleRows& in, const Disc& disc, int16_t* HWY_RESTRICT out,
                            size_t out_stride) {
  const DiscOutput samples = SamplesOf(disc, out, out_stride);
  FilterRows<false>(in, disc, disc, samples, samples);
}

inline void FilterTwoDiscs(const SampleRows& in, const Disc& less, const Disc& more,
                           int16_t* HWY_RESTRICT out_less, int16_t* HWY_RESTRICT out_more,
                           size_t out_stride) {
  const DiscOutput first = SamplesOf(more, out_more, out_stride);
  const DiscOutput second = SamplesOf(less, out_less, out_stride);
  FilterRows<true>(in, more, less, first, second);
}

inline void MixSamples(const int16_t* HWY_RESTRICT less, const int16_t* HWY_RESTRICT more,
                       const int16_t* HWY_RESTRICT share, size_t count, int16_t* HWY_RESTRICT out) {
  const hn::CappedTag<int16_t, kSliceLanes> d16;
  for (size_t n = 0; n < SliceSamples(count); n += hn::Lanes(d16)) {
    const auto from = hn::LoadU(d16, less + n);
    const auto rest = hn::Sub(hn::LoadU(d16, more + n), from);
    hn::StoreU(hn::Add(from, hn::MulFixedPoint15(rest, hn::LoadU(d16, share + n))), d16, out + n);
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

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();
