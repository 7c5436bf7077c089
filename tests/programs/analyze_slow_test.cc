// SPDX-License-Identifier: Apache-2.0
// Tests the results of the subcommand analyze. The test is in a separate file, because analyze
// takes longer than all other subcommands together.
#include <doctest/doctest.h>

#include <filesystem>
#include <string>

#include "tests/programs/call_program.h"
#include "tests/support/sanitizers.h"
#include "tests/support/temp_folder.h"

namespace starfocus::analyze_slow_test {
namespace {

namespace fs = std::filesystem;

// With sanitizers, the largest blur is just large enough for every layer by every rule. With this
// blur, the test runs all code of analyze in a fraction of the usual time.
constexpr const char* kMaxBlur = test::kSanitized ? "25" : "40";

TEST_CASE("cli: analyze agrees with the paper and writes its tables") {
  TempFolder folder;
  const Outcome outcome = Call(folder, "analyze -o a/b --max-blur " + std::string(kMaxBlur));
  CHECK(outcome.code == 0);
  CHECK(outcome.err == "");
  for (const char* bad : {"DIFFERS", "FAILS", "MORE", "unexplained", "nan"}) {
    CHECK(!Contains(outcome.out, bad));
  }
  CHECK(Contains(outcome.out, "agrees"));
  for (const char* name : {"table1", "fig4", "fig5a", "fig5b", "fig6", "fig6_points", "fig8",
                           "subapertures", "engine"}) {
    CAPTURE(name);
    const std::string csv = Text(folder.file("a/b/" + std::string(name) + ".csv"));
    CHECK(Contains(csv, ","));
    CHECK(!Contains(csv, "nan"));
  }
  const bool drawn = outcome.out.find("gnuplot is missing") == std::string::npos;
  for (const char* name : {"fig4", "fig5", "fig6", "fig8", "subapertures", "engine"}) {
    CAPTURE(name);
    const std::string path = folder.file("a/b/" + std::string(name) + ".svg");
    CHECK(fs::exists(path) == drawn);
    if (drawn) CHECK(Contains(Text(path), "</svg>"));
  }
}

}  // namespace
}  // namespace starfocus::analyze_slow_test
