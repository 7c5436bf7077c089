// SPDX-License-Identifier: Apache-2.0
// Vector code of the functions in composite.h. This file is included once per SIMD target.
#include <type_traits>

#include "simd/composite.h"
#include "simd/highway-inl.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

// Rows of a strip are contiguous in memory, so that the widest vectors can hold two rows.
#undef STARFOCUS_WIDE_TILES
#if HWY_TARGET != HWY_SCALAR && HWY_MAX_BYTES >= 64
#define STARFOCUS_WIDE_TILES 1
using StripTag = hn::CappedTag<int16_t, 2 * kSliceLanes>;
#else
#define STARFOCUS_WIDE_TILES 0
using StripTag = LanesTag;
#endif

// True if Composite has a separate path for fully covered rows. With vectors narrower than 32
// bytes, the tests for fully covered rows cost more instructions than the separate path saves.
constexpr bool kCoveredApart = HWY_MAX_BYTES >= 32;

// True if Composite skips work by testing each vector for coverage and for slices in front. The
// branches that test each vector are unpredictable. On x86, branch mispredictions would cost up to
// 12 % of the time, so Composite tests only the precomputed marks of whole rows. On ARM, using only
// the marks of rows takes 3 to 5 % more instructions than testing each vector.
constexpr bool kBehindFirst = !HWY_ARCH_X86;

// Returns the number of rows of a strip in a vector, or 1 if a vector holds only a part of a row.
template <class D>
HWY_INLINE size_t RowsOf(D d) {
  return hn::Lanes(d) > kSliceLanes ? hn::Lanes(d) / kSliceLanes : 1;
}

// Writes one mark per row, which states whether a slice covers the row and the next rows. Rows must
// be added in order, starting with the first row.
class RowMarks {
 public:
  // Adds a row. `most` and `least` are the largest and the smallest coverage over all vectors of
  // the row.
  HWY_INLINE void Add(LanesVec most, LanesVec least, int8_t* HWY_RESTRICT near) {
    const LanesTag d16;
    const bool some = !AllZero(d16, most);
    const bool all = hn::AllTrue(d16, hn::Eq(least, hn::Set(d16, kSliceOne)));
    if (some) near[0] = 0;
    if (some && !shown_) {
      for (int8_t k = 1; k <= kAhead && near[-k] > k; ++k) near[-k] = k;
    }
    shown_ = some;
    all_covered_ = all ? all_covered_ + 1 : 0;
    if (all_covered_ > kAhead) near[-kAhead] = kCoveredNear;
  }

  // Adds a row that the slice does not cover.
  HWY_INLINE void AddEmpty() {
    shown_ = false;
    all_covered_ = 0;
  }

 private:
  static constexpr int kAhead = kRowsAhead;
  bool shown_ = false;   // True if the slice covers a pixel of the last row.
  int all_covered_ = 0;  // Number of consecutive fully covered rows that end with the last row.
};

// Calls act(taps), with `taps` as a compile-time constant.
template <class Act>
HWY_INLINE void CallWithTaps(int taps, const Act& act) {
  if (taps == 2) {
    act(std::integral_constant<int, 2>());
  } else if (taps == 3) {
    act(std::integral_constant<int, 3>());
  } else {
    act(std::integral_constant<int, 4>());
  }
}

