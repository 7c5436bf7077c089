// SPDX-License-Identifier: Apache-2.0
// Tests which renderer draws the views of a light field, and views at explicit positions. Random
// trials compare the pictures of views at any positions with the second implementation.
#include <doctest/doctest.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/refocused.h"
#include "tests/support/test_scene.h"

namespace views_test {
namespace {

std::vector<uint8_t> Picture(const test::Scene& scene, starfocus_mode mode,
                             starfocus_renderer renderer) {
  return test::RefocusScene(scene, test::ConfigFor(scene), test::Params(2, 1, mode, renderer)).rgb;
}

TEST_CASE("views: explicit views at star positions give the result of a star set, in any order") {
  const auto block_of = [](const test::Scene& scene) {
    return Picture(scene, STARFOCUS_MODE_BLOCK, STARFOCUS_RENDERER_SLICES);
  };
  const auto paper_of = [](const test::Scene& scene, starfocus_renderer renderer) {
    return Picture(scene, STARFOCUS_MODE_FRAME, renderer);
  };
  for (const int views : {5, 9, 17}) {
    test::Scene scene = test::RandomScene(70, 50, views, -4, 6, 5);
    const std::vector<uint8_t> block = block_of(scene);
    const std::vector<uint8_t> paper = paper_of(scene, STARFOCUS_RENDERER_LINE_SCAN);
    std::vector<starfocus_position> positions;
    for (int k = 0; k < views; ++k) positions.push_back(scene.PositionOf(k));
    scene.positions = positions;
    CHECK(block_of(scene) == block);
    CHECK(paper_of(scene, STARFOCUS_RENDERER_LINE_SCAN) == paper);
    CHECK(paper_of(scene, STARFOCUS_RENDERER_AUTO) == paper);
    // Only slices accept the views in any order.
    for (const int other : {2, 4, 3}) {
      std::swap(scene.positions[1], scene.positions[size_t(other)]);
      std::swap(scene.pictures[1], scene.pictures[size_t(other)]);
    }
    CHECK(block_of(scene) == block);
  }
}

// The line scan would draw a halo as wide as the blur around silhouettes in a light field of one
// view.
TEST_CASE("views: line scans require the renderer and a star, and are the default of one mode") {
  const struct {
    std::string name;
    std::vector<starfocus_position> positions;  // empty: a star set
    int views;
    bool may_line_scan, has_default;
  } rows[] = {{"one view", {}, 1, true, false},
              {"a star of 5", {}, 5, true, true},
              {"a star of 17", {}, 17, true, true},
              {"three views", {{0, 0}, {1, 0}, {0, 1}}, 3, false, false}};
  for (const auto& row : rows) {
    test::Scene scene = test::RandomScene(150, 90, row.views, -4, 6, 5);
    scene.positions = row.positions;
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
