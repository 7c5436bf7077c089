// The timing model: views counted one by one, and a time that is linear in work and coefficients.
#include "lib/timing.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <cstdlib>

#include "lib/timing_defaults.h"
#include "starfocus/starfocus.h"
#include "tests/test_scene.h"

namespace {

using starfocus::BlockWork;
using starfocus::Border;
using starfocus::Rect;
using starfocus::ViewCounts;

// The types of Fig. 11: A on the axes, B on the diagonals, C between them; the centre is none.
ViewCounts CountOneByOne(int n) {
  ViewCounts views = {0, 0, 0};
  for (int i = -n; i <= n; ++i) {
    for (int j = -n; j <= n; ++j) {
      if (i * i + j * j > n * n || (i == 0 && j == 0)) continue;
      if (i == 0 || j == 0) {
        ++views.a;
      } else if (std::abs(i) == std::abs(j)) {
        ++views.b;
      } else {
        ++views.c;
      }
    }
  }
  return views;
}

// Summed view by view, as (13) has it.
BlockWork MeasureViewByView(const Rect& rect, const Border& border, int n, uint64_t upsampled) {
  const auto width = uint64_t(rect.width), height = uint64_t(rect.height);
  const uint64_t wide = width + uint64_t(border.left) + uint64_t(border.right);
  const uint64_t high = height + uint64_t(border.top) + uint64_t(border.bottom);
  BlockWork work = {};
  work.field = wide * high;
  work.upsample = upsampled;
  for (int i = -n; i <= n; ++i) {
    for (int j = -n; j <= n; ++j) {
      if (i * i + j * j > n * n || (i == 0 && j == 0)) continue;
      if (j == 0) {
        work.a += width * high;
      } else if (i == 0) {
        work.a += wide * height;
      } else if (std::abs(i) == std::abs(j)) {
        work.b += width * height;
      } else {
        work.c += width * height;
      }
    }
  }
  return work;
}

TEST_CASE("timing: views of each type, counted one by one") {
  for (int n = 0; n <= 110; ++n) {
    CAPTURE(n);
    const ViewCounts expected = CountOneByOne(n), got = starfocus::CountViews(n);
    CHECK(got.a == expected.a);
    CHECK(got.b == expected.b);
    CHECK(got.c == expected.c);
  }
}

TEST_CASE("timing: the work of a block, view by view") {
  test::Random random(3);
  for (int round = 0; round < 300; ++round) {
    const Rect rect = {random.Int(-9, 99), random.Int(-9, 99), random.Int(1, 256),
                       random.Int(1, 256)};
    const Border border = {random.Int(0, 140), random.Int(0, 140), random.Int(0, 140),
                           random.Int(0, 140)};
    const int n = random.Int(0, round < 250 ? 12 : 102);
    const uint64_t upsampled = random.Next();
    const BlockWork expected = MeasureViewByView(rect, border, n, upsampled);
    const BlockWork got = starfocus::MeasureWork(rect, border, starfocus::CountViews(n), upsampled);
    CAPTURE(n);
    CHECK(got.field == expected.field);
    CHECK(got.a == expected.a);
    CHECK(got.b == expected.b);
    CHECK(got.c == expected.c);
    CHECK(got.upsample == expected.upsample);
  }
}

// The terms of PredictTime beside the one for each block.
constexpr uint64_t BlockWork::*kWorks[] = {
    &BlockWork::field,    &BlockWork::a,    &BlockWork::b,   &BlockWork::c,
    &BlockWork::upsample, &BlockWork::span, &BlockWork::hole};
constexpr uint32_t sf_timing::*kCoefficients[] = {
    &sf_timing::field,    &sf_timing::a,    &sf_timing::b,   &sf_timing::c,
    &sf_timing::upsample, &sf_timing::span, &sf_timing::hole};
constexpr size_t kTerms = sizeof(kWorks) / sizeof(kWorks[0]);
static_assert(sizeof(sf_timing) == (1 + kTerms) * sizeof(uint32_t), "every coefficient");
static_assert(sizeof(BlockWork) == kTerms * sizeof(uint64_t), "every kind of work");

TEST_CASE("timing: each coefficient counts its own work") {
  const BlockWork work = {2, 3, 5, 7, 11, 13, 17};
  CHECK(starfocus::PredictTime(sf_timing{}, work) == 0);
  sf_timing per_block = {};
  per_block.block = 100;
  CHECK(starfocus::PredictTime(per_block, work) == 100);
  for (size_t k = 0; k < kTerms; ++k) {
    CAPTURE(k);
    sf_timing timing = {};
    timing.*kCoefficients[k] = 100;
    CHECK(starfocus::PredictTime(timing, work) == 100 * (work.*kWorks[k]));
  }
}

TEST_CASE("timing: linear in work and in coefficients") {
  test::Random random(4);
  for (int round = 0; round < 200; ++round) {
    sf_timing s = {}, t = {}, sum = {};
    BlockWork v = {}, w = {}, both = {};
    s.block = uint32_t(random.Int(0, 1 << 24));
    t.block = uint32_t(random.Int(0, 1 << 24));
    sum.block = s.block + t.block;
    for (size_t k = 0; k < kTerms; ++k) {
      s.*kCoefficients[k] = uint32_t(random.Int(0, 1 << 24));
      t.*kCoefficients[k] = uint32_t(random.Int(0, 1 << 24));
      sum.*kCoefficients[k] = s.*kCoefficients[k] + t.*kCoefficients[k];
      v.*kWorks[k] = uint64_t(random.Int(0, 1 << 20));
      w.*kWorks[k] = uint64_t(random.Int(0, 1 << 20));
      both.*kWorks[k] = v.*kWorks[k] + w.*kWorks[k];
    }
    CHECK(starfocus::PredictTime(sum, v) ==
          starfocus::PredictTime(s, v) + starfocus::PredictTime(t, v));
    CHECK(starfocus::PredictTime(s, both) + s.block ==
          starfocus::PredictTime(s, v) + starfocus::PredictTime(s, w));
  }
}

TEST_CASE("timing: the largest block with the largest coefficients stays below 2^63") {
  sf_timing most = {};
  most.block = SF_MAX_TIMING;
  for (const auto coefficient : kCoefficients) most.*coefficient = SF_MAX_TIMING;
  const auto exact = [](const BlockWork& work) {
    long double units = 1;
    for (const auto kind : kWorks) units += static_cast<long double>(work.*kind);
    return 1e8L * units;
  };
  // At every pixel two steps, each a run of its own and beside a gap of 8 pixels.
  const auto work_of = [](int side) {
    const uint32_t steps = 2 * starfocus::kContentOne * uint32_t(side) * uint32_t(side);
    return starfocus::MeasureWork({0, 0, side, side}, {140, 140, 140, 140},
                                  starfocus::CountViews(102), uint64_t(side) * uint64_t(side),
                                  {steps, steps, 8 * steps});
  };
  const BlockWork work = work_of(256);
  CHECK(exact(work) < 9.2e18L);
  CHECK(static_cast<long double>(starfocus::PredictTime(most, work)) == exact(work));
  // All blocks of 16 that it may be split into.
  CHECK(256 * exact(work_of(16)) < 1.8e19L);
}

TEST_CASE("timing: the built-in coefficients are legal, and only some pixels cost nothing more") {
  for (const starfocus::NamedTiming& each : starfocus::kBuiltInTimings) {
    CAPTURE(each.name);
    const sf_timing& timing = each.timing;
    CHECK(timing.block > 0);
    CHECK(timing.block <= SF_MAX_TIMING);
    for (const auto coefficient : kCoefficients) CHECK(timing.*coefficient <= SF_MAX_TIMING);
    // A fit cannot always tell the types apart, B and C being rendered from A, nor the field, whose
    // pixels grow with those of type A.
    CHECK(timing.a + timing.b + timing.c > 0);
    for (const auto coefficient : {&sf_timing::upsample, &sf_timing::span, &sf_timing::hole}) {
      CHECK(timing.*coefficient > 0);
    }
  }
  sf_config config;
  sf_config_init(&config);
  const sf_timing& own = starfocus::kBuiltInTimings[starfocus::kOwnTiming].timing;
  CHECK(config.timing.block == own.block);
  for (const auto coefficient : kCoefficients) {
    CHECK(config.timing.*coefficient == own.*coefficient);
  }
}

}  // namespace