// Shifts rows one at a time, with vectors of at most one row. Wider vectors that combine the planes
// of two rows are slower.
template <int kTaps>
HWY_INLINE void ShiftRows(const int16_t* in, size_t in_plane, const SliceOffset& offset,
                          const SliceCover* cover, uint64_t groups, size_t rows, size_t plane,
                          int16_t* HWY_RESTRICT out, int8_t* HWY_RESTRICT near) {
  const LanesTag d;
  const size_t lanes = hn::Lanes(d);
  const auto inside = hn::Set(d, offset.inside), edge = hn::Set(d, offset.edge);
  const auto third = hn::Set(d, offset.third), fourth = hn::Set(d, offset.fourth);
  const int16_t* const first_row = in + offset.whole;
  RowMarks marks;
  for (size_t row = 0; row < rows; ++row, out += kSliceLanes) {
    if ((cover[row].some & groups) == 0) {
      for (size_t n = 0; n < kSliceLanes; n += lanes) {
        for (size_t c = 0; c < 4; ++c) hn::StoreU(hn::Zero(d), d, out + c * plane + n);
      }
      marks.AddEmpty();
      continue;
    }
    auto most = hn::Zero(d), least = hn::Set(d, kSliceOne);
    for (size_t n = 0; n < kSliceLanes; n += lanes) {
      const int16_t* HWY_RESTRICT from = first_row + row * 4 * in_plane + n;
      const auto load = [&](size_t c, size_t next)
                            HWY_ATTR { return hn::LoadU(d, from + c * in_plane + next); };
      const auto covered = load(3, 0), next = load(3, 1);
      auto any = hn::Or(covered, next);
      if (kTaps > 2) any = hn::Or(any, load(3, 2));
      if (kTaps > 3) any = hn::Or(any, load(3, 3));
      if (AllZero(d, any)) {
        for (size_t c = 0; c < 4; ++c) hn::StoreU(hn::Zero(d), d, out + c * plane + n);
        least = hn::Zero(d);
        continue;
      }
      const auto first = kTaps > 2 ? edge : hn::IfThenElse(hn::Eq(covered, next), inside, edge);
      const auto between = [&](size_t c) HWY_ATTR {
        const auto middle = load(c, 1);
        auto value = hn::Add(middle, hn::MulFixedPoint15(hn::Sub(middle, load(c, 0)), first));
        if (kTaps == 2) return value;
        const auto after = load(c, 2);
        value = hn::Add(value, hn::MulFixedPoint15(hn::Sub(middle, after), third));
        if (kTaps == 3) return value;
        return hn::Add(value, hn::MulFixedPoint15(hn::Sub(after, load(c, 3)), fourth));
      };
      for (size_t c = 0; c < 3; ++c) hn::StoreU(between(c), d, out + c * plane + n);
      const auto shown = between(3);
      hn::StoreU(shown, d, out + 3 * plane + n);
      most = hn::Max(most, shown);
      least = hn::Min(least, shown);
    }
    marks.Add(most, least, near + row);
  }
}

inline void ShiftSlice(const int16_t* in, size_t in_plane, const SliceOffset& offset,
                       const SliceCover* cover, uint64_t groups, size_t rows, size_t plane,
                       int16_t* HWY_RESTRICT out, int8_t* HWY_RESTRICT near) {
  CallWithTaps(offset.taps, [&](auto taps) HWY_ATTR {
    ShiftRows<decltype(taps)::value>(in, in_plane, offset, cover, groups, rows, plane, out, near);
  });
}

using SliceVec = hn::Vec<StripTag>;

// Returns 16-bit sums divided by 2^bits, rounded half up.
HWY_INLINE SliceVec DividedSums(SliceVec value, int bits) {
  const StripTag d;
  const hn::RebindToUnsigned<StripTag> d16;
  const auto half = hn::Set(d16, static_cast<uint16_t>(1 << bits >> 1));
  return hn::BitCast(d, hn::ShiftRightSame(hn::Add(hn::BitCast(d16, value), half), bits));
}

// Adds 16-bit values to 32-bit sums, for at most `rows` rows.
HWY_INLINE void AddSums(SliceVec value, size_t rows, uint32_t* HWY_RESTRICT sums) {
  const StripTag d;
  const hn::RebindToUnsigned<StripTag> d16;
  const hn::CappedTag<uint32_t, kSliceLanes> d32;
  const hn::Rebind<uint16_t, decltype(d32)> part;
  const size_t each = hn::Lanes(d) / RowsOf(d);
  uint16_t bits[2 * kSliceLanes];
  hn::StoreU(hn::BitCast(d16, value), d16, bits);
  const size_t most = RowsOf(d) < rows ? RowsOf(d) : rows;
  for (size_t row = 0; row < most; ++row, sums += 4 * kSliceLanes) {
    for (size_t n = 0; n < each; n += hn::Lanes(d32)) {
      const auto more = hn::PromoteTo(d32, hn::LoadU(part, bits + row * kSliceLanes + n));
      hn::StoreU(hn::Add(hn::LoadU(d32, sums + n), more), d32, sums + n);
    }
  }
}

// Returns light / covered for lanes in which the quotient is less than one, computed like
// SliceShare in the reference.
HWY_INLINE SliceVec ShareOfLight(SliceVec covered, SliceVec light, SliceVec excess) {
  const StripTag d16;
  const auto one = hn::Set(d16, kSliceOne);
  const auto open = hn::Sub(one, covered);
  const auto first = hn::MulFixedPoint15(excess, open);
  const auto second = hn::MulFixedPoint15(first, open);
  const auto taken = hn::SaturatedAdd(hn::SaturatedAdd(excess, first), second);
  const auto twice = hn::SaturatedAdd(light, light);
  return hn::Min(hn::Sub(one, taken), hn::SaturatedAdd(twice, twice));
}

