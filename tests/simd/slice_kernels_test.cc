// The kernels of slices on every SIMD target of this machine against the plain C++ that defines
// them.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "simd/kernels.h"
#include "tests/support/disparity_row.h"
#include "tests/support/simd_targets.h"
#include "tests/support/test_scene.h"

namespace {

using starfocus::simd::Kernels;
using starfocus::simd::kPadding;
using starfocus::simd::kSliceLanes;
using starfocus::simd::kSliceOne;
using starfocus::simd::ReferenceKernels;
using starfocus::simd::SliceCover;
using starfocus::simd::SliceFraction;
using starfocus::simd::SliceOffset;
using starfocus::simd::TileSlice;

// Samples that kernels write and read of a row.
size_t Whole(size_t count) { return starfocus::simd::SliceSamples(count); }

void TestSelect(const Kernels& kernels) {
  test::Random random(3);
  for (size_t count = 1; count <= 100; ++count) {
    const size_t whole = Whole(count), plane = whole + size_t(random.Int(0, 20));
    std::vector<int16_t> disparity[3];
    std::vector<uint8_t> rgb[3];
    starfocus::simd::SurfaceRow row = {};
    row.plane = plane;
    for (int k = 0; k < 3; ++k) {
      disparity[k] = test::DisparityRow(whole, &random);
      for (int16_t& d : disparity[k]) {
        if (k > 0 && random.Int(0, 1) == 0) d = INT16_MIN;
      }
      rgb[k] = test::RandomBytes(3 * plane + kPadding, &random);
      row.disparity[k] = disparity[k].data();
      row.rgb[k] = rgb[k].data();
    }
    std::vector<uint8_t> share(whole);
    for (uint8_t& part : share) {
      const int kind = random.Int(0, 3);
      part = uint8_t(kind < 2 ? 128 : kind == 2 ? starfocus::simd::kSliceEnd : random.Int(1, 127));
    }
    row.share = share.data();
    for (size_t bit = 0; bit < 64; ++bit) row.hiding |= uint64_t(random.Int(0, 2) > 0) << bit;
    const int middle = disparity[0][count / 2], range = random.Int(0, 400);
    const starfocus::simd::SliceRange inside = {
        int16_t(middle - range), int16_t(middle + range / 2), int16_t(middle + range)};
    std::vector<int16_t> expected(4 * plane + whole), got = expected;
    const SliceCover a = ReferenceKernels().SelectSlice(row, inside, count, plane, expected.data());
    const SliceCover b = kernels.SelectSlice(row, inside, count, plane, got.data());
    CAPTURE(count);
    CHECK(got == expected);
    CHECK(a.some == b.some);
    CHECK(a.all == b.all);
    CHECK(a.some != 0);
  }
}

// Where views lie: on whole samples, between two alike at edges and inside or not, or on three or
// four of them.
SliceFraction Fraction(test::Random* random) {
  const int taps = random->Int(1, 5), first = random->Int(0, 32767);
  if (taps == 1) return {INT16_MIN, INT16_MIN, 0, 0};
  const auto edge = int16_t(-first);
  if (taps == 2) return {edge, edge, 0, 0};
  if (taps == 3) return {int16_t(random->Int(-32768, 0)), edge, 0, 0};
  const int third = random->Int(1, 32768 - first);
  return {edge, edge, int16_t(-third), int16_t(taps == 4 ? 0 : -random->Int(0, third))};
}

// Colours and coverage of slices: colours at most as large as the coverage. `share` is how many of
// 100 stretches of rows are covered, fully or not; kFull: all of them, fully.
constexpr int kFull = 101;
std::vector<int16_t> Planes(size_t rows, size_t plane, int share, test::Random* random) {
  std::vector<int16_t> samples(4 * rows * plane + 2 * kSliceLanes);
  for (size_t row = 0; row < rows; ++row) {
    int cover = 0;
    for (size_t n = 0; n < plane; ++n) {
      if (random->Int(0, 4) == 0) {
        cover = random->Int(0, 99) >= share ? 0
                : random->Int(0, 1) == 0    ? kSliceOne
                                            : random->Int(0, kSliceOne);
      }
      if (share == kFull) cover = kSliceOne;
      int16_t* at = samples.data() + 4 * row * plane + n;
      for (size_t c = 0; c < 3; ++c) at[c * plane] = int16_t(cover * random->Int(0, 255) / 256);
      at[3 * plane] = int16_t(cover);
    }
  }
  return samples;
}

void TestSpread(const Kernels& kernels) {
  test::Random random(4);
  for (size_t count = 16; count <= 160; count += 16) {
    for (int reach = 1; reach <= 3; ++reach) {
      const std::vector<int16_t> in = Planes(20, 48, 60, &random);
      starfocus::simd::SliceTaps taps = {reach, 0, 0, 0};
      taps.inner = int16_t(reach == 1 ? 0 : random.Int(0, 32767 / reach));
      taps.outer = int16_t(random.Int(0, taps.inner == 0 ? 20000 : taps.inner));
      taps.centre = int16_t(std::min(32767, 32768 - (reach - 1) * taps.inner - taps.outer));
      for (const ptrdiff_t step : {ptrdiff_t{1}, ptrdiff_t{4 * 48}}) {
        std::vector<int16_t> expected(count), got(count);
        const int16_t* at = in.data() + 4 * 48 * 8;
        ReferenceKernels().SpreadSlice(at, step, taps, count, expected.data());
        kernels.SpreadSlice(at, step, taps, count, got.data());
        CHECK(got == expected);
      }
    }
  }
}

void TestShift(const Kernels& kernels) {
  test::Random random(5);
  int covered = 0;
  for (int round = 0; round < 70; ++round) {
    const size_t rows = size_t(random.Int(1, 19)), in_plane = 16 * size_t(random.Int(1, 4)) + 32;
    std::vector<int16_t> in = Planes(rows, in_plane, round % 2 == 0 ? 20 : kFull, &random);
    const size_t empty = size_t(random.Int(0, int(rows) - 1)), plane = kSliceLanes * (rows + 4);
    std::fill_n(in.begin() + ptrdiff_t(4 * empty * in_plane), 4 * in_plane, int16_t{0});
    const SliceFraction fraction = Fraction(&random);
    std::vector<int16_t> expected(4 * plane), got = expected;
    std::vector<uint8_t> near(rows + starfocus::simd::kRowsAhead + 1, 9), got_near = near;
    const starfocus::simd::SlicePlanes from = {in.data() + random.Int(0, 16), in_plane};
    ReferenceKernels().ShiftSlice(from, fraction, rows, plane, expected.data(),
                                  near.data() + starfocus::simd::kRowsAhead);
    kernels.ShiftSlice(from, fraction, rows, plane, got.data(),
                       got_near.data() + starfocus::simd::kRowsAhead);
    CAPTURE(round);
    CHECK(got == expected);
    CHECK(got_near == near);
    CHECK(near.back() == 9);
    covered += int(std::count(near.begin(), near.end(), starfocus::simd::kCoveredNear));
  }
  CHECK(covered > 0);
}

// A slice in a tile: planes of rows of kSliceLanes samples, some rows empty or, of every other one,
// none.
struct TileMemory {
  std::vector<int16_t> samples;
  std::vector<uint8_t> near;
};

TileMemory MakeTile(size_t rows, test::Random* random) {
  const size_t plane = rows * kSliceLanes, ahead = starfocus::simd::kRowsAhead;
  const bool full = random->Int(0, 1) == 0;
  const int share = full ? kFull : random->Int(5, 100);
  const std::vector<int16_t> in = Planes(rows, kSliceLanes, share, random);
  TileMemory slice = {std::vector<int16_t>(4 * plane), std::vector<uint8_t>(rows)};
  std::vector<int> covered(rows + ahead);  // samples of each row
  for (size_t row = 0; row < rows; ++row) {
    if (random->Int(0, full ? 11 : 3) == 0) continue;
    for (size_t n = 0; n < 4 * kSliceLanes; ++n) {
      const int16_t sample = in[4 * row * kSliceLanes + n];
      slice.samples[n / kSliceLanes * plane + row * kSliceLanes + n % kSliceLanes] = sample;
      covered[row] += sample != 0;
    }
  }
  for (size_t row = 0; row < rows; ++row) {
    const auto first = covered.begin() + ptrdiff_t(row), end = first + ptrdiff_t(ahead) + 1;
    if (std::any_of(first, end, [](int count) { return count > 0; })) {
      slice.near[row] = full && std::find(first, end, 0) == end ? starfocus::simd::kCoveredNear
                                                                : starfocus::simd::kSomethingNear;
    }
  }
  return slice;
}

void TestComposite(const Kernels& kernels) {
  test::Random random(6);
  ptrdiff_t covered = 0;
  for (int round = 0; round < 200; ++round) {
    const size_t rows = size_t(random.Int(1, 9));
    const size_t slices = size_t(random.Int(1, 6)), views = size_t(random.Int(1, 9));
    std::vector<TileMemory> memory;
    std::vector<TileSlice> tiles;
    for (size_t k = 0; k < slices; ++k) {
      memory.push_back(MakeTile(rows + 9 + starfocus::simd::kRowsAhead, &random));
    }
    constexpr size_t kMost = 4;  // rows that views move by
    for (const TileMemory& tile : memory) {
      tiles.push_back({tile.samples.data() + kMost * kSliceLanes, tile.near.data() + kMost,
                       tile.samples.size() / 4});
    }
    std::vector<int16_t> weights(views);
    for (int16_t& weight : weights)
      weight = int16_t(random.Int(0, std::min(16383, 58000 / int(views))));
    std::vector<SliceOffset> offsets;
    for (size_t n = 0; n < views * slices; ++n) {
      offsets.push_back({random.Int(-int(kMost), int(kMost)), Fraction(&random)});
    }
    std::vector<uint8_t> shown;
    for (size_t k = 0; k < slices; ++k) {
      if (random.Int(0, 4) > 0) shown.push_back(uint8_t(k));
    }
    const starfocus::simd::SliceViews job = {
        weights.data(), offsets.data(), views, tiles.data(), slices, shown.data(), shown.size(), 1};
    std::vector<uint32_t> expected(4 * (rows + 1) * kSliceLanes, 5), got = expected;
    ReferenceKernels().Composite(job, rows, expected.data());
    kernels.Composite(job, rows, got.data());
    CAPTURE(round);
    CHECK(got == expected);
    CHECK(expected.back() == 5);
    for (const TileMemory& tile : memory) {
      covered += std::count(tile.near.begin(), tile.near.end(), starfocus::simd::kCoveredNear);
    }
  }
  CHECK(covered > 200);
}

TEST_CASE("slice kernels: every target gives the bits of the plain ones") {
  for (const Kernels* kernels : test::SimdTargets()) {
    CAPTURE(kernels->name);
    TestSelect(*kernels);
    TestSpread(*kernels);
    TestShift(*kernels);
    TestComposite(*kernels);
  }
}

}  // namespace
