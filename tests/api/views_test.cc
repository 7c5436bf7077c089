// SPDX-License-Identifier: Apache-2.0
// Tests which renderer draws the views of a light field, and views at explicit positions. Random
// trials compare the pictures of views at any positions with the second implementation.
#include <doctest/doctest.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/refocused.h"
#include "tests/support/test_scene.h"

namespace views_test {
namespace {

// The line scan would draw a halo as wide as the blur around silhouettes in a light field of one
// view.
TEST_CASE("views: line scans require the renderer and a star, and are the default of one mode") {
  using Positions = std::vector<starfocus_position>;
  const Positions star = {{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}};
  const Positions reordered = {star[0], star[3], star[1], star[4], star[2]};
  const struct {
    std::string name;
    Positions positions;  // empty: a star set
    int views;
    bool may_line_scan, has_default;
  } rows[] = {{"one view", {}, 1, true, false},
              {"a star of 5", {}, 5, true, true},
              {"the positions of a star", star, 5, true, true},
              {"a star in another order", reordered, 5, false, false},
              {"a star of 17", {}, 17, true, true},
              {"three views", {{0, 0}, {1, 0}, {0, 1}}, 3, false, false}};
  std::map<starfocus_mode, std::vector<uint8_t>> pictures_of_star;
  for (const auto& row : rows) {
    test::Scene scene = test::RandomScene(150, 90, row.views, -4, 6, 5);
    scene.positions = row.positions;
    if (row.name == "a star in another order") {
      auto& pictures = scene.pictures;
      pictures = {pictures[0], pictures[3], pictures[1], pictures[4], pictures[2]};
    }
    test::Config config = test::ConfigFor(scene, 16);
    config.features |= STARFOCUS_FEATURE_STREAMING;
    test::Engine with(config);
    config.tuning.line_scan = nullptr;
    test::Engine without(config);
    for (const starfocus_mode mode : test::kModes) {
      CAPTURES(row.name, mode);
      const bool blur = mode == STARFOCUS_MODE_BLUR;  // ignores the renderer
      const bool by_default = mode == STARFOCUS_MODE_FRAME && row.has_default;
      test::Report slices_report, report;
      const starfocus::Params by_slices = test::Params(2, 1, mode, STARFOCUS_RENDERER_SLICES);
      const starfocus::Params by_itself = test::Params(2, 1, mode, STARFOCUS_RENDERER_AUTO);
      const starfocus::Params by_lines = test::Params(2, 1, mode, STARFOCUS_RENDERER_LINE_SCAN);
      const auto slices = test::OutputOf(&with, by_slices, scene, &slices_report).bytes;
      // Explicit views at the positions of a star give the pictures of the star, in any order.
      if (row.views == 5) CHECK(pictures_of_star.emplace(mode, slices).first->second == slices);
      CHECK((test::OutputOf(&with, by_itself, scene).bytes == slices) == !by_default);
      CHECK(test::OutputOf(&without, by_slices, scene).bytes == slices);
      CHECK(test::OutputOf(&without, by_itself, scene, &report).bytes == slices);
      CHECK(report.n == slices_report.n);
      CHECK(report.rendered_samples == slices_report.rendered_samples);
      for (test::Engine* engine : {&with, &without}) {
        const bool legal = blur || (engine == &with && row.may_line_scan);
        const starfocus_status status = legal ? STARFOCUS_OK : STARFOCUS_ERROR_FEATURE;
        test::Output out(150, 90);
        CHECK(test::Refocus(engine, by_lines, scene, &out) == status);
        CHECK(out.Untouched() == !legal);
        CHECK((out.bytes == slices) == blur);
        if (by_default && legal) CHECK(test::OutputOf(engine, by_itself, scene).bytes == out.bytes);
        CHECK(starfocus_stream_begin(engine->get(), &by_lines) == status);
      }
    }
  }
}

}  // namespace
}  // namespace views_test