// Visibility of a slice in a group of rows of a view, as known before compositing.
enum class Known {
  kLit,  // No slice in front covers any pixel of these rows.
  // The condition of kLit holds, and the slice covers all pixels of these rows completely, so that
  // it hides all slices behind it.
  kCovered,
  kNothing,
};

// Colours and coverage of a slice, or their sums over views. The members are references, because
// vectors of some targets cannot be members.
struct ViewSums {
  SliceVec &r, &g, &b, &covered;
};

// Adds a slice's colours and coverage to the sums of a view, and subtracts the coverage from the
// remaining light. `excess` is the part of the coverage that exceeds the remaining light. The
// excess does not contribute to the sums.
template <Known kKnown>
HWY_INLINE void AddSlice(SliceVec weight, const ViewSums& slice, SliceVec excess, SliceVec& light,
                         const ViewSums& sums) {
  const StripTag d16;
  const auto taken = hn::Sub(slice.covered, excess);
  if (kKnown == Known::kNothing && !(kBehindFirst && AllZero(d16, excess))) {
    const auto over = hn::Gt(slice.covered, light);
    const auto share = ShareOfLight(slice.covered, light, excess);
    const auto lit = [&](SliceVec value) HWY_ATTR {
      return hn::IfThenElse(over, hn::MulFixedPoint15(value, share), value);
    };
    slice.r = lit(slice.r);
    slice.g = lit(slice.g);
    slice.b = lit(slice.b);
    slice.covered = lit(slice.covered);
  }
  light = hn::Sub(light, taken);
  sums.r = hn::Add(sums.r, hn::MulFixedPoint15(weight, slice.r));
  sums.g = hn::Add(sums.g, hn::MulFixedPoint15(weight, slice.g));
  sums.b = hn::Add(sums.b, hn::MulFixedPoint15(weight, slice.b));
  sums.covered = hn::Add(sums.covered, hn::MulFixedPoint15(weight, slice.covered));
}

// Adds the contribution of a slice to a vector of rows of a view. `at` is the first sample of the
// slice. Each row of the view is interpolated from kTaps (2 to 4) rows of the slice.
template <int kTaps, Known kKnown>
HWY_INLINE void AddRows(const SliceOffset& offset, size_t plane, const int16_t* HWY_RESTRICT at,
                        SliceVec weight, SliceVec& light, const ViewSums& sums) {
  const StripTag d16;
  constexpr bool kCovered = kKnown == Known::kCovered;
  const auto load = [&](const int16_t* from) HWY_ATTR { return hn::LoadU(d16, from); };
  const int16_t* HWY_RESTRICT cover = at + 3 * plane;
  auto first = hn::Set(d16, offset.edge);
  const auto third = hn::Set(d16, offset.third);
  const auto fourth = hn::Set(d16, offset.fourth);
  if (kTaps == 2) {
    const auto inside = hn::Set(d16, offset.inside);
    first = kCovered
                ? inside
                : hn::IfThenElse(hn::Eq(load(cover), load(cover + kSliceLanes)), inside, first);
  }
  const auto between = [&](const int16_t* from) HWY_ATTR {
    const auto middle = load(from + kSliceLanes);
    auto value = hn::Add(middle, hn::MulFixedPoint15(hn::Sub(middle, load(from)), first));
    if (kTaps == 2) return value;
    const auto below = load(from + 2 * kSliceLanes);
    value = hn::Add(value, hn::MulFixedPoint15(hn::Sub(middle, below), third));
    if (kTaps == 3) return value;
    const auto last = hn::Sub(below, load(from + 3 * kSliceLanes));
    return hn::Add(value, hn::MulFixedPoint15(last, fourth));
  };
  auto covered = kCovered ? hn::Set(d16, kSliceOne) : between(cover);
  // Colours of pixels without coverage are at most rounding errors. Products of rounding errors and
  // weights below one half are 0.
  if (kBehindFirst && !kCovered && AllZero(d16, covered)) return;
  const auto excess =
      kKnown == Known::kNothing ? hn::Max(hn::Sub(covered, light), hn::Zero(d16)) : hn::Zero(d16);
  auto r = between(at), g = between(at + plane), b = between(at + 2 * plane);
  AddSlice<kKnown>(weight, {r, g, b, covered}, excess, light, sums);
}

