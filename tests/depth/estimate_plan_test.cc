// SPDX-License-Identifier: Apache-2.0
// Tests the labels, views and tiles of an estimate.
#include "lib/depth/estimate_plan.h"

#include <doctest/doctest.h>

#include <initializer_list>

#include "starfocus/depth.h"

namespace estimate_plan_test {
namespace {

using starfocus::EstimatePlan;
using starfocus::MakePlan;

EstimatePlan PlanOf(int width, int height, int views, float low, float high) {
  starfocus_depth_config config;
  starfocus_depth_config_init(&config);
  config.width = width;
  config.height = height;
  config.views = views;
  config.disparity_min = low;
  config.disparity_max = high;
  return MakePlan(config);
}

TEST_CASE(
    "estimate plan: tiles cover the picture, are symmetric, and are neither small nor large") {
  for (int length = 1; length < 3000; length += length < 40 ? 1 : 37) {
    const EstimatePlan plan = PlanOf(length, 7, 5, 0, 1);
    CAPTURE(length);
    int32_t end = 0;
    for (int32_t k = 0; k < plan.columns; ++k) {
      const starfocus::Rect tile = TileOf(plan, k), other = TileOf(plan, plan.columns - 1 - k);
      CHECK(tile.x == end);
      end = tile.x + tile.width;
      CHECK(other.x == length - end);
      CHECK(tile.height == 7);
      CHECK(tile.width < 384);
      CHECK((plan.columns == 1 || tile.width >= 128));
    }
    CHECK(end == length);
  }
}

TEST_CASE(
    "estimate plan: views of a ring lie opposite each other, at the positions of the star set") {
  for (const int views : {5, 9, 17}) {
    const EstimatePlan plan = PlanOf(10, 10, views, 0, 1);
    CHECK(plan.side_views() == views - 1);
    for (int32_t k = 0; k < plan.side_views(); ++k) {
      double u = 0, v = 0;
      REQUIRE(starfocus_view_position(plan.side[k].index, &u, &v) == 1);
      CHECK(plan.side[k].u2 == 2 * u);
      CHECK(plan.side[k].v2 == 2 * v);
      const int32_t ring = k / plan.arms * plan.arms;
      const starfocus::SideView& other = plan.side[ring + (k + plan.arms / 2) % plan.arms];
      CHECK(other.u2 == -plan.side[k].u2);
      CHECK(other.v2 == -plan.side[k].v2);
    }
  }
}

TEST_CASE("estimate plan: labels are half a pixel apart, or farther apart in a wide range") {
  const EstimatePlan fine = PlanOf(10, 10, 5, -3, 4.25F);
  CHECK(fine.low == -3 * 64);
  CHECK(fine.step == 32);
  CHECK(fine.labels == 16);
  CHECK(fine.reach == 6);
  const EstimatePlan single = PlanOf(10, 10, 5, 2, 2);
  CHECK(single.labels == 1);
  const EstimatePlan wide = PlanOf(10, 10, 5, -500, 500);
  CHECK(wide.labels <= starfocus::kMostLabels);
  CHECK(wide.Disparity(wide.labels - 1) >= 500 * 64);
  CHECK(wide.Disparity(wide.labels - 1) + 64 <= INT16_MAX);
}

TEST_CASE("estimate plan: WholeMove rounds shifts to whole pixels, and halves towards 0") {
  using starfocus::WholeMove;
  CHECK(WholeMove(64) == 0);
  CHECK(WholeMove(65) == 1);
  CHECK(WholeMove(-64) == 0);
  CHECK(WholeMove(-65) == -1);
  CHECK(WholeMove(-300) == -2);
}

TEST_CASE("estimate plan: CoarsePlan keeps every other label and the range of the labels") {
  starfocus_depth_config config;
  starfocus_depth_config_init(&config);
  config.width = config.height = 10;
  for (int range = 0; range <= 1000; range = range < 70 ? range + 1 : range + 93) {
    config.disparity_min = -float(range) / 2;
    config.disparity_max = float(range) / 2;
    const EstimatePlan plan = MakePlan(config), coarse = CoarsePlan(plan);
    CAPTURE(range);
    CHECK(coarse.labels >= 1);
    CHECK(coarse.Disparity(coarse.labels - 1) <= plan.Disparity(plan.labels - 1));
    CHECK(coarse.Disparity(coarse.labels) > plan.Disparity(plan.labels - 1) - plan.step);
  }
}

}  // namespace
}  // namespace estimate_plan_test
