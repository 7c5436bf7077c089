// SPDX-License-Identifier: Apache-2.0
// Vector code of ShiftSlice and Composite (composite.h). This file is included once per SIMD
// target.
#include <type_traits>

#include "simd/composite.h"
#include "simd/highway-inl.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

// Calls act(taps), with `taps` as a compile-time constant. WebAssembly, whose download should be
// small, has no code for three samples: the fourth sample then has a factor of 0.
template <class Act>
HWY_INLINE void CallWithTaps(int taps, const Act& act) {
  if (taps == 2) {
    act(std::integral_constant<int, 2>());
#if !HWY_ARCH_WASM
  } else if (taps == 3) {
    act(std::integral_constant<int, 3>());
#endif
  } else {
    act(std::integral_constant<int, 4>());
  }
}

// Factors of the interpolation of SliceOffset. The members are references, because vectors of some
// targets cannot be members.
template <class V>
struct Factors {
  const V &inside, &edge, &third, &fourth;
};

// Interpolates between kTaps samples that are `next` apart.
template <int kTaps, class D, class V = hn::Vec<D>>
HWY_INLINE V Between(D d, const int16_t* HWY_RESTRICT at, size_t next, V first,
                     const Factors<V>& factors) {
  const auto middle = hn::LoadU(d, at + next);
  auto value = AddProduct15(middle, hn::Sub(middle, hn::LoadU(d, at)), first);
  if (kTaps == 2) return value;
  const auto after = hn::LoadU(d, at + 2 * next);
  value = AddProduct15(value, hn::Sub(middle, after), factors.third);
  if (kTaps == 3) return value;
  return AddProduct15(value, hn::Sub(after, hn::LoadU(d, at + 3 * next)), factors.fourth);
}

// Returns the factor of the first difference for samples with the coverage at `covered`.
template <int kTaps, class D, class V = hn::Vec<D>>
HWY_INLINE V FirstFactor(D d, const int16_t* HWY_RESTRICT covered, size_t next,
                         const Factors<V>& factors) {
  if (kTaps > 2) return factors.edge;
  const auto alike = hn::Eq(hn::LoadU(d, covered), hn::LoadU(d, covered + next));
  return hn::IfThenElse(alike, factors.inside, factors.edge);
}

#if HWY_TARGET == HWY_SCALAR

using reference::Composite;
using reference::ShiftSlice;

#else

// Coverage of rows of both halves of a strip, from row 0 of a RowCover on.
struct HalfCovers {
  RowCover half[2] = {{0, 0}, {0, 0}};

  // Adds the coverage of the columns [n, n + lanes) in the row of `bit`.
  HWY_INLINE void Add(LanesVec shown, size_t n, uint64_t bit) {
    const LanesTag d;
    const auto one = hn::Eq(shown, hn::Set(d, kSliceOne));
    if (hn::Lanes(d) == kHalfStrip) {
      RowCover& cover = half[n / kHalfStrip];
      cover.some |= bit;
      if (hn::AllTrue(d, one)) cover.all |= bit;
      return;
    }
    const uint32_t none = BitsOf(d, hn::Eq(shown, hn::Zero(d))), all = BitsOf(d, one);
    constexpr uint32_t kHalf = (1u << kHalfStrip) - 1;
    for (size_t k = 0; k < 2; ++k) {
      const size_t shift = k * kHalfStrip;
      half[k].some |= (none >> shift & kHalf) != kHalf ? bit : 0;
      half[k].all |= (all >> shift & kHalf) == kHalf ? bit : 0;
    }
  }
  HWY_INLINE void AddWhole(uint64_t bit) {
    for (RowCover& cover : half) {
      cover.some |= bit;
      cover.all |= bit;
    }
  }
};

// Shifts a row of a slice that is not empty.
template <int kTaps>
HWY_INLINE void ShiftRow(const int16_t* HWY_RESTRICT from, size_t plane, bool is_whole,
                         const Factors<LanesVec>& factors, uint64_t bit, int16_t* HWY_RESTRICT row,
                         HalfCovers& covers) {
  const LanesTag d;
  const auto zero = hn::Zero(d);
  if (is_whole) covers.AddWhole(bit);
  for (size_t n = 0; n < kSliceLanes; n += hn::Lanes(d)) {
    const int16_t* HWY_RESTRICT covered = from + 3 * plane + n;
    auto first = kTaps > 2 ? factors.edge : factors.inside;
    auto shown = hn::Set(d, kSliceOne);
    if (!is_whole) {
      first = FirstFactor<kTaps>(d, covered, 1, factors);
      shown = Between<kTaps>(d, covered, 1, first, factors);
      if (AllZero(d, shown)) {
        for (size_t c = 0; c < 4; ++c) hn::StoreU(zero, d, row + c * kSliceLanes + n);
        continue;
      }
      covers.Add(shown, n, bit);
    }
    for (size_t c = 0; c < 3; ++c) {
      const auto value = Between<kTaps>(d, from + c * plane + n, 1, first, factors);
      hn::StoreU(value, d, row + c * kSliceLanes + n);
    }
    hn::StoreU(shown, d, row + 3 * kSliceLanes + n);
  }
}

