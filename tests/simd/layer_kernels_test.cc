// The kernels of layers on every SIMD target of this machine against the plain C++ that defines
// them.
#include <doctest/doctest.h>

#include <cstdint>
#include <cstring>
#include <vector>

#include "lib/filter/layers.h"
#include "simd/kernels.h"
#include "tests/support/simd_targets.h"
#include "tests/support/test_scene.h"

namespace {

using starfocus::simd::HalfBand;
using starfocus::simd::Kernels;
using starfocus::simd::kLayerWhite;
using starfocus::simd::kPadding;
using starfocus::simd::ReferenceKernels;

// From one sample to past two of the widest vectors, with all tails.
constexpr size_t kLongest = 2 * 32 + 3;
constexpr int16_t kPoison = 0x5A5A;

// Black, white and anything between, or samples as far out of range as filters leave them.
std::vector<int16_t> RandomSamples(size_t count, bool in_range, test::Random* random) {
  std::vector<int16_t> samples(count);
  for (int16_t& sample : samples) {
    const int kind = random->Int(0, 3), below = in_range ? 0 : -43 * 64;
    const int most = in_range ? kLayerWhite : 298 * 64;
    sample = int16_t(kind == 0 ? below : kind == 1 ? most : random->Int(below, most));
  }
  return samples;
}

HalfBand RandomTaps(test::Random* random) {
  if (random->Int(0, 1) == 0) return starfocus::kDownFilter;
  return {random->Int(-16384, 16384), random->Int(-16384, 16384), random->Int(-8192, 8192)};
}

// Sources end where they must not be read any further.
void TestWidenPhases(const Kernels& kernels) {
  test::Random random(1);
  for (size_t pairs = 0; pairs <= kLongest; ++pairs) {
    const std::vector<uint8_t> in = test::RandomBytes(6 * pairs, &random);
    std::vector<int16_t> expected[2], got[2];
    for (auto& phase : expected) phase.assign(3 * pairs + 1, kPoison);
    for (auto& phase : got) phase.assign(3 * pairs + 1, kPoison);
    ReferenceKernels().WidenPhases(in.data(), pairs, expected[0].data(), expected[1].data());
    kernels.WidenPhases(in.data(), pairs, got[0].data(), got[1].data());
    CAPTURE(pairs);
    CHECK(got[0] == expected[0]);
    CHECK(got[1] == expected[1]);
  }
}

void TestSplitPhases(const Kernels& kernels) {
  test::Random random(2);
  for (size_t pairs = 0; pairs <= kLongest; ++pairs) {
    const std::vector<int16_t> in = RandomSamples(6 * pairs + kPadding, false, &random);
    std::vector<int16_t> expected[2], got[2];
    for (auto& phase : expected) phase.assign(3 * pairs + 2, kPoison);
    for (auto& phase : got) phase.assign(3 * pairs + 2, kPoison);
    ReferenceKernels().SplitPhases(in.data(), pairs, expected[0].data(), expected[1].data());
    kernels.SplitPhases(in.data(), pairs, got[0].data(), got[1].data());
    CAPTURE(pairs);
    for (int phase = 0; phase < 2; ++phase) {
      got[phase][3 * pairs] = kPoison;  // may be written
      CHECK(got[phase] == expected[phase]);
    }
  }
}

void TestHalve(const Kernels& kernels) {
  test::Random random(3);
  for (size_t count = 1; count <= kLongest; ++count) {
    const std::vector<int16_t> even = RandomSamples(count + kPadding, true, &random);
    const std::vector<int16_t> odd = RandomSamples(count + 9 + kPadding, true, &random);
    const HalfBand taps = RandomTaps(&random);
    std::vector<int16_t> expected(count + 1, kPoison), got = expected;
    ReferenceKernels().Halve(even.data(), odd.data() + 6, taps, count, expected.data());
    kernels.Halve(even.data(), odd.data() + 6, taps, count, got.data());
    CAPTURE(count);
    CHECK(got == expected);
  }
}

void TestHalfBand(const Kernels& kernels) {
  test::Random random(4);
  for (size_t count = 1; count <= kLongest; ++count) {
    for (const size_t step : {size_t{3}, count + 1}) {
      const std::vector<int16_t> in = RandomSamples(count + 6 * step + kPadding, false, &random);
      const int16_t* at = in.data() + 3 * step;
      const HalfBand taps = RandomTaps(&random);
      const bool clamped = random.Int(0, 1) == 0;
      const int16_t low = clamped ? int16_t{0} : INT16_MIN;
      const int16_t high = clamped ? kLayerWhite : INT16_MAX;
      const auto filter = [&](auto kernel) {
        std::vector<int16_t> out(count + 1, kPoison);
        kernel(at, ptrdiff_t(step), taps, count, low, high, out.data());
        return out;
      };
      CAPTURE(count);
      CHECK(filter(kernels.FilterHalfBand) == filter(ReferenceKernels().FilterHalfBand));
      CHECK(filter(kernels.Between) == filter(ReferenceKernels().Between));
    }
  }
}

void TestNarrow(const Kernels& kernels) {
  test::Random random(5);
  for (size_t count = 1; count <= kLongest; ++count) {
    std::vector<int16_t> in(count + kPadding);
    for (int16_t& sample : in) {
      const int kind = random.Int(0, 4);
      const int tie = 64 * random.Int(-1, 256) + 32;
      sample = kind == 0   ? INT16_MIN
               : kind == 1 ? INT16_MAX
               : kind == 2 ? int16_t(tie)
                           : int16_t(random.Next());
    }
    std::vector<uint8_t> expected(count + 1, test::kPoison), got = expected;
    ReferenceKernels().Narrow(in.data(), count, expected.data());
    kernels.Narrow(in.data(), count, got.data());
    CAPTURE(count);
    CHECK(got == expected);
  }
}

void TestFinishLayer(const Kernels& kernels) {
  test::Random random(6);
  for (size_t count = 1; count <= kLongest; ++count) {
    const int shift = random.Int(7, 24);
    std::vector<uint32_t> sums(count + kPadding);
    for (uint32_t& sum : sums) {
      sum = random.Int(0, 3) == 0 ? uint32_t{255} << shift : random.Next() % (255u << shift);
    }
    std::vector<int16_t> expected(count + 1, kPoison), got = expected;
    ReferenceKernels().FinishLayer(sums.data(), count, shift, expected.data());
    kernels.FinishLayer(sums.data(), count, shift, got.data());
    CAPTURE(count);
    CAPTURE(shift);
    CHECK(got == expected);
  }
}

TEST_CASE("layer kernels: every target gives the bits of the plain ones") {
  for (const Kernels* kernels : test::SimdTargets()) {
    CAPTURE(kernels->name);
    TestWidenPhases(*kernels);
    TestSplitPhases(*kernels);
    TestHalve(*kernels);
    TestHalfBand(*kernels);
    TestNarrow(*kernels);
    TestFinishLayer(*kernels);
  }
}

// What is kept of a line filtered as a whole.
TEST_CASE("layer kernels: halving is the half-band filter at every even pixel") {
  test::Random random(7);
  const Kernels& kernels = ReferenceKernels();
  constexpr size_t kPairs = 20, kKept = kPairs - 3;
  const std::vector<int16_t> line = RandomSamples(6 * kPairs, true, &random);
  std::vector<int16_t> even(3 * kPairs), odd = even, halved(3 * kKept), whole(6 * kPairs);
  kernels.SplitPhases(line.data(), kPairs, even.data(), odd.data());
  kernels.Halve(even.data() + 6, odd.data() + 6, starfocus::kDownFilter, 3 * kKept, halved.data());
  kernels.FilterHalfBand(line.data() + 12, 3, starfocus::kDownFilter, 6 * kKept - 3, INT16_MIN,
                         INT16_MAX, whole.data());
  for (size_t n = 0; n < 3 * kKept; ++n) CHECK(halved[n] == whole[n / 3 * 6 + n % 3]);
}

TEST_CASE("layer kernels: the definitions, by hand") {
  const uint8_t bytes[12] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 255};
  int16_t even[6], odd[6];
  ReferenceKernels().WidenPhases(bytes, 2, even, odd);
  const int16_t evens[6] = {64, 128, 192, 448, 512, 576};
  const int16_t odds[6] = {256, 320, 384, 640, 704, kLayerWhite};
  CHECK(std::memcmp(even, evens, sizeof(even)) == 0);
  CHECK(std::memcmp(odd, odds, sizeof(odd)) == 0);
  const int16_t beside[10] = {8, 0, 0, 10, 0, 0, 30, 0, 0, 16};
  const int16_t centre = 101;
  int16_t out = 0;
  ReferenceKernels().Halve(&centre, beside + 6, {8192, 4096, 2048}, 1, &out);
  CHECK(out == 64);  // 101 / 2 + (10 + 30) / 4 + (8 + 16) / 8 = 63.5, halves up
}

}  // namespace
