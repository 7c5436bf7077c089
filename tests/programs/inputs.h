// SPDX-License-Identifier: Apache-2.0
// Makes inputs that several tests of the programs use.
#ifndef STARFOCUS_TESTS_PROGRAMS_INPUTS_H_
#define STARFOCUS_TESTS_PROGRAMS_INPUTS_H_

#include "platform/light_field.h"
#include "platform/runner.h"
#include "tests/programs/call_program.h"
#include "tests/support/closed_hair.h"

namespace starfocus {

// Writes two folders with a portrait: `truth` has the coverage of the hair, and `closed` has no
// coverage.
inline void PrepareHair(const TempFolder& folder) {
  const test::ClosedHair portrait = test::MakeClosedHair();
  LightField field;
  field.views.emplace_back(test::ClosedHair::kWidth, test::ClosedHair::kHeight);
  field.views[0].pixels = portrait.rgb;
  field.disparity.width = test::ClosedHair::kWidth;
  field.disparity.height = test::ClosedHair::kHeight;
  field.disparity.values = portrait.map;
  ThreadRunner runner(1);
  REQUIRE(SaveLightField(folder.file("closed"), field, &runner) == "");
  field.coverage = portrait.coverage;
  REQUIRE(SaveLightField(folder.file("truth"), field, &runner) == "");
}

// Writes a folder `lf` with disparities of 300 on the left and 0 on the right. At focus 0 and
// aperture 128/300 = 0.42667 (f/2.34375), the blur radius is 128 pixels.
inline void MakeDeepFolder(const TempFolder& folder) {
  Succeed(folder, "scene lf --size 40x30 --views 1");
  FloatMap map = ValueOf(ReadPfm(folder.file("lf/disparity.pfm")));
  for (size_t i = 0; i < map.values.size(); ++i) map.values[i] = i % 40 < 20 ? 300.0f : 0.0f;
  REQUIRE(WritePfm(folder.file("lf/disparity.pfm"), map) == "");
}

}  // namespace starfocus

#endif  // STARFOCUS_TESTS_PROGRAMS_INPUTS_H_
