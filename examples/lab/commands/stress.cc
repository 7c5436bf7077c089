// SPDX-License-Identifier: Apache-2.0
// starfocus-lab stress: tests the engine with random cases for a given time.
#include "tests/operations/stress.h"

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <optional>

#include "examples/command_line/options.h"
#include "examples/lab/commands.h"
#include "platform/console.h"
#include "platform/file.h"
#include "platform/progress.h"
#include "tests/operations/rig.h"

namespace starfocus {
namespace {

struct StressOptions {
  double seconds = 10;
  uint64_t seed = 1;
  std::optional<uint64_t> number;
  std::string family;
};

std::string Names() {
  std::string names;
  for (const stress::Family& family : stress::Families()) {
    names += (names.empty() ? "" : ", ") + std::string(family.name);
  }
  return names;
}

const stress::Family* Find(const std::string& name) {
  for (const stress::Family& family : stress::Families()) {
    if (family.name == name) return &family;
  }
  return nullptr;
}

template <class T>
Target Count(T* value, const std::string& shown) {
  const auto read = [value](const std::string& text) -> std::string {
    if (text.empty() || text.size() > 19 || text.find_first_not_of("0123456789") < text.size()) {
      return "a whole number";
    }
    *value = std::strtoull(text.c_str(), nullptr, 10);
    return "";
  };
  return Target(read, shown);
}

Error RepeatCase(const stress::Family& family, uint64_t number) {
  const stress::Outcome outcome = stress::RunCase(family, number);
  if (!outcome.failure.empty()) return Error(ErrorKind::kInput, outcome.failure);
  std::printf("%s %" PRIu64 ": %g %s\n", family.name, number, outcome.error, family.measures);
  return {};
}

void Print(const stress::Report& report) {
  std::printf("%-12s %8s  %-13s %s\n", "family", "cases", "largest error", "");
  for (const stress::FamilyReport& part : report.families) {
    std::printf("%-12s %8" PRIu64 "  %-13.4g %s", part.family->name, part.cases, part.largest,
                part.family->measures);
    if (part.largest > 0) std::printf(" (case %" PRIu64 ")", part.largest_case);
    std::printf("\n");
  }
  std::printf("%" PRIu64 " cases in %.1f s (%.0f a minute) on", report.cases, report.seconds,
              static_cast<double>(report.cases) / report.seconds * 60);
  for (const simd::Kernels* kernels : stress::AllKernels()) std::printf(" %s", kernels->name);
  std::printf("\n");
}

stress::Report Try(stress::Options* wanted) {
  int64_t told = 0;  // number of milliseconds that the progress line already shows
  Progress progress("testing", std::max<int64_t>(1, int64_t(1000 * wanted->seconds)));
  wanted->done = [&](double seconds) {
    const auto now = static_cast<int64_t>(1000 * std::min(seconds, wanted->seconds));
    progress.Step(now - told);
    told = now;
  };
  return stress::RunStress(*wanted, [](const std::string& line) {
    PrintLine("FAILED: " + line);
    std::fflush(stdout);
  });
}

Error Run(const StressOptions& options) {
  stress::Options wanted;
  const stress::Family* family = Find(options.family);
  if (family == nullptr && (!options.family.empty() || options.number)) {
    return Error::Usage("--family", "one of " + Names(),
                        options.family.empty() ? "none" : options.family);
  }
  if (options.number) return RepeatCase(*family, *options.number);
  wanted.seconds = options.seconds;
  wanted.seed = options.seed;
  wanted.family = options.family;
  const stress::Report report = Try(&wanted);
  Print(report);
  if (report.failures == 0) return {};
  return Expected("stress", "no failures", std::to_string(report.failures));
}

}  // namespace

Command StressCommand() {
  static const std::string family_help = "Family of cases to test: " + Names() + "; default: all";
  const auto options = std::make_shared<StressOptions>();
  return {"stress",
          "Test the engine with random refocusings whose result is known or bounded",
          {
              {"--seconds", "S", "Duration of the test in seconds", Number(&options->seconds),
               Use::kDefault},
              {"--seed", "N", "Seed of the cases, a whole number of at most 19 digits",
               Count(&options->seed, std::to_string(options->seed)), Use::kDefault},
              {"--family", "FAMILY", family_help.c_str(), &options->family},
              {"--case", "N", "Number of one case of --family to repeat; default: new cases",
               Count(&options->number, "")},
          },
          [options] { return Run(*options); },
          {"starfocus-lab stress --seconds 60 --seed 7",
           "starfocus-lab stress --family differential --case 12"}};
}

}  // namespace starfocus
