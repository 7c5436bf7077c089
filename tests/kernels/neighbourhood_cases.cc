// SPDX-License-Identifier: Apache-2.0
// Test and benchmark calls of the kernels in simd/cells.h.
#include "tests/kernels/kernel_cases.h"

namespace test::kernel_cases {
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
  call->Runs([=](const Kernels& kernels) {
    constexpr int16_t kMargins[3] = {0, 4, 12};
    for (size_t block = 0; block < blocks; ++block) {
      kernels.ReachBlock(cells + 2 * block, plane, stride, around, kMargins, &reaches[block]);
    }
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
  call->Runs([=](const Kernels& kernels) {
    kernels.SurroundCells(cells, plane, stride, around, count, low, high, widest, edge);
  });
}

}  // namespace test::kernel_cases
