// The kernels of surfaces on every SIMD target of this machine against the plain C++ that defines
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

using starfocus::simd::DepthRow;
using starfocus::simd::HiddenRow;
using starfocus::simd::Kernels;
using starfocus::simd::kPadding;
using starfocus::simd::kSliceLanes;
using starfocus::simd::ReferenceKernels;
using starfocus::simd::StepBits;

// Samples that kernels write and read of a row.
size_t Whole(size_t count) { return starfocus::simd::SliceSamples(count); }

void TestSplit(const Kernels& kernels) {
  test::Random random(1);
  for (size_t count = 1; count <= 70; ++count) {
    const std::vector<uint8_t> rgb = test::RandomBytes(3 * count + kPadding, &random);
    const size_t plane = count + size_t(random.Int(0, 9));
    std::vector<uint8_t> expected(3 * plane, 7), got = expected;
    ReferenceKernels().Split(rgb.data(), count, plane, expected.data());
    kernels.Split(rgb.data(), count, plane, got.data());
    CAPTURE(count);
    CHECK(got == expected);
    CHECK(expected[2 * plane + count - 1] == rgb[3 * count - 1]);
  }
}

void TestFindEdges(const Kernels& kernels) {
  test::Random random(2);
  for (size_t count = 1; count <= 50; ++count) {
    const starfocus::simd::EdgeLimits limits = {48, random.Int(6, 8)};
    const size_t whole = Whole(count);
    std::vector<int16_t> moved(whole, INT16_MAX), behind(whole, 0),
        far = test::DisparityRow(whole, &random);
    std::vector<int16_t> got_moved = moved, got_behind = behind;
    int hidden = 0;
    for (int row = 0; row < 20; ++row) {
      std::vector<int16_t> near = far;
      for (int16_t& d : near) {
        if (random.Int(0, 3) == 0)
          d = int16_t(std::clamp(d + random.Int(-300, 600), -32000, 32000));
      }
      std::vector<uint8_t> expected(whole), got(whole);
      ReferenceKernels().FindEdges(near.data(), far.data(), limits, count, moved.data(),
                                   behind.data(), expected.data());
      kernels.FindEdges(near.data(), far.data(), limits, count, got_moved.data(), got_behind.data(),
                        got.data());
      CAPTURE(count);
      CHECK(got == expected);
      CHECK(got_moved == moved);
      CHECK(got_behind == behind);
      for (const uint8_t distance : expected) hidden += distance > 0;
      far = near;
    }
    CHECK(hidden > 0);
  }
}

void TestSteps(const Kernels& kernels) {
  test::Random random(3);
  for (size_t count = 1; count <= 70; ++count) {
    const size_t stride = count + size_t(random.Int(2, 9));
    const std::vector<int16_t> rows = test::DisparityRow(3 * stride + kPadding, &random);
    const int16_t* row = rows.data() + stride + 1;
    const size_t chunks = Whole(count) / kSliceLanes;
    std::vector<StepBits> expected(chunks), got(chunks);
    ReferenceKernels().FindSteps(row, count, 48, expected.data());
    kernels.FindSteps(row, count, 48, got.data());
    std::vector<uint16_t> beside(chunks), got_beside(chunks);
    ReferenceKernels().BesideSteps(row, ptrdiff_t(stride), count, 48, beside.data());
    kernels.BesideSteps(row, ptrdiff_t(stride), count, 48, got_beside.data());
    CAPTURE(count);
    CHECK(got_beside == beside);
    for (size_t chunk = 0; chunk < chunks; ++chunk) {
      CHECK(got[chunk].falls == expected[chunk].falls);
      CHECK(got[chunk].rises == expected[chunk].rises);
    }
    for (size_t n = 0; n < count; ++n) {
      const StepBits& bits = expected[n / kSliceLanes];
      CHECK((bits.falls >> n % kSliceLanes & 1) == int(row[n] - row[n + 1] > 48));
      CHECK((bits.rises >> n % kSliceLanes & 1) == int(row[n + 1] - row[n] > 48));
    }
  }
}

// A field of disparities with edges, of which some are as far away as any.
struct DepthField {
  int width, height;
  size_t stride;
  std::vector<int16_t> samples;
  std::vector<uint8_t> edges[4];
  DepthRow row = {};

