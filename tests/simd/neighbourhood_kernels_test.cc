// The kernels of what lies around cells on every SIMD target of this machine against the plain C++
// that defines them.
#include <doctest/doctest.h>

#include <cstdint>
#include <cstring>
#include <vector>

#include "simd/kernels.h"
#include "tests/support/simd_targets.h"
#include "tests/support/test_scene.h"

namespace {

using starfocus::simd::BlockReach;
using starfocus::simd::CellPlanes;
using starfocus::simd::kCellPlanes;
using starfocus::simd::Kernels;
using starfocus::simd::kSliceLanes;
using starfocus::simd::ReferenceKernels;

constexpr int16_t kMargins[3] = {0, 4, 12};

// `columns` x `rows` cells and as many around them as a block or cell looks at.
struct RandomCells {
  RandomCells(int of_around, int columns, int rows, test::Random* random)
      : around(of_around),
        stride(size_t(columns + 2 * around)),
        plane(stride * size_t(rows + 2 * around)),
        samples(kCellPlanes * plane + 2 * kSliceLanes) {
    const int far = random->Int(0, 2) == 0 ? 8 * around : 20;
    const int most = random->Int(0, 3) == 0 ? 32000 : 300;
    for (size_t n = 0; n < plane; ++n) {
      const int reach = random->Int(0, 3) == 0 ? random->Int(1, far) : random->Int(1, 9);
      const int low = random->Int(-most, most);
      for (size_t side = 0; side < 4; ++side) {
        Plane(side)[n] = int16_t(random->Int(-8, reach));
        Plane(4 + side)[n] = int16_t(random->Int(0, 8));
      }
      Plane(starfocus::simd::kReachPlane)[n] = int16_t(reach);
      Plane(starfocus::simd::kRadiusPlane)[n] = int16_t(64 * reach);
      Plane(starfocus::simd::kEdgePlane)[n] = int16_t(random->Int(0, 9) == 0 ? 60 * reach : 0);
      Plane(starfocus::simd::kLowPlane)[n] = int16_t(low);
      Plane(starfocus::simd::kHighPlane)[n] = int16_t(random->Int(low, most));
    }
  }

  int16_t* Plane(size_t index) { return samples.data() + index * plane; }
  CellPlanes At(int column, int row) const {
    return {samples.data() + size_t(row + around) * stride + size_t(column + around), plane,
            stride};
  }

  int around;
  size_t stride, plane;
  std::vector<int16_t> samples;
};

void TestReachBlock(const Kernels& kernels) {
  test::Random random(1);
  for (int round = 0; round < 300; ++round) {
    const RandomCells cells(random.Int(1, 12), 6, 4, &random);
    for (int column = 0; column < 6; column += 2) {
      BlockReach expected, got;
      std::memset(&got, test::kPoison, sizeof(got));
      ReferenceKernels().ReachBlock(cells.At(column, 2), cells.around, kMargins, &expected);
      kernels.ReachBlock(cells.At(column, 2), cells.around, kMargins, &got);
      CAPTURE(round);
      const bool same = std::memcmp(&got, &expected, sizeof(got)) == 0;
      CHECK(same);
    }
  }
}

struct Ranges {
  std::vector<int16_t> low, high, edge;
  std::vector<uint16_t> widest;

  Ranges(const Kernels& kernels, const RandomCells& cells, int row, size_t count)
      : low(count + kSliceLanes), high(low), edge(low), widest(low.size()) {
    kernels.SurroundCells(cells.At(0, row), cells.around, count,
                          {low.data(), high.data(), widest.data(), edge.data()});
    for (auto* plane : {&low, &high, &edge}) plane->resize(count);
    widest.resize(count);
  }
};

void TestSurroundCells(const Kernels& kernels) {
  test::Random random(2);
  for (int round = 0; round < 60; ++round) {
    const int count = random.Int(1, 33);
    const RandomCells cells(random.Int(1, 8), count, 3, &random);
    for (int row = 0; row < 3; ++row) {
      const Ranges expected(ReferenceKernels(), cells, row, size_t(count));
      const Ranges got(kernels, cells, row, size_t(count));
      CAPTURE(round);
      CHECK(got.low == expected.low);
      CHECK(got.high == expected.high);
      CHECK(got.widest == expected.widest);
      CHECK(got.edge == expected.edge);
    }
  }
}

TEST_CASE("surroundings kernels: every target gives the bits of the plain ones") {
  for (const Kernels* kernels : test::SimdTargets()) {
    CAPTURE(kernels->name);
    TestReachBlock(*kernels);
    TestSurroundCells(*kernels);
  }
}

}  // namespace
