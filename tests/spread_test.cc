// Wide aperture cells: the taps, the kernel on every SIMD target, and whole lines.
#include "lib/spread.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "lib/aperture.h"
#include "simd/kernels.h"
#include "tests/simd_targets.h"
#include "tests/test_scene.h"

namespace {

using starfocus::kShiftOne;
using starfocus::kSurfaceStep;
using starfocus::Line;
using starfocus::SpreadTapsOf;
using starfocus::ViewGrid;
using starfocus::simd::Kernels;
using starfocus::simd::kMaxSpread;
using starfocus::simd::kPadding;
using starfocus::simd::ReferenceKernels;
using starfocus::simd::SpreadTaps;

int TapAt(const SpreadTaps& taps, int k) {
  return k == 0 ? taps.centre : std::abs(k) < taps.reach ? taps.inner : taps.outer;
}

TEST_CASE("spread: taps are what the cell covers of each pixel") {
  for (int cell = kShiftOne; cell <= 9 * kShiftOne; cell += 7) {
    CAPTURE(cell);
    const SpreadTaps taps = SpreadTapsOf(cell);
    REQUIRE(taps.reach >= 1);
    REQUIRE(taps.reach <= kMaxSpread);
    // The cell is taken to 1/4 pixel.
    const double half = std::min(std::round(4.0 * cell / kShiftOne) / 4, 2.0 * kMaxSpread + 1) / 2;
    CHECK(half <= taps.reach + 0.5);
    int sum = 0;
    for (int k = -taps.reach; k <= taps.reach; ++k) {
      const double covered = std::min(half, k + 0.5) - std::max(-half, k - 0.5);
      const double exact = 256 * std::max(0.0, covered) / (2 * half);
      // The tap in the middle takes up the rounding of the others.
      CHECK(std::fabs(TapAt(taps, k) - exact) <= (k == 0 ? 2.0 * taps.reach * 0.5 : 0.5));
      sum += TapAt(taps, k);
    }
    CHECK(sum == 256);
  }
}

TEST_CASE("spread: the kernel by hand, halves to even") {
  // Pixels of one sample that matters: 0 0 1 | 0 0 | 3, taps 64 128 64.
  uint8_t in[9 * 3 + kPadding] = {};
  in[9] = 2, in[12] = 4, in[15] = 8;
  uint8_t out[9] = {};
  const SpreadTaps taps = {1, 128, 0, 64};
  ReferenceKernels().spread(in + 9, taps, 9, out);
  CHECK(int(out[0]) == 2);  // (2 * 2 + 4) / 4
  CHECK(int(out[3]) == 4);  // (2 + 8 + 8) / 4 = 4.5
  CHECK(int(out[6]) == 5);  // (4 + 16) / 4
  in[12] = 6;
  ReferenceKernels().spread(in + 9, taps, 9, out);
  CHECK(int(out[0]) == 2);  // 10 / 4 = 2.5
  CHECK(int(out[6]) == 6);  // 22 / 4 = 5.5
}

TEST_CASE("spread: the same results on every target, nothing written beyond") {
  constexpr int kLongest = 2 * 64 + 3;
  test::Random random(5);
  for (const Kernels* kernels : test::SimdTargets()) {
    CAPTURE(kernels->name);
    for (int count = 1; count <= kLongest; ++count) {
      CAPTURE(count);
      const SpreadTaps taps = SpreadTapsOf(random.Int(kShiftOne, 8 * kShiftOne));
      std::vector<uint8_t> in(size_t(count) + 6 * kMaxSpread + kPadding);
      const bool extreme = random.Int(0, 1) == 0;
      for (uint8_t& b : in) b = extreme ? uint8_t(255 * random.Int(0, 1)) : random.Byte();
      std::vector<uint8_t> expected(size_t(count) + kPadding, test::kPoison), got = expected;
      ReferenceKernels().spread(in.data() + 3 * kMaxSpread, taps, size_t(count), expected.data());
      kernels->spread(in.data() + 3 * kMaxSpread, taps, size_t(count), got.data());
      CHECK(got == expected);
    }
  }
}

// A line with its disparity (1/64).
struct Pixels {
  std::vector<uint8_t> rgb;
  std::vector<int16_t> disparity;