template <int kTaps>
HWY_INLINE void ShiftRows(const SliceRows& in, const SliceOffset& offset, size_t first, size_t end,
                          const StripSlice& out) {
  const LanesTag d;
  const auto inside = hn::Set(d, offset.inside), edge = hn::Set(d, offset.edge);
  const auto third = hn::Set(d, offset.third), fourth = hn::Set(d, offset.fourth);
  const Factors<LanesVec> factors = {inside, edge, third, fourth};
  const int16_t* HWY_RESTRICT from = in.samples + offset.whole;
  int16_t* HWY_RESTRICT row = out.samples + first * kStripRow;
  const SliceCover* HWY_RESTRICT cover = in.cover;
  for (size_t y = first, next; y < end; y = next) {
    next = HWY_MIN(y / 64 * 64 + 64, end);
    HalfCovers covers;
    RowCover* const to = out.cover + y / 64 * 2;
    for (uint64_t bit = uint64_t{1} << y % 64; y < next; ++y, bit <<= 1) {
      if ((cover->some & in.groups) == 0) {
        for (size_t n = 0; n < kStripRow; n += hn::Lanes(d)) hn::StoreU(hn::Zero(d), d, row + n);
      } else {
        const bool is_whole = in.keeps_whole && (cover->all & in.groups) == in.groups;
        ShiftRow<kTaps>(from, in.plane, is_whole, factors, bit, row, covers);
      }
      from += 4 * in.plane;
      row += kStripRow;
      ++cover;
    }
    to[0] = covers.half[0];
    to[1] = covers.half[1];
  }
}

inline void ShiftSlice(const SliceRows& in, const SliceOffset& offset, size_t first, size_t end,
                       const StripSlice& out) {
  for (size_t word = 0; word < out.covers; ++word) out.cover[word] = {0, 0};
  CallWithTaps(offset.taps, [&](auto taps) HWY_ATTR {
    ShiftRows<decltype(taps)::value>(in, offset, first, end, out);
  });
}

// The planes of a row are contiguous, so that the widest vectors hold two of them.
#undef STARFOCUS_TWO_PLANES
#if HWY_ARCH_X86 && HWY_MAX_BYTES >= 64
#define STARFOCUS_TWO_PLANES 1
using PlanesTag = hn::CappedTag<int16_t, 2 * kSliceLanes>;
#else
#define STARFOCUS_TWO_PLANES 0
using PlanesTag = LanesTag;
#endif
using PlanesVec = hn::Vec<PlanesTag>;

// Repeats the values of a row's pixels for each plane of a vector.
HWY_INLINE PlanesVec ForPlanes(LanesVec pixels) {
#if STARFOCUS_TWO_PLANES
  return hn::Combine(PlanesTag(), pixels, pixels);
#else
  return pixels;
#endif
}

// Returns light / covered for lanes in which the quotient is less than one, computed like
// SliceShare in the reference.
HWY_INLINE LanesVec ShareOfLight(LanesVec covered, LanesVec light, LanesVec excess) {
  const LanesTag d;
  const auto one = hn::Set(d, kSliceOne);
  const auto open = hn::Sub(one, covered);
  const auto first = hn::MulFixedPoint15(excess, open);
  const auto second = hn::MulFixedPoint15(first, open);
  const auto taken = hn::SaturatedAdd(excess, hn::Add(first, second));
  const auto twice = hn::SaturatedAdd(light, light);
  return hn::Min(hn::Sub(one, taken), hn::SaturatedAdd(twice, twice));
}

// Number of samples of a row of views: kStripRow sums of the views, as unsigned numbers plus
// kNoSum, and the remaining light of the current view. The range of saturating additions begins at
// kNoSum; all other additions wrap.
constexpr size_t kViewRow = kStripRow + kSliceLanes;
constexpr int16_t kNoSum = STARFOCUS_HAVE_ROUNDING_MULTIPLY_ADD ? INT16_MIN : 0;

