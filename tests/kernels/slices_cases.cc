// SPDX-License-Identifier: Apache-2.0
// Test and benchmark calls of the kernels that make slices (simd/slices.h) and composite them
// (simd/composite.h).
#include <algorithm>

#include "tests/kernels/kernel_cases.h"

namespace test::kernel_cases {
namespace {

std::vector<uint8_t> MostlyWholeShares(size_t count, Draw* draw) {
  return Filled<uint8_t>(count, [&] {
    const int kind = draw->Int(0, 3);
    return kind < 2 ? kSliceWhole : kind == 2 ? kSliceEnd : draw->Int(1, kSliceWhole - 1);
  });
}

// Makes rows of `count` pixels with surfaces; hidden surfaces are often missing. Values that the
// kernel does not read are arbitrary.
SurfaceRows MakeSurfaces(size_t rows, size_t count, Draw* draw, KernelCall* call) {
  const size_t whole = SliceSamples(count), stride = whole + draw->Size(0, 20, 0);
  const size_t size = (rows - 1) * stride + whole;
  SurfaceRows from = {};
  from.stride = stride;
  from.column = draw->Size(0, 40, 0);
  from.rows = rows;
  from.count = count;
  from.first.plane = size + draw->Size(0, 20, 0);
  from.hiding = call->Input("hiding", Filled<uint64_t>(rows, [&] { return draw->Next(); }));
  from.first.share = call->Input("share", MostlyWholeShares(size, draw));
  for (int k = 0; k < kSurfaces; ++k) {
    std::vector<int16_t> disparities = Disparities(size, draw);
    for (int16_t& d : disparities) d = k > 0 && draw->Int(0, 1) == 0 ? kNoSurface : d;
    from.first.disparity[k] = call->Input("disparity", disparities);
    from.first.rgb[k] = call->Input("rgb", Light(2 * from.first.plane + size, draw));
  }
  for (size_t at = 0; at < size; ++at) {
    const SurfaceRow row = from.Row(at / stride);
    const size_t n = at % stride;
    const bool hides = n < count && (row.hiding >> n / kSliceLanes & 1) != 0;
    if (!hides) call->Ignore(from.first.share + at, 1);
    for (int k = 0; k < kSurfaces; ++k) {
      const int16_t* disparity = from.first.disparity[k] + at;
      const bool counts = n < count && (k == 0 || hides);
      const bool coloured = counts && *disparity != kNoSurface;
      if (!counts) call->Ignore(disparity, 1);
      for (size_t c = 0; c < 3 && !coloured; ++c) {
        call->Ignore(from.first.rgb[k] + c * from.first.plane + at, 1);
      }
    }
  }
  return from;
}

// Returns the groups that contain a pixel of a slice, and some other groups.
uint64_t GroupsOf(const SurfaceRows& from, int16_t low, int16_t overlap, Draw* draw) {
  uint64_t groups = draw->timed() ? ~uint64_t{0} : draw->Next() & draw->Next();
  for (size_t y = 0; y < from.rows; ++y) {
    const SurfaceRow row = from.Row(y);
    for (size_t n = 0; n < from.count; ++n) {
      const uint64_t bit = uint64_t{1} << n / kSliceLanes;
      for (int k = 0; k < ((row.hiding & bit) != 0 ? kSurfaces : 1); ++k) {
        if (row.disparity[k][n] >= low && row.disparity[k][n] <= overlap) groups |= bit;
      }
    }
  }
  return groups & ((uint64_t{2} << (from.count - 1) / kSliceLanes) - 1);
}

}  // namespace

void SelectSlice(Draw* draw, KernelCall* call) {
  const size_t rows = draw->Size(1, 9, 8), count = draw->Length(1, 100, kTimedSamples / 32);
  const size_t whole = SliceSamples(count), width = whole + kSliceLanes * draw->Size(0, 2, 0);
  const size_t plane = width + draw->Size(0, 20, 0);
  const SurfaceRows from = MakeSurfaces(rows, count, draw, call);
  const int middle = from.first.disparity[0][count / 2], more = draw->Int(0, 400);
  const auto low = int16_t(std::max(-32700, middle - more));
  const auto high = int16_t(std::min(32700, middle + more / 2));
  const auto overlap = int16_t(std::min(32700, middle + more));
  const uint64_t groups = GroupsOf(from, low, overlap, draw);
  auto* out = call->OutputRows<int16_t>("out", 4 * rows, plane, width);
  auto* cover = call->Results<SliceCover>("cover", rows);
  call->Calls(&Kernels::SelectSlice, from, SliceRange{low, high, overlap}, groups, width, plane,
              out, cover);
  call->is_right = [=](uint64_t, Met* met) {
    bool right = true;
    for (size_t y = 0; y < rows; ++y) {
      int16_t* const row = out + 4 * y * plane;
      SliceCover expected = {0, groups};
      for (size_t n = 0; n < count; ++n) {
        const uint64_t bit = uint64_t{1} << n / kSliceLanes;
        const int16_t covered = row[3 * plane + n];
        if (covered > 0) expected.some |= bit;
        if (covered < kSliceOne) expected.all &= ~bit;
        (*met)[covered == 0 ? "none" : covered < kSliceOne ? "a part" : "all"] += 1;
      }
      (*met)["groups covered"] += expected.all != 0;
      (*met)["groups not covered"] += (groups & ~expected.some) != 0;
      (*met)["rows not covered"] += expected.some == 0;
      right = right && cover[y].some == expected.some && cover[y].all == expected.all;
      for (size_t c = 0; c < 4; ++c) {
        if (cover[y].some == 0) call->Free(row + c * plane, width);
        call->Free(row + c * plane + count, whole - count);
      }
    }
    return right;
  };
}

// SpreadSlice spreads samples either along a row, so that its input rows overlap, or along columns.
void SpreadSlice(Draw* draw, KernelCall* call) {
  const size_t count = draw->Length(1, 160, kTimedSamples), whole = SliceSamples(count);
  SliceTaps taps = {int32_t(draw->Size(1, kMaxSpread, 2)), 0, 0, 0};
  taps.inner = int16_t(taps.reach == 1 ? 0 : draw->Int(0, 32767 / taps.reach));
  taps.outer = int16_t(draw->Int(0, taps.inner == 0 ? 20000 : taps.inner));
  taps.centre = int16_t(std::min(32767, 32768 - (taps.reach - 1) * taps.inner - taps.outer));
  const size_t step = draw->Rarely(2) ? whole + draw->Size(0, 5, 0) : 1;
  const size_t others = 2 * size_t(taps.reach);
  const int bright = draw->Int(0, 4);
  const auto samples = Filled<int16_t>(whole + others * step, [&] {
    return draw->Int(0, 4) < bright ? kSliceOne : draw->Int(0, kSliceOne);
  });
  const int16_t* in = call->Input("in", samples);
  std::vector<const int16_t*> rows;
  for (size_t k = 0; k <= others; ++k) rows.push_back(in + k * step);
  const int16_t* const* const each = call->Input("rows", rows);
  auto* out = call->Results<int16_t>("out", whole);
  call->Calls(&Kernels::SpreadSlice, each, taps, count, out);
}

namespace {

// Returns a position with a shift by `whole` and a random filter: one sample, two samples, or three
// or four samples. With two samples, the weights at edges and inside surfaces may be equal or
// different.
SliceOffset Offset(int whole, Draw* draw) {
  const int taps = draw->timed() ? 2 : draw->Int(1, 5);
  const int first = draw->Int(0, taps > 3 ? 16384 : 32767);
  if (taps == 1) return SliceOffset::Of(whole, INT16_MIN, INT16_MIN, 0, 0);
  const auto edge = int16_t(-first);
  if (taps == 2) return SliceOffset::Of(whole, edge, edge, 0, 0);
  if (taps == 3) return SliceOffset::Of(whole, int16_t(draw->Int(-32768, 0)), edge, 0, 0);
  // The first and the last samples together weigh at most three quarters (SliceOffset).
  const int third = draw->Int(1, std::max(1, 24576 - first));
  const int fourth = taps == 4 ? 0 : draw->Int(0, third);
  return SliceOffset::Of(whole, edge, edge, int16_t(-third), int16_t(-fourth));
}

// Returns rows of samples; each row has four adjacent planes, three colours and the coverage. In
// each sample, no colour exceeds the coverage. `share` is the percentage of sequences of samples in
// a row that are partly or fully covered. If `share` is kFull, all samples are fully covered.
constexpr int kFull = 101;
std::vector<int16_t> Planes(size_t rows, size_t plane, int share, Draw* draw) {
  std::vector<int16_t> samples(4 * rows * plane);
  for (size_t row = 0; row < rows; ++row) {
    int cover = share == kFull ? kSliceOne : 0;
    for (size_t n = 0; n < plane; ++n) {
      if (share < kFull && draw->Int(0, 4) == 0) {
        cover = draw->Int(0, 99) >= share ? 0
                : draw->Int(0, 1) == 0    ? kSliceOne
                                          : draw->Int(0, kSliceOne);
      }
      int16_t* at = samples.data() + 4 * row * plane + n;
      for (size_t c = 0; c < 3; ++c) at[c * plane] = int16_t(cover * draw->Int(0, 255) / 256);
      at[3 * plane] = int16_t(cover);
    }
  }
  return samples;
}

}  // namespace

void ShiftSlice(Draw* draw, KernelCall* call) {
  const size_t rows = draw->Length(1, 70, kTimedSamples / 4 / kSliceLanes);
  const size_t more = draw->Size(0, 48, 0), in_plane = kSliceLanes + 3 + more;
  std::vector<int16_t> samples = Planes(rows, in_plane, draw->Int(0, 1) == 0 ? 20 : kFull, draw);
  const size_t first = size_t(draw->Int(0, int(more)));
  std::vector<SliceCover> cover;
  for (size_t row = 0; row < rows; ++row) {
    int16_t* const at = samples.data() + 4 * row * in_plane;
    if (draw->Rarely(6)) std::fill_n(at, 4 * in_plane, int16_t{0});
    const int16_t *shown = at + 3 * in_plane + first, *end = shown + kSliceLanes + 3;
    const uint64_t some = uint64_t(std::any_of(shown, end, [](int16_t n) { return n != 0; }));
    const uint64_t all =
        uint64_t(std::all_of(shown, end, [](int16_t n) { return n == kSliceOne; }));
    // Bits of other groups do not matter, and a group may be marked without need.
    const bool marked = some != 0 || draw->Rarely(3);
    cover.push_back({(marked ? uint64_t{2} : 0) | 5, (all != 0 ? uint64_t{2} : 0) | 5});
  }
  // The memory of `in` ends with the last sample that the kernel reads.
  samples.resize(samples.size() - (more - first));
  const int16_t* in = call->Input("in", samples) + first;
  const SliceOffset offset = Offset(draw->Int(-3, 3), draw);
  const size_t before = draw->Size(0, 70, 0);
  const StripSlice out = {call->Results<int16_t>("samples", (before + rows) * kStripRow),
                          call->Results<RowCover>("cover", RowCovers(before + rows)),
                          RowCovers(before + rows)};
  std::fill_n(out.samples, (before + rows) * kStripRow, int16_t{9});
  const SliceRows from = {in - offset.whole, in_plane, call->Input("cover", cover), 2,
                          !draw->Rarely(2)};
  call->Calls(&Kernels::ShiftSlice, from, offset, before, before + rows, out);
  call->is_right = [=](uint64_t, Met* met) {
    for (size_t n = 0; n < RowCovers(before + rows); ++n) {
      (*met)["some"] += out.cover[n].some != 0;
      (*met)["all"] += out.cover[n].all != 0;
    }
    return true;
  };
}

namespace {

// Makes the samples of a slice in a strip, with some empty rows, and their coverage.
StripSlice MakeTile(size_t rows, Draw* draw, KernelCall* call, Met* met) {
  const bool full = draw->Int(0, 1) == 0;
  std::vector<int16_t> samples = Planes(rows, kSliceLanes, full ? kFull : draw->Int(5, 100), draw);
  std::vector<RowCover> cover(RowCovers(rows), RowCover{0, 0});
  for (size_t row = 0; row < rows; ++row) {
    int16_t* const at = samples.data() + row * kStripRow;
    if (draw->Rarely(full ? 12 : 4)) std::fill_n(at, kStripRow, int16_t{0});
    for (size_t half = 0; half < 2; ++half) {
      const int16_t *shown = at + 3 * kSliceLanes + half * kHalfStrip, *end = shown + kHalfStrip;
      RowCover& bits = cover[row / 64 * 2 + half];
      const bool some = std::any_of(shown, end, [](int16_t n) { return n != 0; });
      const bool all = std::all_of(shown, end, [](int16_t n) { return n == kSliceOne; });
      bits.some |= uint64_t{some} << row % 64;
      bits.all |= uint64_t{all} << row % 64;
      (*met)["all"] += all;
      (*met)["none"] += !some;
    }
  }
  return {call->Input("slice", samples), call->Input("cover", cover), cover.size()};
}

// Views move slices by at most kMost rows.
constexpr size_t kMost = 4;

SliceViews MakeViews(size_t rows, Draw* draw, KernelCall* call, Met* met) {
  const size_t count = draw->Size(1, 6, 2), view_count = draw->Size(1, 9, 5);
  const auto weights = Ints<int16_t>(view_count, 0, std::min(16383, 58000 / int(view_count)), draw);
  std::vector<SliceOffset> offsets;
  for (size_t n = 0; n < view_count * count; ++n) {
    offsets.push_back(Offset(draw->Int(-int(kMost), int(kMost)), draw));
  }
  std::vector<SeenSlice> seen;
  for (size_t k = 0; k < count; ++k) {
    if (draw->Rarely(5)) continue;
    const size_t before = kMost + draw->Size(0, 70, 0);
    const StripSlice slice = MakeTile(before + rows + kMost + kRowsAhead, draw, call, met);
    const uint32_t shown = draw->Rarely(3) ? uint32_t(draw->Next()) : ~uint32_t{0};
    seen.push_back({slice, before, k, shown});
  }
  return {call->Input("weights", weights),
          call->Input("offsets", offsets),
          view_count,
          count,
          call->Input("seen", seen),
          seen.size(),
          draw->Rarely(2) ? draw->Int(0, 4) : 0};
}

}  // namespace

void Composite(Draw* draw, KernelCall* call) {
  const size_t rows = draw->Length(1, int(kMostRows), int(kMostRows));
  Met covered;
  const SliceViews views = MakeViews(rows, draw, call, &covered);
  auto* sums = call->Results<uint32_t>("sums", kStripRow * rows);
  for (size_t n = 0; n < kStripRow * rows; ++n) sums[n] = uint32_t(draw->Int(0, 1 << 30));
  call->Calls(&Kernels::Composite, views, rows, sums);
  call->is_right = [=](uint64_t, Met* met) {
    for (const auto& one : covered) (*met)[one.first] += one.second;
    return true;
  };
}

// The coverage of a pixel mostly equals the coverage of the previous pixel; otherwise it is full,
// zero, arbitrary or near the limit. In the benchmark, coverage changes from pixel to pixel as
// seldom as in pictures.
void FinishComposite(Draw* draw, KernelCall* call) {
  const size_t count = draw->Length(1, 70, kTimedSamples / 3), whole = SliceSamples(count);
  const size_t plane = whole + draw->Size(0, 5, 0);
  const auto least = uint32_t(draw->Int(1, 90000));
  const int bits = draw->Int(kLightBits, 24);
  const uint32_t all = 4 * least + uint32_t(draw->Int(0, 5));
  std::vector<uint32_t> values(3 * plane + whole);
  uint32_t covered = all;
  for (size_t n = 0; n < whole; ++n) {
    const int kind = draw->Int(0, draw->timed() ? 199 : 19);
    if (kind < 2) covered = all;
    if (kind == 2) covered = 0;
    if (kind == 3) covered = uint32_t(draw->Int(0, int(all)));
    if (kind == 4) covered = least - uint32_t(draw->Int(0, 1));
    values[3 * plane + n] = covered;
    for (size_t c = 0; c < 3; ++c) {
      const int colour = kind == 5 ? 256 : kind == 6 ? 255 : draw->Int(0, 255);
      values[c * plane + n] = uint32_t(uint64_t{covered} * uint64_t(colour) / 256);
    }
  }
  const uint32_t* sums = call->Input("sums", values);
  for (size_t c = 0; c < 4; ++c) {
    call->Ignore(sums + c * plane + count, (c < 3 ? plane : whole) - count);
  }
  const int16_t* centre = call->Input("centre", Light(3 * count, draw), kPadding);
  auto* out = call->Results<uint32_t>("out", 3 * count);
  call->Calls(&Kernels::FinishComposite, sums, plane, centre, least, bits, count, out);
}

}  // namespace test::kernel_cases