  Pixels Mirrored() const {
    Pixels mirrored = *this;
    std::reverse(mirrored.disparity.begin(), mirrored.disparity.end());
    for (size_t x = 0; x < disparity.size(); ++x) {
      std::memcpy(&mirrored.rgb[3 * x], &rgb[3 * (disparity.size() - 1 - x)], 3);
    }
    return mirrored;
  }
};

// Flat pieces, slopes and noise, up to `limit` from disparity 0.
Pixels RandomPixels(int length, int limit, test::Random* random) {
  Pixels line;
  line.rgb.resize(3 * size_t(length) + kPadding);
  for (uint8_t& b : line.rgb) b = random->Byte();
  int d = random->Int(-limit, limit), slope = 0, noise = 0;
  for (int x = 0; x < length; ++x) {
    if (random->Int(0, 15) == 0) {
      if (random->Int(0, 1) == 0) d = random->Int(-limit, limit);
      slope = random->Int(0, 1) * random->Int(-90, 90);
      noise = random->Int(0, 1) * random->Int(0, 300);
    }
    d += slope;
    line.disparity.push_back(int16_t(std::clamp(d + random->Int(-noise, noise), -limit, limit)));
  }
  return line;
}

std::vector<uint8_t> Spread(const Kernels& kernels, const ViewGrid& grid, Pixels line) {
  const auto length = int32_t(line.disparity.size());
  line.disparity.resize(line.disparity.size() + kPadding / sizeof(int16_t));
  std::vector<uint16_t> starts(starfocus::RunMarkWords(size_t(length), 1)), edges = starts;
  std::vector<int16_t> middles(starfocus::RunMiddles(size_t(length), 1));
  starfocus::simd::RunMarks marks = {starts.data(), edges.data(), middles.data(),
                                     starfocus::RunMarkStride(1)};
  starfocus::MarkRuns(kernels, grid, {line.disparity.data(), 1, length, 1},
                      starfocus::Direction::kRightToLeft, &marks);
  std::vector<starfocus::Run> runs(static_cast<size_t>(length));
  const int32_t count = starfocus::ReadRuns(marks, 0, length, grid, grid.Move(1), runs.data());
  std::vector<uint8_t> surface(line.rgb.size() + 6 * kMaxSpread);
  const Line view = {line.rgb.data(), line.disparity.data(), 1, length};
  starfocus::SpreadLine(kernels, grid, view, runs.data(), count, surface.data(), line.rgb.data());
  line.rgb.resize(3 * size_t(length));
  return line.rgb;
}

// Pixel by pixel from the definition.
std::vector<uint8_t> Expected(const ViewGrid& grid, const Pixels& line) {
  const int length = int(line.disparity.size());
  std::vector<uint8_t> out(3 * size_t(length));
  const auto edge = [&](int a, int b) {
    return std::abs(line.disparity[size_t(a)] - line.disparity[size_t(b)]) > kSurfaceStep;
  };
  for (int x = 0; x < length; ++x) {
    const int cell = std::abs(grid.Shift(grid.Move(1), line.disparity[size_t(x)]));
    const SpreadTaps taps = cell <= kShiftOne ? SpreadTaps{1, 256, 0, 0} : SpreadTapsOf(cell);
    int sums[3] = {};
    for (const int side : {-1, 1}) {
      int from = x;
      for (int k = 0; k <= taps.reach; ++k) {
        if (k == 0 && side > 0) continue;
        const int next = x + side * k;
        const bool inside = next >= 0 && next < length;
        if (k > 0 && from == next - side && inside && !edge(from, next)) from = next;
        for (int c = 0; c < 3; ++c) sums[c] += TapAt(taps, k) * line.rgb[size_t(3 * from + c)];
      }
    }
    for (int c = 0; c < 3; ++c) {
      out[size_t(3 * x + c)] = uint8_t(std::nearbyint(sums[c] / 256.0));  // halves to even
    }
  }
  return out;
}

TEST_CASE("spread: each pixel by its own cell over its own surface, mirrored or not") {
  test::Random random(6);
  int changed = 0;
  for (int round = 0; round < 2000; ++round) {
    const int n = random.Int(1, 12);
    std::vector<uint16_t> weights(starfocus::ApertureSize(n));
    const starfocus::Aperture aperture =
        starfocus::MakeAperture(n, starfocus::ApertureFallOff(0.8), weights.data());
    const double radius = random.Int(0, 1) == 0 ? 1 : random.Real(0.05, 1);
    const ViewGrid grid =
        starfocus::MakeViewGrid(aperture, random.Real(-20, 20), radius, 0, false, true);
    const Pixels line = RandomPixels(random.Int(1, 150), random.Int(0, 64 * 60), &random);
    const std::vector<uint8_t> expected = Expected(grid, line);
    const std::vector<uint8_t> got = Spread(starfocus::simd::BestKernels(), grid, line);
    CAPTURE(round);
    const bool same = got == expected;
    CHECK(same);
    changed += std::memcmp(expected.data(), line.rgb.data(), expected.size()) != 0;
    Pixels result = line;
    std::copy(got.begin(), got.end(), result.rgb.begin());
    std::vector<uint8_t> mirrored = result.Mirrored().rgb;
    mirrored.resize(got.size());
    const bool symmetric =
        Spread(starfocus::simd::BestKernels(), grid, line.Mirrored()) == mirrored;
    CHECK(symmetric);
  }
  CHECK(changed > 500);
}

}  // namespace