// Adds the light in `rows` rows of a vector to the sums of these rows.
HWY_INLINE void AddLight(const ViewSums& view, size_t rows, uint32_t* HWY_RESTRICT sums) {
  AddSums(view.r, rows, sums);
  AddSums(view.g, rows, sums + kSliceLanes);
  AddSums(view.b, rows, sums + 2 * kSliceLanes);
  AddSums(view.covered, rows, sums + 3 * kSliceLanes);
}

// A visible slice and a pointer to its offset in the first view.
struct SeenSlice {
  StripSlice slice;
  const SliceOffset* offsets;
};

// Composites two vectors of rows of a strip.
HWY_INLINE void CompositeRows(const SliceViews& views, const SeenSlice* seen, size_t row, size_t n,
                              size_t rows, uint32_t* HWY_RESTRICT sums) {
  const StripTag d16;
  const size_t step = RowsOf(d16), second = step * kSliceLanes;
  const int vector_rows = static_cast<int>(step);
  const auto zero = hn::Zero(d16), one = hn::Set(d16, kSliceOne);
  auto r0 = zero, g0 = zero, b0 = zero, a0 = zero, r1 = zero, g1 = zero, b1 = zero, a1 = zero;
  const SeenSlice* const end = seen + views.shown_count;
  for (size_t view = 0, first = 0; view < views.views; ++view, first += views.count) {
    const auto weight = hn::Set(d16, views.weights[view]);
    auto light0 = one, light1 = one;
    bool taken = false;
    for (const SeenSlice* k = seen; k != end; ++k) {
      const StripSlice& slice = k->slice;
      const SliceOffset& offset = k->offsets[first];
      const ptrdiff_t moved = static_cast<ptrdiff_t>(row) + offset.whole;
      const int8_t* near = slice.near + moved;
      const int read_by_both = 2 * vector_rows + offset.taps - 1;
      if (near[0] >= (kBehindFirst ? int{kNothingNear} : read_by_both)) continue;
      const int16_t* at = slice.samples + moved * ptrdiff_t{kSliceLanes} + n;
      const auto take = [&](auto known) HWY_ATTR {
        CallWithTaps(offset.taps, [&](auto taps) HWY_ATTR {
          constexpr int kTaps = decltype(taps)::value;
          constexpr Known kKnown = decltype(known)::value;
          const int read = vector_rows + kTaps - 1;
          if (kBehindFirst || near[0] < read) {
            AddRows<kTaps, kKnown>(offset, slice.plane, at, weight, light0, {r0, g0, b0, a0});
          }
          if (kBehindFirst || near[step] < read) {
            AddRows<kTaps, kKnown>(offset, slice.plane, at + second, weight, light1,
                                   {r1, g1, b1, a1});
          }
        });
      };
      if (!taken && kCoveredApart && near[0] == kCoveredNear) {
        take(std::integral_constant<Known, Known::kCovered>());
        break;
      }
      if (!taken) {
        taken = true;
        take(std::integral_constant<Known, Known::kLit>());
      } else {
        take(std::integral_constant<Known, Known::kNothing>());
      }
      if (AllZero(d16, hn::Or(light0, light1))) break;
    }
  }
  if (views.extra_bits != 0) {
    for (SliceVec* value : {&r0, &g0, &b0, &a0, &r1, &g1, &b1, &a1}) {
      *value = DividedSums(*value, views.extra_bits);
    }
  }
  AddLight({r0, g0, b0, a0}, rows, sums + n);
  if (rows > step) AddLight({r1, g1, b1, a1}, rows - step, sums + 4 * second + n);
}

inline void Composite(const SliceViews& views, size_t rows, uint32_t* HWY_RESTRICT sums) {
  const StripTag d;
  const size_t step = 2 * RowsOf(d);
  SeenSlice seen[kMaxSeen];
  for (size_t k = 0; k < views.shown_count; ++k) {
    seen[k] = {views.slices[views.shown[k]], views.offsets + views.shown[k]};
  }
  for (size_t y = 0; y < rows; y += step, sums += 4 * step * kSliceLanes) {
    for (size_t n = 0; n < kSliceLanes; n += hn::Lanes(d)) {
      CompositeRows(views, seen, views.row + y, n, rows - y, sums);
    }
  }
}

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