// Adds `count` rows of a slice to rows of a view. `at` and `to` are the first samples. If kFront is
// true, no slice in front covers any pixel of the rows. If kCovered is true, the slice covers all
// pixels completely, so that it hides all slices behind it and its light is not stored.
template <int kTaps, bool kFront, bool kCovered>
HWY_INLINE void AddRows(const SliceOffset& offset, int16_t view_weight,
                        const int16_t* HWY_RESTRICT at, size_t count, int16_t* HWY_RESTRICT to) {
  const LanesTag d;
  const PlanesTag dp;
  const auto inside = hn::Set(d, offset.inside), edge = hn::Set(d, offset.edge);
  const auto third = hn::Set(d, offset.third), fourth = hn::Set(d, offset.fourth);
  const auto planes_inside = hn::Set(dp, offset.inside), planes_edge = hn::Set(dp, offset.edge);
  const auto planes_third = hn::Set(dp, offset.third), planes_fourth = hn::Set(dp, offset.fourth);
  const Factors<LanesVec> factors = {inside, edge, third, fourth};
  const Factors<PlanesVec> of_planes = {planes_inside, planes_edge, planes_third, planes_fourth};
  const auto weight = hn::Set(d, view_weight), one = hn::Set(d, kSliceOne);
  for (const int16_t* const end = at + count * kStripRow; at != end; at += kStripRow) {
    auto first = kTaps > 2 ? edge : inside;
    auto part = weight, light = one;
    if (!kCovered) {
      const int16_t* HWY_RESTRICT cover = at + 3 * kSliceLanes;
      first = FirstFactor<kTaps>(d, cover, kStripRow, factors);
      const auto covered = Between<kTaps>(d, cover, kStripRow, first, factors);
      if (kFront) {
        light = hn::Sub(one, covered);
      } else {
        const hn::RebindToUnsigned<LanesTag> du;
        const auto left = hn::LoadU(d, to + kStripRow);
        const auto less = [&](LanesVec a, LanesVec b) HWY_ATTR {
          return hn::BitCast(d, hn::SaturatedSub(hn::BitCast(du, a), hn::BitCast(du, b)));
        };
        const auto share = ShareOfLight(covered, left, less(covered, left));
        part = hn::IfThenElse(hn::Gt(covered, left), hn::MulFixedPoint15(weight, share), weight);
        light = less(left, covered);
      }
    } else if (!kFront) {
      part = hn::MulFixedPoint15(weight, hn::LoadU(d, to + kStripRow));
    }
    const auto planes_first = ForPlanes(first), planes_part = ForPlanes(part);
    // All loads precede all stores, because in-order cores wait at a load that follows a store.
    const auto sum = [&](size_t c) HWY_ATTR {
      const size_t n = c * kSliceLanes;
      const auto value = Between<kTaps>(dp, at + n, kStripRow, planes_first, of_planes);
      return AddProduct15(hn::LoadU(dp, to + n), value, planes_part);
    };
#if STARFOCUS_TWO_PLANES
    const auto red_green = sum(0), blue_covered = sum(2);
    hn::StoreU(red_green, dp, to);
    hn::StoreU(blue_covered, dp, to + 2 * kSliceLanes);
#else
    const auto red = sum(0), green = sum(1), blue = sum(2);
    const auto covered = kCovered ? hn::Add(hn::LoadU(d, to + 3 * kSliceLanes), part) : sum(3);
    hn::StoreU(red, d, to);
    hn::StoreU(green, d, to + kSliceLanes);
    hn::StoreU(blue, d, to + 2 * kSliceLanes);
    hn::StoreU(covered, d, to + 3 * kSliceLanes);
#endif
    if (!kCovered) hn::StoreU(light, d, to + kStripRow);
    to += kViewRow;
  }
}

// Calls act(first, count) for each sequence of bits that are set.
template <class Act>
HWY_INLINE void ForRuns(uint32_t bits, const Act& act) {
  while (bits != 0) {
    const uint32_t first = static_cast<uint32_t>(hwy::Num0BitsBelowLS1Bit_Nonzero32(bits));
    const uint32_t from = ~(bits >> first);
    const uint32_t count =
        from == 0 ? 32 : static_cast<uint32_t>(hwy::Num0BitsBelowLS1Bit_Nonzero32(from));
    act(first, count);
    bits &= bits + (uint32_t{1} << first);
  }
}

// Returns the coverage of the kMostRows rows from `row` on, for the columns [n, n + lanes).
HWY_INLINE RowCover CoverFrom(const RowCover* cover, size_t row, size_t n, size_t lanes) {
  const RowCover* word = cover + row / 64 * 2 + n / kHalfStrip;
  const size_t shift = row % 64;
  const auto from = [&](uint64_t low, uint64_t high) {
    return low >> shift | high << 1 << (63 - shift);
  };
  RowCover found = {from(word[0].some, word[2].some), from(word[0].all, word[2].all)};
  if (lanes > kHalfStrip) {
    found.some |= from(word[1].some, word[3].some);
    found.all &= from(word[1].all, word[3].all);
  }
  return found;
}

