// The kernels of samples on every SIMD target of this machine against the plain C++ that defines
// them, and the engine on every target. line_kernels_test.cc has the others.
#include "simd/kernels.h"

#include <doctest/doctest.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "lib/engine/engine.h"
#include "tests/support/simd_targets.h"
#include "tests/support/test_scene.h"

namespace {

using starfocus::simd::Kernels;
using starfocus::simd::kPadding;
using starfocus::simd::ReferenceKernels;
using starfocus::simd::Span;

// Lengths from one sample past two of the widest vectors, with all tails.
constexpr int kLongest = 2 * 64 + 3;

// Buffers of spans: one source, and spans that lie side by side in the target.
struct Spans {
  static constexpr int kMargin = 8;  // neighbours, and odd places to start

  // With `blend`, weights sum to 256.
  Spans(int samples, int count, bool blend, test::Random* random)
      : bytes(test::RandomBytes(size_t(kMargin + samples + kMargin) + kPadding, random)) {
    uint32_t target = uint32_t(random->Int(0, 5));
    for (int i = 0; i < count; ++i) {
      Span span;
      span.source = bytes.data() + kMargin + random->Int(-3, 3);
      span.target = target;
      span.samples = uint32_t(samples);
      const int kind = random->Int(0, 3);
      const int one = blend ? 256 : random->Int(0, 1) == 0 ? 32767 : random->Int(0, 32767);
      const int neighbour = kind == 0 ? 0 : kind == 1 ? one : random->Int(0, one);
      span.neighbour_weight = uint16_t(neighbour);
      span.weight = uint16_t(blend ? one - neighbour : kind == 1 ? 32767 : one);
      span.neighbour_offset = random->Int(0, 1) == 0 ? 3 : -3;
      spans.push_back(span);
      target += uint32_t(samples + random->Int(0, 2));
    }
    end = target;
  }

