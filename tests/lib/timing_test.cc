// SPDX-License-Identifier: Apache-2.0
// Tests the timing model: views are counted one by one, and the time is linear in work and
// coefficients.
#include <doctest/doctest.h>

#include <cstdint>
#include <cstdlib>

#include "lib/plan/partition.h"
#include "lib/plan/renderer.h"
#include "starfocus/experimental.h"
#include "starfocus/starfocus.h"
#include "tests/support/config.h"
#include "tests/support/test_scene.h"

namespace timing_test {
namespace {

using namespace starfocus;

// Returns the views (i, j) with i^2 + j^2 <= N^2, without weights.
starfocus::ViewWeights DiscOf(int n) {
  starfocus::ViewWeights aperture;
  aperture.n = aperture.last = n;
  aperture.views = 0;
  for (int i = -n; i <= n; ++i) {
    for (int j = -n; j <= n; ++j) aperture.views += i * i + j * j <= n * n;
  }
  return aperture;
}

// Sums the work view by view as in (13). Views are of type A on the axes, of type B on the
// diagonals, and of type C elsewhere (Fig. 11). With subapertures, the centre view is of type A as
// well, and all views with j != 0 are scanned along columns.
BlockWork MeasureViewByView(const Rect& rect, const Border& border, int n, bool subapertures,
                            uint64_t upsampled, const Content (&content)[2], int layer) {
  const auto width = uint64_t(rect.width), height = uint64_t(rect.height);
  const uint64_t wide = width + uint64_t(border.left) + uint64_t(border.right);
  const uint64_t high = height + uint64_t(border.top) + uint64_t(border.bottom);
  BlockWork work = {wide * high, 0, 0, 0, upsampled, 0, 0};
  uint64_t views = 0, lines = 0;
  for (int i = -n; i <= n; ++i) {
    for (int j = -n; j <= n; ++j) {
      if (i * i + j * j > n * n) continue;
      if (subapertures && n > 0) lines += j == 0 ? high : width;
      if (i == 0 && j == 0) {
        work.a += subapertures && n > 0 ? width * high : 0;
        continue;
      }
      ++views;
      if (j == 0) {
        work.a += width * high;
      } else if (subapertures) {
        work.c += width * height;
      } else if (i == 0) {
        work.a += wide * height;
      } else if (std::abs(i) == std::abs(j)) {
        work.b += width * height;
      } else {
        work.c += width * height;
      }
    }
  }
  // Half of the views are scanned along rows, and the other half along columns. With subapertures,
  // views with j = 0 are scanned along rows, and all other views along columns. Layer L has 1 / 2^L
  // of the lines. On each line, a slope makes 1 / 2^L of the runs, and a gap is 1 / 2^L as wide.
  const int scale = 1 << layer;
  const uint64_t on_axis = n == 0 ? 0 : 2 * uint64_t(n) + 1;
  const uint64_t scans[2] = {subapertures ? on_axis : views / 2,
                             subapertures ? views - uint64_t(2 * n) : views / 2};
  work.span = subapertures ? lines : views / 2 * (width + height);
  for (int along = 0; along < 2; ++along) {
    const Content& met = content[along];
    const uint64_t runs = met.slopes / uint64_t(scale * scale) + met.edges / uint64_t(scale);
    work.span += scans[along] * runs / starfocus::kContentOne;
    work.hole += scans[along] * (met.gaps / uint64_t(scale * scale)) / starfocus::kContentOne;
  }
  return work;
}

constexpr uint32_t starfocus_timing::*kCoefficients[] = {
    &starfocus_timing::field, &starfocus_timing::a,        &starfocus_timing::b,
    &starfocus_timing::c,     &starfocus_timing::upsample, &starfocus_timing::span,
    &starfocus_timing::hole,  &starfocus_timing::block};
constexpr uint64_t BlockWork::*kAmounts[] = {
    &BlockWork::field,    &BlockWork::a,    &BlockWork::b,   &BlockWork::c,
    &BlockWork::upsample, &BlockWork::span, &BlockWork::hole};
static_assert(sizeof(starfocus_timing) == 8 * sizeof(uint32_t), "a coefficient is not tested");
static_assert(sizeof(BlockWork) == 7 * sizeof(uint64_t), "an amount is not tested");

TEST_CASE("timing: the work of a block is the sum over its views") {
  test::Random random(3);
  for (int round = 0; round < 411; ++round) {
    const Rect rect = {random.Int(-9, 99), random.Int(-9, 99), random.Int(1, 256),
                       random.Int(1, 256)};
    const Border border = {random.Int(0, 140), random.Int(0, 140), random.Int(0, 140),
                           random.Int(0, 140)};
    const int n = round < 300 ? random.Int(0, 12) : round - 300;
    const uint64_t upsampled = random.Next();
    const auto amount = [&] { return uint32_t(random.Int(0, 1 << 16)); };
    const Content content[2] = {{amount(), amount(), amount()}, {amount(), amount(), amount()}};
    const int layer = random.Int(0, 2);
    const bool subapertures = random.Int(0, 1) == 1;
    const BlockWork expected =
        MeasureViewByView(rect, border, n, subapertures, upsampled, content, layer);
    const starfocus::Renderer& renderer =
        subapertures ? kSliceRenderer : starfocus_line_scan_renderer()->renderer;
    BlockWork got = renderer.measure_work(rect, border, DiscOf(n), content, layer);
    got.upsample = upsampled;
    CAPTURE(n);
    for (const auto amount_of : kAmounts) CHECK(got.*amount_of == expected.*amount_of);
  }
}

starfocus_timing EqualTiming(uint32_t value) {
  starfocus_timing timing = {};
  for (const auto coefficient : kCoefficients) timing.*coefficient = value;
  return timing;
}

TEST_CASE("timing: the predicted time is the sum of each coefficient times its amount of work") {
  test::Random random(4);
  for (int round = 0; round < 200; ++round) {
    starfocus_timing timing = {};
    for (const auto which : kCoefficients) timing.*which = uint32_t(random.Int(0, 1 << 24));
    BlockWork work = {};
    uint64_t sum = timing.block;
    for (int k = 0; k < 7; ++k) {
      work.*kAmounts[k] = uint64_t(random.Int(0, 1 << 20));
      sum += timing.*kCoefficients[k] * work.*kAmounts[k];
    }
    CHECK(starfocus::PredictTime(timing, work) == sum);
  }
}

TEST_CASE(
    "timing: the largest coefficients do not overflow the cost of a superblock or its blocks") {
  const starfocus_timing most = EqualTiming(STARFOCUS_MAX_TIMING);
  const auto exact = [&](const BlockWork& work) {
    long double sum = 1;
    for (const auto which : kAmounts) sum += static_cast<long double>(work.*which);
    return sum * STARFOCUS_MAX_TIMING;
  };
  for (const int side : {16, 32, 64, 128, 256}) {
    // The tested content has more slopes, edges and gaps than any picture with the same number of
    // pixels.
    const auto pixels = uint32_t(side * side);
    const Content along = {64 * pixels, 64 * pixels, 256 * pixels};
    const Content content[2] = {along, along};
    BlockWork work = starfocus_line_scan_renderer()->renderer.measure_work(
        {0, 0, side, side}, {140, 140, 140, 140}, DiscOf(102), content, 0);
    work.upsample = pixels;
    CAPTURE(side);
    CHECK(exact(work) * (256 / side) * (256 / side) < 1.8e19L);
    CHECK(static_cast<long double>(starfocus::PredictTime(most, work)) == exact(work));
  }
}

TEST_CASE("timing: the default coefficients are the same on every machine") {
  test::Config config;
  constexpr starfocus_timing kDefault = {5659266, 0, 2354, 0, 106, 3266, 720, 507};
  for (const auto coefficient : kCoefficients) {
    CHECK(config.tuning.timing.*coefficient == kDefault.*coefficient);
  }
}

}  // namespace
}  // namespace timing_test
