// SPDX-License-Identifier: Apache-2.0
// Test and benchmark calls of the kernels in simd/slices.h.
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

// Makes a row of `count` pixels with surfaces; hidden surfaces are often missing. Values that the
// kernel does not read are arbitrary.
SurfaceRow MakeSurfaces(size_t count, Draw* draw, KernelCall* call) {
  const size_t whole = SliceSamples(count);
  SurfaceRow row = {};
  row.plane = whole + draw->Size(0, 20, 0);
  for (size_t group = 0; group < 64; ++group) {
    row.hiding |= uint64_t{draw->Int(0, 2) > 0} << group;
  }
  const uint8_t* share = call->Input("share", MostlyWholeShares(whole, draw));
  row.share = share;
  for (int k = 0; k < kSurfaces; ++k) {
    std::vector<int16_t> disparities = Disparities(whole, draw);
    for (int16_t& d : disparities) d = k > 0 && draw->Int(0, 1) == 0 ? kNoSurface : d;
    const int16_t* disparity = call->Input("disparity", disparities);
    const int16_t* rgb = call->Input("rgb", Light(2 * row.plane + whole, draw));
    for (size_t n = 0; n < whole; ++n) {
      const bool counts = n < count && (k == 0 || (row.hiding >> n / kSliceLanes & 1) != 0);
      if (!counts) call->Ignore(disparity + n, 1);
      if (counts && disparity[n] != kNoSurface) continue;
      for (size_t c = 0; c < 3; ++c) call->Ignore(rgb + c * row.plane + n, 1);
    }
    row.disparity[k] = disparity;
    row.rgb[k] = rgb;
  }
  for (size_t n = 0; n < whole; ++n) {
    if (n >= count || (row.hiding >> n / kSliceLanes & 1) == 0) call->Ignore(share + n, 1);
  }
  return row;
}

}  // namespace

void SelectSlice(Draw* draw, KernelCall* call) {
  const size_t count = draw->Length(1, 100, kTimedSamples / 4), whole = SliceSamples(count);
  const size_t plane = whole + draw->Size(0, 20, 0);
  const SurfaceRow row = MakeSurfaces(count, draw, call);
  const int middle = row.disparity[0][count / 2], more = draw->Int(0, 400);
  const auto low = int16_t(std::max(-32700, middle - more));
  const auto high = int16_t(std::min(32700, middle + more / 2));
  const auto overlap = int16_t(std::min(32700, middle + more));
  auto* out = call->Output<int16_t>("out", 3 * plane + whole);
  call->ResultRows(out, 4, plane, count, whole - count);
  auto* cover = call->Results<SliceCover>("cover", 1);
  call->Runs([=](const Kernels& kernels) {
    *cover = kernels.SelectSlice(row, low, high, overlap, count, plane, out);
  });
  call->is_right = [=](uint64_t, Met* met) {
    SliceCover expected = {0, (uint64_t{1} << whole / kSliceLanes) - 1};
    for (size_t n = 0; n < count; ++n) {
      const uint64_t bit = uint64_t{1} << n / kSliceLanes;
      const int16_t covered = out[3 * plane + n];
      if (covered > 0) expected.some |= bit;
      if (covered < kSliceOne) expected.all &= ~bit;
      (*met)[covered == 0 ? "none" : covered < kSliceOne ? "a part" : "all"] += 1;
    }
    (*met)["groups covered"] += expected.all != 0;
    return cover->some == expected.some && cover->all == expected.all;
  };
}

// SpreadSlice spreads samples that are `step` apart, either in a row or in a column of planes.
void SpreadSlice(Draw* draw, KernelCall* call) {
  const size_t count = draw->Length(1, 160, kTimedSamples), whole = SliceSamples(count);
  SliceTaps taps = {int32_t(draw->Size(1, kMaxSpread, 2)), 0, 0, 0};
  taps.inner = int16_t(taps.reach == 1 ? 0 : draw->Int(0, 32767 / taps.reach));
  taps.outer = int16_t(draw->Int(0, taps.inner == 0 ? 20000 : taps.inner));
  taps.centre = int16_t(std::min(32767, 32768 - (taps.reach - 1) * taps.inner - taps.outer));
  const size_t step = draw->Rarely(2) ? 4 * 48 : 1, before = size_t(taps.reach) * step;
  const int bright = draw->Int(0, 4);
  const auto samples = Filled<int16_t>(whole + 2 * before, [&] {
    return draw->Int(0, 4) < bright ? kSliceOne : draw->Int(0, kSliceOne);
  });
  const int16_t* in = call->Input("in", samples) + before;
  auto* out = call->Results<int16_t>("out", whole);
  call->Runs(
      [=](const Kernels& kernels) { kernels.SpreadSlice(in, ptrdiff_t(step), taps, count, out); });
  call->is_right = [=](uint64_t, Met* met) {
    (*met)["saturated"] += std::count(out, out + whole, kSliceOne);
    return true;
  };
}

}  // namespace test::kernel_cases