// Adds a slice to a view, for the columns [n, n + lanes). `open` has the rows that no slice in
// front hides completely, and `fresh` the rows in which no slice in front covers a pixel.
template <int kTaps>
HWY_INLINE void AddSlice(const SeenSlice& seen, const SliceOffset& offset, int16_t weight, size_t n,
                         int16_t* HWY_RESTRICT to, uint32_t& open, uint32_t& fresh) {
  const size_t row = seen.row + static_cast<size_t>(ptrdiff_t{offset.whole});
  const RowCover cover = CoverFrom(seen.slice.cover, row, n, hn::Lanes(LanesTag()));
  uint64_t some = cover.some | cover.some >> 1, all = cover.all & cover.all >> 1;
  if (kTaps > 2) {
    some |= cover.some >> 2;
    all &= cover.all >> 2;
  }
  if (kTaps > 3) {
    some |= cover.some >> 3;
    all &= cover.all >> 3;
  }
  const uint32_t shown = static_cast<uint32_t>(some) & open & seen.rows;
  if (shown == 0) return;
  const uint32_t hides = shown & static_cast<uint32_t>(all);
  const int16_t* const at = seen.slice.samples + row * kStripRow + n;
  const auto add = [&](uint32_t rows, auto front, auto covered) HWY_ATTR {
    ForRuns(rows, [&](size_t first, size_t count) HWY_ATTR {
      AddRows<kTaps, decltype(front)::value, decltype(covered)::value>(
          offset, weight, at + first * kStripRow, count, to + first * kViewRow);
    });
  };
  const std::true_type yes;
  const std::false_type no;
  add(hides & fresh, yes, yes);
  add(shown & ~hides & fresh, yes, no);
#if HWY_ARCH_WASM  // less code: covering rows need no code of their own to be right
  add(shown & ~fresh, no, no);
#else
  add(hides & ~fresh, no, yes);
  add(shown & ~hides & ~fresh, no, no);
#endif
  open &= ~hides;
  fresh &= ~shown;
}

// Adds the sums of a row of views, divided by 2^extra_bits, to 32-bit sums.
HWY_INLINE void AddSums(const int16_t* HWY_RESTRICT from, int extra_bits,
                        uint32_t* HWY_RESTRICT sums) {
  const hn::CappedTag<uint32_t, kSliceLanes> d32;
  const hn::Rebind<uint16_t, decltype(d32)> d16;
  const auto half = hn::Set(d32, uint32_t{1} << extra_bits >> 1);
  const uint16_t* HWY_RESTRICT more = reinterpret_cast<const uint16_t*>(from);
  for (size_t n = 0; n < kStripRow; n += hn::Lanes(d32)) {
    auto sum = hn::LoadU(d16, more + n);
    if (kNoSum != 0) sum = hn::Xor(sum, hn::Set(d16, static_cast<uint16_t>(kNoSum)));
    auto value = hn::PromoteTo(d32, sum);
    if (extra_bits != 0) value = hn::ShiftRightSame(hn::Add(value, half), extra_bits);
    hn::StoreU(hn::Add(hn::LoadU(d32, sums + n), value), d32, sums + n);
  }
}

inline void Composite(const SliceViews& views, size_t rows, uint32_t* HWY_RESTRICT sums) {
  const LanesTag d;
  const size_t lanes = hn::Lanes(d);
  const uint32_t all_rows = ~uint32_t{0} >> (kMostRows - rows);
  HWY_ALIGN int16_t view_rows[kMostRows * kViewRow];
  for (size_t y = 0; y < rows; ++y) {
    int16_t* const row = view_rows + y * kViewRow;
    for (size_t n = 0; n < kStripRow; n += lanes) hn::StoreU(hn::Set(d, kNoSum), d, row + n);
  }
  const SeenSlice* const end = views.seen + views.seen_count;
  for (size_t n = 0; n < kSliceLanes; n += lanes) {
    const SliceOffset* offsets = views.offsets;
    for (size_t view = 0; view < views.views; ++view, offsets += views.count) {
      uint32_t open = all_rows, fresh = all_rows;
      for (const SeenSlice* seen = views.seen; seen != end && open != 0; ++seen) {
        const SliceOffset& offset = offsets[seen->index];
        CallWithTaps(offset.taps, [&](auto taps) HWY_ATTR {
          AddSlice<decltype(taps)::value>(*seen, offset, views.weights[view], n, view_rows + n,
                                          open, fresh);
        });
      }
    }
  }
  for (size_t y = 0; y < rows; ++y) {
    AddSums(view_rows + y * kViewRow, views.extra_bits, sums + y * kStripRow);
  }
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();