  DepthField(int columns, int rows, test::Random* random)
      : width(columns), height(rows), stride(Whole(size_t(columns))) {
    samples.assign(stride * size_t(height) + 2 * kSliceLanes, starfocus::simd::kNoSurface);
    row.unit_bits = random->Int(6, 8);
    row.side_views = random->Int(0, 4) > 0;
    row.half_views = row.side_views && random->Int(0, 1) == 0;
    row.stride = ptrdiff_t(stride);
    row.width = width;
    const int limit = random->Int(0, 3) == 0 ? 32000 : 12 << row.unit_bits;
    row.high = int16_t(-limit);
    for (int patch = 0; patch < 1 + width * height / 24; ++patch) {
      const int x = random->Int(0, width - 1), y = patch == 0 ? 0 : random->Int(0, height - 1);
      const int right = patch == 0 ? width : std::min(width, x + random->Int(1, 9));
      const int bottom = patch == 0 ? height : std::min(height, y + random->Int(1, 9));
      const auto value = int16_t(random->Int(-limit, limit));
      for (int v = y; v < bottom; ++v) {
        for (int u = patch == 0 ? 0 : x; u < right; ++u) *At(u, v) = value;
      }
    }
    for (int y = 0; y < height; ++y)
      row.high = std::max(row.high, *std::max_element(At(0, y), At(width, y)));
    for (std::vector<uint8_t>& distances : edges) distances.assign(stride * size_t(height), 0);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) SetEdges(x, y, random);
    }
  }

  int16_t* At(int x, int y) { return samples.data() + kSliceLanes + stride * size_t(y) + x; }

  // Any distances that stay inside, not those of edges alone.
  void SetEdges(int x, int y, test::Random* random) {
    const int rooms[4] = {width - 1 - x, x, height - 1 - y, y};
    for (int side = 0; side < 4; ++side) {
      const int most = std::min(rooms[side], 255);
      if (most == 0 || random->Int(0, 2) != 0) continue;
      edges[side][stride * size_t(y) + size_t(x)] = uint8_t(random->Int(1, std::min(most, 20)));
    }
  }

  const DepthRow& Row(int y) {
    row.disparity = At(0, y);
    row.above = y;
    row.below = height - 1 - y;
    for (int side = 0; side < 4; ++side) row.edges[side] = edges[side].data() + stride * size_t(y);
    return row;
  }
};

struct Hidden {
  std::vector<int16_t> disparity[2];
  std::vector<uint16_t> source[2], found[2];
  std::vector<uint8_t> share;
  uint64_t chunks = 0;

  Hidden(const Kernels& kernels, const DepthRow& row) : share(Whole(size_t(row.width))) {
    for (int k = 0; k < 2; ++k) {
      disparity[k].assign(share.size(), 7);
      source[k].assign(share.size(), 7);
      found[k].assign(share.size() / kSliceLanes, 7);
    }
    chunks = kernels.LookBehind(row, {{disparity[0].data(), disparity[1].data()},
                                      {source[0].data(), source[1].data()},
                                      {found[0].data(), found[1].data()},
                                      share.data()});
    for (size_t n = 0; n < share.size(); ++n) {
      if ((chunks >> n / kSliceLanes & 1) != 0) continue;
      for (int k = 0; k < 2; ++k) source[k][n] = found[k][n / kSliceLanes] = 0;
    }
  }
};

void TestLookBehind(const Kernels& kernels) {
  test::Random random(4);
  int seen = 0, half = 0, unseen = 0, tied = 0, second = 0;
  for (int width = 1; width <= 70; ++width) {
    DepthField field(width, random.Int(1, 20), &random);
    for (int y = 0; y < field.height; ++y) {
      const DepthRow& row = field.Row(y);
      const Hidden expected(ReferenceKernels(), row), got(kernels, row);
      CAPTURE(width);
      CAPTURE(y);
      CHECK(got.chunks == expected.chunks);
      CHECK(got.share == expected.share);
      for (int k = 0; k < 2; ++k) {
        CHECK(got.disparity[k] == expected.disparity[k]);
        CHECK(got.source[k] == expected.source[k]);
        CHECK(got.found[k] == expected.found[k]);
        for (size_t n = 0; n < expected.source[k].size(); ++n) {
          const int found = expected.found[k][n / kSliceLanes] >> n % kSliceLanes & 1;
          CHECK(found == int(expected.source[k][n] != 0));
        }
      }
      for (const uint16_t source : expected.source[0]) {
        const int sides = source & 15, distance = source >> starfocus::simd::kSourceDistance;
        seen += sides != 0 && distance == 0;
        unseen += distance != 0;
        half += (source >> starfocus::simd::kSourceHalf & 15) != 0;
        tied += (sides & (sides - 1)) != 0;
      }
      for (const uint16_t source : expected.source[1]) second += source != 0;
    }
  }
  CHECK(seen > 100);
  CHECK(half > 100);
  CHECK(unseen > 100);
  CHECK(tied > 100);
  CHECK(second > 100);
}

void TestInterpolate(const Kernels& kernels) {
  test::Random random(5);
  const size_t plane = kSliceLanes + 5;
  for (int round = 0; round < 300; ++round) {
    std::vector<uint8_t> here = test::RandomBytes(3 * kSliceLanes, &random);
    std::vector<uint8_t> next = test::RandomBytes(3 * kSliceLanes, &random);
    const std::vector<uint8_t> weight = test::RandomBytes(kSliceLanes, &random);
    if (round == 0) here.assign(here.size(), 255), next = here;
    std::vector<uint8_t> expected(3 * plane, 7), got = expected;
    ReferenceKernels().Interpolate(here.data(), next.data(), weight.data(), plane, expected.data());
    kernels.Interpolate(here.data(), next.data(), weight.data(), plane, got.data());
    CHECK(got == expected);
    if (round == 0) CHECK(expected[0] == 255);
  }
}

TEST_CASE("surface kernels: every target gives the bits of the plain ones") {
  for (const Kernels* kernels : test::SimdTargets()) {
    CAPTURE(kernels->name);
    TestSplit(*kernels);
    TestFindEdges(*kernels);
    TestSteps(*kernels);
    TestLookBehind(*kernels);
    TestInterpolate(*kernels);
  }
}

}  // namespace
