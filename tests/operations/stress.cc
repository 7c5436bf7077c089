// SPDX-License-Identifier: Apache-2.0
#include "tests/operations/stress.h"

#include <chrono>
#include <stdexcept>

#include "tests/operations/families.h"
#include "tests/operations/ranges.h"

namespace starfocus::stress {

const std::vector<Family>& Families() {
  static const std::vector<Family> families = {
      {"constant", "grey levels of difference from the constant", 8, Constant},
      {"squares",
       "grey levels of difference from the inverse of the result for the inverted picture", 6,
       Squares},
      {"limits", "grey levels of difference from the inverted result or the constant", 1, Limits},
      {"thresholds",
       "grey levels of difference from the inverse of the result for the inverted picture", 6,
       Thresholds},
      {"far-focus", "grey levels of difference from the inverted result or the constant", 6,
       FarFocus},
      {"extremes", "grey levels of difference from the inverted result or the constant", 6,
       Extremes},
      {"noise", "grey levels of difference from the inverse of the result for the inverted picture",
       6, Noise},
      {"energy", "grey levels of difference from the mean of the input", 2, Energy},
      {"steps", "overshoot as a fraction of the step", 6, Steps},
      {"mirrors", "grey levels of difference from the mirrored or transposed picture", 4, Mirrors},
      {"side-views", "grey levels of change if the side views of a flat scene change", 4,
       SideViews},
      {"continuity", "grey levels of change per step of 1/64 in focus or 1/256 in aperture", 6,
       Continuity},
      {"differential", "grey levels of difference between two ways to refocus", 9, Differential},
      {"maps", "pixels of disparity between maps that must be equal", 2, Maps},
  };
  return families;
}

Outcome RunCase(const Family& family, uint64_t number) {
  test::Random random(number);
  for (int k = 0; k < 8; ++k) random.Next();  // neighbouring seeds start with similar numbers
  ForgetRangeFailure();
  Outcome outcome;
  try {
    outcome = family.run(&random);
  } catch (const std::runtime_error& error) {
    outcome.failure = error.what();
  }
  if (outcome.failure.empty()) outcome.failure = RangeFailure();
  return outcome;
}

Report RunStress(const Options& options, const std::function<void(const std::string&)>& failed) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  Report report;
  for (const Family& family : Families()) {
    if (!options.family.empty() && options.family != family.name) continue;
    report.families.emplace_back();
    report.families.back().family = &family;
  }
  uint64_t number = options.seed * 1000000000u;
  while (!report.families.empty() && seconds() < options.seconds) {
    for (FamilyReport& part : report.families) {
      for (int k = 0; k < part.family->share && seconds() < options.seconds; ++k, ++number) {
        const Outcome outcome = RunCase(*part.family, number);
        ++part.cases;
        if (!outcome.failure.empty()) {
          ++part.failures;
          failed("starfocus-lab stress --family " + std::string(part.family->name) + " --case " +
                 std::to_string(number) + "  # " + outcome.failure);
        } else if (outcome.error > part.largest) {
          part.largest = outcome.error;
          part.largest_case = number;
        }
        if (options.done) options.done(seconds());
      }
    }
  }
  for (const FamilyReport& part : report.families) {
    report.cases += part.cases;
    report.failures += part.failures;
  }
  report.seconds = seconds();
  return report;
}

}  // namespace starfocus::stress
