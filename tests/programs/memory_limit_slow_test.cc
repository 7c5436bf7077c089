// SPDX-License-Identifier: Apache-2.0
// Runs the programs with too little memory, under limits that increase in small steps. A program
// must either succeed, or report "out of memory" and leave no files.
#include <doctest/doctest.h>

#include <filesystem>
#include <string>

#include "platform/image_io.h"
#include "tests/programs/session.h"
#include "tests/support/sanitizers.h"

namespace starfocus::memory_limit_slow_test {
namespace {

namespace fs = std::filesystem;

constexpr int kSteps = 25;

Outcome CallWithin(const TempFolder& folder, int limit, const std::string& arguments) {
  return Call(folder, arguments, "ulimit -v " + std::to_string(limit) + " &&");
}

// Returns approximately the lowest limit in KiB at which a program runs the trivial command
// `little`.
int FindStart(const TempFolder& folder, const std::string& little) {
  int low = 1000, high = 100000;
  REQUIRE(CallWithin(folder, high, little).code == 0);
  while (high - low > 32) {
    const int middle = (low + high) / 2;
    (CallWithin(folder, middle, little).code == 0 ? high : low) = middle;
  }
  return high;
}

// Runs a command with enough memory, and then under memory limits from `start` to `start` + `range`
// KiB. `output` is the file or folder that the command writes, if any, and `file` is the file to
// compare.
void CheckLimits(const TempFolder& folder, int start, const std::string& arguments, int range,
                 const std::string& output, const std::string& file) {
  CAPTURE(arguments);
  const auto written = [&] { return file.empty() ? "" : Text(folder.file(file)); };
  const Outcome right = Call(folder, arguments);
  const std::string right_file = written();
  int failures = 0;
  for (int step = 0; step <= kSteps; ++step) {
    const int limit = start + range * step / kSteps;
    CAPTURE(limit);
    if (!output.empty()) fs::remove_all(folder.file(output));
    const Outcome outcome = CallWithin(folder, limit, arguments);
    CAPTURE(outcome.err);
    if (outcome.code == 0) {
      CHECK(!Contains(outcome.err, "out of memory"));
      CHECK(outcome.out == right.out);
      CHECK(written() == right_file);
      continue;
    }
    ++failures;
    CHECK(outcome.code == 1);
    CheckErrorLine(outcome.err);
    CHECK(Contains(outcome.err, "out of memory"));
    if (output == file && !file.empty()) CHECK(!fs::exists(folder.file(file)));
  }
  CHECK(failures > 0);
  CHECK(failures < kSteps);
}

TEST_CASE("memory limits: under any limit, a program reports one error or writes the right output" *
          doctest::skip(test::kSanitized)) {
  TempFolder folder;
  Succeed(folder, "scene lf --size 240x180 --views 5");
  Succeed(folder, "refocus lf --focus 2 -o right.png");
  const int start = FindStart(folder, "--version"), lab = FindStart(folder, "sheet --help");
  const std::string refocus = "refocus lf --focus 2 -o a.png --threads ";
  CheckLimits(folder, start, refocus + "1", 6000, "a.png", "a.png");
  CheckLimits(folder, start, refocus + "8", 90000, "a.png", "a.png");
  CheckLimits(folder, lab, "sheet right.png right.png -o a.png", 4000, "a.png", "a.png");
  CheckLimits(folder, lab, "scene new --size 240x180 --views 5 --threads 8", 90000, "new",
              "new/view_+0.0_+1.0.png");
  CheckLimits(folder, start, "info lf", 2500, "", "");
  CheckLimits(folder, lab, "compare right.png lf/view_+0.0_+0.0.png", 1500, "", "");
}

}  // namespace
}  // namespace starfocus::memory_limit_slow_test
