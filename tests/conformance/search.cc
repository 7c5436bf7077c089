// SPDX-License-Identifier: Apache-2.0
// conformance_search FIRST COUNT: tries the trials of COUNT seeds from FIRST on, each with a star
// and with views anywhere, and prints those in which the engine is more gray levels than they may
// be from the double-precision reference.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <cstdio>
#include <cstdlib>

#include "tests/conformance/trial.h"

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: conformance_search FIRST COUNT\n");
    return 2;
  }
  doctest::Context context;
  context.setAsDefaultForAssertsOutOfTestCases();
  context.setAssertHandler([](const doctest::AssertData& assert) {
    if (!assert.m_failed) return;
    std::fprintf(stderr, "%s:%d: %s is false\n", assert.m_file, assert.m_line, assert.m_expr);
    std::exit(2);
  });
  const uint64_t first = std::strtoull(argv[1], nullptr, 10);
  const uint64_t count = std::strtoull(argv[2], nullptr, 10);
  conformance::Distance all;
  uint64_t failed = 0;
  for (uint64_t k = 0; k < 2 * count; ++k) {
    const uint64_t seed = first + k / 2;
    const conformance::Trial trial = conformance::MakeTrial(seed, k % 2 == 1);
    const conformance::Distance distance = conformance::Measure(trial);
    all.Add(distance);
    if (distance.largest <= conformance::MostLevels(trial)) continue;
    ++failed;
    std::printf("%llu: %d levels (%.3f unrounded), %s\n", static_cast<unsigned long long>(seed),
                distance.largest, distance.unrounded, trial.Text().c_str());
    std::fflush(stdout);
  }
  all.Print("all trials");
  std::printf("%llu of %llu trials too many levels apart\n",
              static_cast<unsigned long long>(failed), static_cast<unsigned long long>(2 * count));
  return failed == 0 ? 0 : 1;
}