  std::vector<uint8_t> bytes;
  std::vector<Span> spans;
  size_t end = 0;
};

void TestAccumulate(const Kernels& kernels) {
  test::Random random(1);
  for (int samples = 1; samples <= kLongest; ++samples) {
    for (const int count : {1, 2, 5}) {
      const Spans spans(samples, count, false, &random);
      std::vector<uint32_t> expected(spans.end + kPadding);
      for (uint32_t& value : expected) value = random.Next() >> 4;
      std::vector<uint32_t> got = expected;
      ReferenceKernels().Accumulate(spans.spans.data(), spans.spans.size(), expected.data());
      kernels.Accumulate(spans.spans.data(), spans.spans.size(), got.data());
      CAPTURE(samples);
      CHECK(got == expected);
    }
  }
}

void TestBlend(const Kernels& kernels) {
  test::Random random(2);
  for (int samples = 1; samples <= kLongest; ++samples) {
    for (const int count : {1, 2, 5}) {
      const Spans spans(samples, count, true, &random);
      std::vector<uint8_t> expected(spans.end + kPadding, test::kPoison);
      std::vector<uint8_t> got = expected;
      ReferenceKernels().Blend(spans.spans.data(), spans.spans.size(), expected.data());
      kernels.Blend(spans.spans.data(), spans.spans.size(), got.data());
      CAPTURE(samples);
      CHECK(got == expected);
    }
  }
}

void TestFinish(const Kernels& kernels) {
  test::Random random(3);
  for (int shift = 1; shift <= 24; ++shift) {
    for (int count = 1; count <= kLongest; ++count) {
      const size_t start = size_t(random.Int(0, 5));
      std::vector<uint32_t> sums(start + size_t(count) + kPadding);
      const uint32_t largest = uint32_t{255} << shift;
      for (uint32_t& sum : sums) {
        const int kind = random.Int(0, 4);
        const uint32_t half = (uint32_t(random.Int(0, 254)) << shift) + (1u << (shift - 1));
        sum = kind == 0   ? largest
              : kind == 1 ? half
              : kind == 2 ? half - 1
                          : random.Next() % largest;
      }
      std::vector<uint8_t> expected(start + size_t(count) + kPadding, test::kPoison);
      std::vector<uint8_t> got = expected;
      ReferenceKernels().Finish(sums.data() + start, size_t(count), shift, expected.data() + start);
      kernels.Finish(sums.data() + start, size_t(count), shift, got.data() + start);
      CAPTURE(shift);
      CAPTURE(count);
      CHECK(got == expected);
    }
  }
}

void TestFinishComposite(const Kernels& kernels) {
  test::Random random(6);
  for (size_t count = 1; count <= 70; ++count) {
    const starfocus::simd::CompositeFinish finish = {uint32_t(random.Int(1, 90000)),
                                                     random.Int(1, 24)};
    const size_t plane = starfocus::simd::SliceSamples(count) + size_t(random.Int(0, 5));
    const std::vector<uint8_t> rgb = test::RandomBytes(3 * count + kPadding, &random);
    const uint32_t all = 4 * finish.least + uint32_t(random.Int(0, 5));
    std::vector<uint32_t> sums(4 * plane);
    uint32_t covered = 0;
    for (size_t n = 0; n < plane; ++n) {
      const int kind = random.Int(0, 19);
      if (kind < 2) covered = all;
      if (kind == 2) covered = 0;
      if (kind == 3) covered = uint32_t(random.Int(0, int(all)));
      if (kind == 4) covered = finish.least - uint32_t(random.Int(0, 1));
      sums[3 * plane + n] = covered;
      for (size_t c = 0; c < 3; ++c) {
        const int colour = kind == 5 ? 256 : kind == 6 ? 255 : random.Int(0, 255);
        sums[c * plane + n] = uint32_t(uint64_t{covered} * uint64_t(colour) / 256);
      }
    }
    std::vector<uint32_t> expected(3 * count + 50, 0x5A5A5A5A), got = expected;
    ReferenceKernels().FinishComposite(sums.data(), plane, rgb.data(), finish, count,
                                       expected.data());
    kernels.FinishComposite(sums.data(), plane, rgb.data(), finish, count, got.data());
    CAPTURE(count);
    CHECK(got == expected);
  }
}

// Any kernel: weights of all sizes, rings of zeros outside, as large a sum as may be.
struct RandomDisc {
  explicit RandomDisc(int size, test::Random* random) : weights(91 + 14) {
    const int used = random->Int(0, 1) == 0 ? size : random->Int(0, size);
    const int most = random->Int(0, 1) == 0 ? 32767 : random->Int(1, 32767);
    int64_t sum = 0;
    for (int y = -size; y <= size; ++y) {
      for (int x = -size; x <= size; ++x) {
        const int high = std::max(std::abs(x), std::abs(y));
        const int low = std::min(std::abs(x), std::abs(y));
        uint16_t& weight = weights[size_t(high * (high + 1) / 2 + low)];
        if (x >= y && y >= 0) {
          weight = uint16_t(high > used || random->Int(0, 5) == 0 ? 0 : random->Int(0, most));
        }
      }
    }
    for (int y = -size; y <= size; ++y) {
      for (int x = -size; x <= size; ++x) {
        const int high = std::max(std::abs(x), std::abs(y));
        const int low = std::min(std::abs(x), std::abs(y));
        sum += weights[size_t(high * (high + 1) / 2 + low)];
      }
    }
    int bits = 1;
    while (int64_t{1} << bits < sum) ++bits;
    disc = {size, bits, weights.data()};
  }

