// SPDX-License-Identifier: Apache-2.0
// Tests the error line that users see if a call is rejected.
#include "platform/problem.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "starfocus/starfocus.h"
#include "tests/support/config.h"

namespace problem_test {
namespace {

std::string Text(starfocus_status status, const starfocus_problem* problem) {
  return starfocus::Describe(status, problem).text;
}

TEST_CASE("problem: the line names a field with its range and value") {
  starfocus_problem problem = {};
  test::Config config;
  size_t bytes = 0;
  CHECK(Text(starfocus_workspace_size(&config, &bytes, &problem), &problem) ==
        "width: a field or an argument is outside its range (expected 1 to 65535, found 0)");
  config.width = config.height = 8;
  config.views = 2;
  config.positions[1] = {0, 1.5};
  CHECK(Text(starfocus_workspace_size(&config, &bytes, &problem), &problem) ==
        "positions[1].v: a field or an argument is outside its range (expected -1 to 1, found "
        "1.5)");
  CHECK(Text(starfocus_workspace_size(&config, nullptr, &problem), &problem) ==
        "bytes: a required pointer is null (expected not null)");
}

TEST_CASE("problem: the line names the place of a wrong disparity") {
  const starfocus_problem problem = {
      STARFOCUS_ERROR_DISPARITY, 0, "disparity", "-1 to 1", 2.5, -1, 1, 7, 3};
  const std::string text = Text(STARFOCUS_ERROR_DISPARITY, &problem);
  CHECK(text.find("(expected -1 to 1, found 2.5 at (7, 3))") != std::string::npos);
}

TEST_CASE("problem: without a field or for another call, the line has only the status's sentence") {
  starfocus_problem problem = {STARFOCUS_ERROR_RANGE, 0, "width", "1", std::nan(""), 0, 0, -1, -1};
  CHECK(Text(STARFOCUS_ERROR_RANGE, &problem) ==
        "width: a field or an argument is outside its range (expected 1)");
  CHECK(Text(STARFOCUS_ERROR_MEMORY, &problem) == "out of memory");
  CHECK(Text(STARFOCUS_ERROR_RANGE, nullptr) == starfocus_status_string(STARFOCUS_ERROR_RANGE));
  problem.field = "";
  CHECK(Text(STARFOCUS_ERROR_RANGE, &problem) == starfocus_status_string(STARFOCUS_ERROR_RANGE));
}

}  // namespace
}  // namespace problem_test
