// SPDX-License-Identifier: Apache-2.0
// Functions that refocus a scene and return the picture and the report.
#ifndef STARFOCUS_TESTS_SUPPORT_REFOCUSED_H_
#define STARFOCUS_TESTS_SUPPORT_REFOCUSED_H_

#include <doctest/doctest.h>

#include <cstdint>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/test_scene.h"

namespace test {

// Refocuses a scene and returns the picture, which is as large as the region of `params`.
inline Output OutputOf(Engine* engine, const starfocus::Params& params, const Scene& scene,
                       starfocus_report* report = nullptr,
                       const starfocus_callbacks& callbacks = {}) {
  const starfocus_region& region = params.region;
  Output out(region.width > 0 ? region.width : scene.width,
             region.width > 0 ? region.height : scene.height);
  REQUIRE(Refocus(engine, params, scene, &out, callbacks, report) == STARFOCUS_OK);
  return out;
}

// Refocuses a scene with a new engine and returns the picture.
inline Output OutputOf(const test::Config& config, const starfocus::Params& params,
                       const Scene& scene, starfocus_report* report = nullptr) {
  Engine engine(config);
  return OutputOf(&engine, params, scene, report);
}

struct Refocused {
  std::vector<uint8_t> rgb;  // packed rows
  test::Report report;
};

inline Refocused RefocusScene(const Scene& scene, const test::Config& config,
                              const starfocus::Params& params) {
  Refocused refocused;
  refocused.rgb = OutputOf(config, params, scene, &refocused.report).bytes;
  return refocused;
}

}  // namespace test

#endif  // STARFOCUS_TESTS_SUPPORT_REFOCUSED_H_
