// The timing model: views counted one by one, and a time that is linear in work and coefficients.
#include "lib/timing.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <cstdlib>

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
  BlockWork work = {wide * high, 0, 0, 0, upsampled};
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

TEST_CASE("timing: each coefficient counts its own work") {
  const BlockWork work = {2, 3, 5, 7, 11};
  CHECK(starfocus::PredictTime({0, 0, 0, 0, 0, 0}, work) == 0);
  CHECK(starfocus::PredictTime({100, 0, 0, 0, 0, 0}, work) == 100);
  CHECK(starfocus::PredictTime({0, 100, 0, 0, 0, 0}, work) == 200);
  CHECK(starfocus::PredictTime({0, 0, 100, 0, 0, 0}, work) == 300);
  CHECK(starfocus::PredictTime({0, 0, 0, 100, 0, 0}, work) == 500);
  CHECK(starfocus::PredictTime({0, 0, 0, 0, 100, 0}, work) == 700);
  CHECK(starfocus::PredictTime({0, 0, 0, 0, 0, 100}, work) == 1100);
}

TEST_CASE("timing: linear in work and in coefficients") {
  test::Random random(4);
  const auto coefficient = [&] { return uint32_t(random.Int(0, 1 << 24)); };
  const auto amount = [&] { return uint64_t(random.Int(0, 1 << 20)); };
  for (int round = 0; round < 200; ++round) {
    const sf_timing s = {coefficient(), coefficient(), coefficient(),
                         coefficient(), coefficient(), coefficient()};
    const sf_timing t = {coefficient(), coefficient(), coefficient(),
                         coefficient(), coefficient(), coefficient()};
    const sf_timing sum = {s.block + t.block, s.field + t.field, s.a + t.a,
                           s.b + t.b,         s.c + t.c,         s.upsample + t.upsample};
    const BlockWork v = {amount(), amount(), amount(), amount(), amount()};
    const BlockWork w = {amount(), amount(), amount(), amount(), amount()};
    const BlockWork both = {v.field + w.field, v.a + w.a, v.b + w.b, v.c + w.c,
                            v.upsample + w.upsample};
    CHECK(starfocus::PredictTime(sum, v) ==
          starfocus::PredictTime(s, v) + starfocus::PredictTime(t, v));
    CHECK(starfocus::PredictTime(s, both) + s.block ==
          starfocus::PredictTime(s, v) + starfocus::PredictTime(s, w));
  }
}

TEST_CASE("timing: the largest block with the largest coefficients stays below 2^63") {
  const sf_timing most = {SF_MAX_TIMING, SF_MAX_TIMING, SF_MAX_TIMING,
                          SF_MAX_TIMING, SF_MAX_TIMING, SF_MAX_TIMING};
  const BlockWork work = starfocus::MeasureWork({0, 0, 256, 256}, {140, 140, 140, 140},
                                                starfocus::CountViews(102), 256 * 256);
  const long double exact =
      1e8L * (1 + static_cast<long double>(work.field) + static_cast<long double>(work.a) +
              static_cast<long double>(work.b) + static_cast<long double>(work.c) +
              static_cast<long double>(work.upsample));
  CHECK(exact < 9.2e18L);
  CHECK(static_cast<long double>(starfocus::PredictTime(most, work)) == exact);
  // All blocks of 16 that it may be split into.
  const BlockWork small =
      starfocus::MeasureWork({0, 0, 16, 16}, {140, 140, 140, 140}, starfocus::CountViews(102), 256);
  CHECK(256.0L * static_cast<long double>(starfocus::PredictTime(most, small)) < 1.8e19L);
}

TEST_CASE("timing: the defaults are legal, and only type C may cost nothing but its spans") {
  const sf_timing timing = starfocus::DefaultTiming();
  for (const uint32_t value : {timing.block, timing.field, timing.a, timing.b, timing.upsample,
                               timing.span, timing.hole}) {
    CHECK(value > 0);
    CHECK(value <= SF_MAX_TIMING);
  }
  sf_config config;
  sf_config_init(&config);
  CHECK(config.timing.a == timing.a);
  CHECK(config.timing.upsample == timing.upsample);
}

}  // namespace
