// SPDX-License-Identifier: Apache-2.0
// Test and benchmark calls of the kernels for disparities (simd/disparities.h) and for the cells of
// a plan (simd/cells.h).
#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/kernels/kernel_cases.h"

namespace test::kernel_cases {
namespace {

CellLimits DrawCellLimits(Draw* draw) {
  CellLimits limits;
  limits.focus = int16_t(draw->Rarely(3) ? draw->Int(-32768, 32767) : draw->Int(-200, 200));
  limits.edge = int16_t(draw->Rarely(4) ? draw->Int(0, 4369) : draw->Int(0, 96));
  limits.slope_limit = int16_t(draw->Rarely(4) ? 32767 : draw->Int(1, 96));
  limits.gap_limit = int16_t(draw->Rarely(4) ? 32767 : draw->Int(0, 2000));
  return limits;
}

// Returns disparities of all sizes. The benchmark uses a surface without edges, which is the common
// case.
std::vector<int16_t> CellDisparities(size_t count, Draw* draw) {
  const int kind = draw->timed() ? 5 : draw->Int(0, 5);
  const int most = kind == 0 ? 32000 : kind == 1 ? 7000 : kind == 2 ? 200 : kind == 5 ? 0 : 60;
  return Filled<int16_t>(count, [&] {
    const int any = draw->Int(-most, most);
    return kind != 4 ? any : draw->Int(0, 1) == 0 ? -32000 : 32000;
  });
}

// Calls `take` for each field of a cell's measure. The fields are compared separately, so that the
// padding between fields is not compared.
template <class Take>
void ForFields(const CellMeasure& m, const Take& take) {
  take(&m.low, 1);
  take(&m.high, 1);
  take(&m.nearest, 1);
  take(&m.edge_low, 1);
  take(&m.edge_high, 1);
  for (const auto* sums : {m.slopes, m.edges, m.gaps}) take(sums, 2);
}

}  // namespace

namespace {

// Makes the rows of `cells` adjacent cells, and their neighbours.
const int16_t* const* CellRows(size_t cells, Draw* draw, KernelCall* call) {
  const size_t width = 8 * cells + 2, stride = width + draw->Size(0, 9, 0);
  const int16_t* in = call->Input("disparity", CellDisparities(9 * stride + width, draw), kPadding);
  call->IgnoreRows(in + width, 9, stride, stride - width);
  std::vector<const int16_t*> rows;
  for (size_t n = 0; n < 10; ++n) rows.push_back(in + n * stride);
  return call->Input("rows", rows);
}

}  // namespace

void MeasureCell(Draw* draw, KernelCall* call) {
  const size_t cells = draw->Size(1, 3, kTimedSamples / 64);  // in one row
  const int16_t* const* rows = CellRows(cells, draw, call);
  const CellLimits limits = DrawCellLimits(draw);
  auto* measures = call->Output<CellMeasure>("measure", cells);
  for (size_t cell = 0; cell < cells; ++cell) {
    call->Free(&measures[cell], 1);
    ForFields(measures[cell],
              [&](const auto* first, int count) { call->Result(first, size_t(count)); });
  }
  call->RunsEach(cells, [=](const Kernels& kernels, size_t cell) {
    kernels.MeasureCell(rows, 1 + 8 * cell, limits, &measures[cell]);
  });
}

void MeasureLines(Draw* draw, KernelCall* call) {
  const size_t cells = draw->Size(1, 3, kTimedSamples / 64);  // in one row
  const int16_t* const* rows = CellRows(cells, draw, call);
  auto* lines = call->Results<CellLines>("lines", cells);
  call->RunsEach(cells, [=](const Kernels& kernels, size_t cell) {
    kernels.MeasureLines(rows, 1 + 8 * cell, &lines[cell]);
  });
}

namespace {

// Returns a random reach of a cell's blur, in pixels. In the benchmark, all reaches are small.
int Reach(int around, Draw* draw) {
  const int far = draw->Rarely(3) ? kCellPixels * around : 20;
  return draw->Int(0, 3) == 0 && !draw->timed() ? draw->Int(1, far) : draw->Int(1, 9);
}

// Makes planes of cells, `plane` apart, whose rows are `stride` apart, with a border of `around`
// cells. Returns the first cell inside the border.
const int16_t* MakeCells(size_t plane, size_t stride, size_t around, Draw* draw, KernelCall* call) {
  const int most = draw->Rarely(4) ? 32000 : 300;
  std::vector<int16_t> samples(kCellPlanes * plane);
  for (size_t n = 0; n < plane; ++n) {
    const auto set = [&](size_t index, int value) { samples[index * plane + n] = int16_t(value); };
    const int reach = Reach(int(around), draw), low = draw->Int(-most, most);
    for (size_t side = 0; side < 4; ++side) {
      set(kReachLeft + side, draw->Int(-8, reach));
      set(kInsideLeft + side, draw->Int(0, kCellPixels));
    }
    set(kReachPlane, reach);
    set(kRadiusPlane, 64 * reach);
    set(kEdgePlane, draw->Int(0, 9) == 0 ? 60 * reach : 0);
    set(kLowPlane, low);
    set(kHighPlane, draw->Int(low, most));
  }
  const int16_t* cells = call->Input("cells", samples, kPadding);
  return cells + around * (stride + 1);
}

}  // namespace

void ReachBlock(Draw* draw, KernelCall* call) {
  const size_t blocks = draw->Size(1, 3, 48);  // in one row
  const auto around = int32_t(draw->Length(1, 12, 2));
  const size_t stride = 2 * blocks + 2 * size_t(around), plane = stride * (2 + 2 * size_t(around));
  const int16_t* cells = MakeCells(plane, stride, size_t(around), draw, call);
  auto* reaches = call->Results<BlockReach>("reach", blocks);
  call->RunsEach(blocks, [=](const Kernels& kernels, size_t block) {
    constexpr int16_t kMargins[3] = {0, 4, 12};
    kernels.ReachBlock(cells + 2 * block, plane, stride, around, kMargins, &reaches[block]);
  });
}

void SurroundCells(Draw* draw, KernelCall* call) {
  const size_t count = draw->Length(1, 33, 48), whole = SliceSamples(count);
  const auto around = int32_t(draw->Size(1, 8, 2));
  const size_t stride = count + 2 * size_t(around), plane = stride * (1 + 2 * size_t(around));
  const int16_t* cells = MakeCells(plane, stride, size_t(around), draw, call);
  auto* low = call->Results<int16_t>("low", count, whole - count);
  auto* high = call->Results<int16_t>("high", count, whole - count);
  auto* widest = call->Results<uint16_t>("widest", count, whole - count);
  auto* edge = call->Results<int16_t>("edge", count, whole - count);
  call->Calls(&Kernels::SurroundCells, cells, plane, stride, around, count, low, high, widest,
              edge);
}

namespace {

// Returns disparities in [low, high]: the limits, values halfway between steps of 1/64, and
// arbitrary values.
std::vector<float> DisparitiesWithin(size_t count, float low, float high, Draw* draw) {
  return Filled<float>(count, [&] {
    const int kind = draw->Int(0, 4);
    const double exact = draw->Real(low, high), tie = (std::floor(exact * 64) + 0.5) / 64;
    if (kind < 2) return kind == 0 ? low : high;
    return std::clamp(float(kind == 2 ? tie : exact), low, high);
  });
}

}  // namespace

void ConvertDisparity(Draw* draw, KernelCall* call) {
  constexpr float kLimits[] = {500, 7.3f, 0, 511},
                  kInfinity = std::numeric_limits<float>::infinity();
  const size_t count = draw->Length(1, kLongestBytes, kTimedSamples);
  const float high = kLimits[draw->Int(0, 3)], low = draw->Int(0, 1) == 0 ? -high : high / 2;
  std::vector<float> values = DisparitiesWithin(count, low, high, draw);
  const float outside[] = {std::numeric_limits<float>::quiet_NaN(), kInfinity, -kInfinity,
                           std::nextafter(high, kInfinity), std::nextafter(low, -kInfinity)};
  const bool spoilt = draw->Rarely(3);
  if (spoilt) values[size_t(draw->Int(0, int(count) - 1))] = outside[draw->Int(0, 4)];
  const float* disparity = call->Input("disparity", values, kPadding);
  auto* out = call->Results<int16_t>("out", count);
  call->Calls(&Kernels::ConvertDisparity, disparity, count, low, high, out);
  call->is_right = [=](uint64_t all_within, Met* met) {
    if (all_within == 0) call->Free(out, count);
    (*met)["refused"] += all_within == 0;
    return all_within == !spoilt;
  };
}

void FindRanges(Draw* draw, KernelCall* call) {
  const size_t count = draw->Length(1, 70, 128), whole = SliceSamples(count);
  const size_t rows = draw->Size(1, 9, kTimedSamples / 128);
  const size_t stride = count + size_t(draw->Int(0, 5));
  const int most = draw->Int(0, 2) == 0 ? 32767 : 90, absent = draw->Int(0, 4);
  const auto in = Filled<int16_t>((rows - 1) * stride + whole, [&] {
    return draw->Int(0, 3) < absent ? kNoSurface : draw->Int(-most, most);
  });
  const int16_t* disparity = call->Input("disparity", in);
  call->IgnoreRows(disparity + count, rows - 1, stride, stride - count);
  call->Ignore(disparity + (rows - 1) * stride + count, whole - count);
  auto* ranges = call->Results<DisparityRange>("ranges", whole / kSliceLanes);
  call->Calls(&Kernels::FindRanges, disparity, stride, rows, count, ranges);
}

void FindWithin(Draw* draw, KernelCall* call) {
  const size_t rows = draw->Length(1, 9, kTimedSamples / kSliceLanes);
  const size_t stride = draw->Size(16, 40, kSliceLanes);
  const auto in = Filled<int16_t>((rows - 1) * stride + kSliceLanes, [&] {
    return draw->Int(-40, 40) * (draw->Int(0, 3) == 0 ? 819 : 1);
  });
  const int16_t* disparity = call->Input("disparity", in);
  const auto low = int16_t(draw->Int(-45, 35));
  const auto high = int16_t(draw->Int(0, 3) == 0 ? INT16_MAX : draw->Int(low, 45));
  auto* within = call->Results<uint16_t>("within", rows);
  call->Calls(&Kernels::FindWithin, disparity, stride, rows, DisparityRange{low, high}, within);
}

}  // namespace test::kernel_cases
