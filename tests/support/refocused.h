// SPDX-License-Identifier: Apache-2.0
// A scene refocused by an engine of its own: the picture and the report.
#ifndef STARFOCUS_TESTS_SUPPORT_REFOCUSED_H_
#define STARFOCUS_TESTS_SUPPORT_REFOCUSED_H_

#include <doctest/doctest.h>

#include <cstdint>
#include <vector>

#include "starfocus/starfocus.h"
#include "tests/support/test_scene.h"

namespace test {

struct Refocused {
  std::vector<uint8_t> rgb;  // rows packed
  starfocus_report report = {};
};

inline Refocused RefocusScene(const Scene& scene, const starfocus_config& config,
                              const starfocus_params& params) {
  Engine engine(config);
  Output out(scene.width, scene.height);
  Refocused refocused;
  REQUIRE(Refocus(&engine, params, scene, &out, nullptr, nullptr, &refocused.report) ==
          STARFOCUS_OK);
  refocused.rgb = out.Tight();
  return refocused;
}

}  // namespace test

#endif  // STARFOCUS_TESTS_SUPPORT_REFOCUSED_H_