  std::vector<uint16_t> weights;
  starfocus::simd::Disc disc = {};
};

void TestDisc(const Kernels& kernels) {
  test::Random random(5);
  constexpr size_t kRows = 3, kMargin = starfocus::simd::kMaxDisc;
  for (int round = 0; round < (STARFOCUS_EMULATED ? 60 : 300); ++round) {
    // Of the largest size not all weights fit 2^24.
    const RandomDisc disc(random.Int(0, 10), &random);
    const size_t count = size_t(random.Int(1, round % 4 == 0 ? 400 : 60));
    const size_t stride = count + 6 * kMargin + size_t(random.Int(0, 4));
    std::vector<uint8_t> in(stride * (kRows + 2 * kMargin) + kPadding);
    for (uint8_t& byte : in) byte = random.Int(0, 2) == 0 ? 255 : uint8_t(random.Next());
    const uint8_t* first = in.data() + kMargin * stride + 3 * kMargin;
    std::vector<uint8_t> expected(kRows * (count + 7), test::kPoison), got = expected;
    ReferenceKernels().FilterDisc(first, stride, disc.disc, kRows, count, expected.data(),
                                  count + 7);
    kernels.FilterDisc(first, stride, disc.disc, kRows, count, got.data(), count + 7);
    CAPTURE(disc.disc.size);
    CAPTURE(count);
    CHECK(got == expected);
  }
}

std::vector<float> RandomDisparities(int count, float low, float high, test::Random* random) {
  std::vector<float> disparity(static_cast<size_t>(count));
  for (float& d : disparity) {
    const int kind = random->Int(0, 4);
    const double exact = random->Real(low, high);
    const double tie = (std::floor(exact * 64) + 0.5) / 64;
    d = kind == 0 ? low : kind == 1 ? high : kind == 2 ? float(tie) : float(exact);
    d = std::clamp(d, low, high);
  }
  return disparity;
}

void TestConvert(const Kernels& kernels) {
  test::Random random(4);
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (const float limit : {500.0f, 7.3f, 0.0f}) {
    for (int count = 1; count <= kLongest; ++count) {
      std::vector<float> disparity = RandomDisparities(count, -limit, limit, &random);
      std::vector<int16_t> expected(size_t(count) + 8, 0x5A5A), got = expected;
      CAPTURE(limit);
      CAPTURE(count);
      CHECK(ReferenceKernels().ConvertDisparity(disparity.data(), size_t(count), -limit, limit,
                                                expected.data()));
      CHECK(kernels.ConvertDisparity(disparity.data(), size_t(count), -limit, limit, got.data()));
      CHECK(got == expected);
      for (const float bad : {kNan, kInfinity, -kInfinity, std::nextafter(limit, 1000.0f),
                              std::nextafter(-limit, -1000.0f)}) {
        const size_t place = size_t(random.Int(0, count - 1));
        std::vector<float> spoilt = disparity;
        spoilt[place] = bad;
        CHECK_FALSE(
            kernels.ConvertDisparity(spoilt.data(), size_t(count), -limit, limit, got.data()));
        CHECK(got[size_t(count)] == 0x5A5A);
      }
    }
  }
}

TEST_CASE("kernels: several SIMD targets run here") {
  const std::vector<const Kernels*> all = test::SimdTargets();
  std::printf("SIMD targets:");
  for (const Kernels* kernels : all) std::printf(" %s", kernels->name);
  std::printf("\n");
#if HWY_ARCH_X86 && !defined(HWY_COMPILE_ONLY_STATIC)
  CHECK(all.size() > 1);
#endif
  CHECK(std::string(sf_simd_target()) == starfocus::simd::BestKernels().name);
}

TEST_CASE("kernels: a test that would run on no SIMD target fails") {
  CHECK_THROWS(test::ListTargets([](size_t) -> const Kernels* { return nullptr; }));
}

TEST_CASE("kernels: the same results on every target") {
  for (const Kernels* kernels : test::SimdTargets()) {
    CAPTURE(kernels->name);
    TestAccumulate(*kernels);
    TestBlend(*kernels);
    TestFinish(*kernels);
    TestFinishComposite(*kernels);
    TestConvert(*kernels);
    TestDisc(*kernels);
  }
}

TEST_CASE("kernels: the definitions, by hand") {
  const uint8_t source[] = {10, 20, 30, 40, 50, 60, 70, 80, 90};
  const Span span = {source + 3, 1, 3, 192, 64, 3};
  uint8_t line[5] = {1, 1, 1, 1, 1};
  ReferenceKernels().Blend(&span, 1, line);
  // (192 * 40 + 64 * 70) / 256 = 47.5: halves to even
  const uint8_t blended[5] = {1, 48, 58, 68, 1};
  CHECK(std::memcmp(line, blended, sizeof(line)) == 0);
  uint32_t sums[5] = {5, 5, 5, 5, 5};
  ReferenceKernels().Accumulate(&span, 1, sums);
  CHECK(sums[0] == 5);
  CHECK(sums[1] == 5 + 192 * 40 + 64 * 70);
  CHECK(sums[3] == 5 + 192 * 60 + 64 * 90);
  CHECK(sums[4] == 5);
  const uint32_t wide[3] = {uint32_t{255} << 24, (7u << 24) + (1u << 23),
                            (7u << 24) + (1u << 23) - 1};
  uint8_t out[3];
  ReferenceKernels().Finish(wide, 3, 24, out);
  CHECK(int(out[0]) == 255);
  CHECK(int(out[1]) == 8);
  CHECK(int(out[2]) == 7);
  const uint32_t stack[4 * 16] = {3 << 16, 3 << 16};  // red of two pixels, planes of 16
  std::vector<uint32_t> covered(stack, stack + 4 * 16);
  covered[3 * 16] = 12 << 16;
  covered[3 * 16 + 1] = 99;
  const uint8_t centre[6] = {9, 9, 9, 5, 6, 7};
  uint32_t accumulators[6];
  ReferenceKernels().FinishComposite(covered.data(), 16, centre, {100, 16}, 2, accumulators);
  CHECK(accumulators[0] == 64 << 16);
  CHECK(accumulators[1] == 0);
  CHECK(accumulators[3] == 5 << 16);
  CHECK(accumulators[5] == 7 << 16);
  const uint8_t rows[3][9] = {
      {1, 0, 0, 2, 0, 0, 3, 0, 0}, {4, 0, 0, 50, 0, 0, 6, 0, 0}, {7, 0, 0, 8, 0, 0, 9, 0, 0}};
  const uint16_t ring[3] = {4, 2, 1};  // the centre, beside it, at the corners: 16 in all
  uint8_t disc[2] = {0, 77};
  ReferenceKernels().FilterDisc(&rows[1][3], 9, {1, 4, ring}, 1, 1, disc, 9);
  CHECK(int(disc[0]) == (4 * 50 + 2 * (2 + 4 + 6 + 8) + 1 + 3 + 7 + 9 + 8) / 16);
  CHECK(int(disc[1]) == 77);
  const float disparity[4] = {0.0078125f, -0.0078125f, -500, 500};
  int16_t converted[4];
  CHECK(ReferenceKernels().ConvertDisparity(disparity, 4, -500, 500, converted));
  CHECK(converted[0] == 1);
  CHECK(converted[1] == 0);
  CHECK(converted[2] == -32000);
  CHECK(converted[3] == 32000);
}

std::vector<uint8_t> Refocused(const test::Scene& scene, const sf_params& params,
                               const Kernels& kernels) {
  sf_config config = test::ConfigFor(scene);
  config.largest_block = 32;
  test::Engine engine(config);
  REQUIRE(engine.status() == SF_OK);
  reinterpret_cast<starfocus::EngineState*>(engine.get())->kernels = &kernels;
  test::Output out(scene.width, scene.height, 5);
  REQUIRE(test::Refocus(&engine, params, scene, &out) == SF_OK);
  CHECK(out.PaddingUntouched());
  return out.bytes;
}

TEST_CASE("kernels: the engine gives the same bytes on every target") {
  constexpr int kSizes[][2] = {{1, 1}, {5, 3}, {33, 40}, {77, 50}};
  for (const auto& size : kSizes) {
    for (const int views : {1, 5, 9, 17}) {
      const test::Scene scene =
          test::RandomScene(size[0], size[1], views, -3, 4, 50 + uint64_t(views));
      for (const sf_mode mode : {SF_MODE_FRAME, SF_MODE_BENCHMARK}) {
        const sf_params params = test::Params(1.3, 0.9, mode);
        const std::vector<uint8_t> expected = Refocused(scene, params, ReferenceKernels());
        for (const Kernels* kernels : test::SimdTargets()) {
          CAPTURE(kernels->name);
          CAPTURE(size[0]);
          CAPTURE(views);
          CAPTURE(mode);
          const bool same = Refocused(scene, params, *kernels) == expected;
          CHECK(same);
        }
      }
    }
  }
}

}  // namespace
