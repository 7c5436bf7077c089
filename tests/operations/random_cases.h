// SPDX-License-Identifier: Apache-2.0
// Runs a property on random cases.
#ifndef STARFOCUS_TESTS_OPERATIONS_RANDOM_CASES_H_
#define STARFOCUS_TESTS_OPERATIONS_RANDOM_CASES_H_

#include <doctest/doctest.h>

#include <chrono>
#include <cstdlib>

#include "tests/support/rounds.h"
#include "tests/support/test_scene.h"

namespace properties {

// Checks `cases` cases. Environment variables select other cases: STARFOCUS_SECONDS checks as many
// cases as fit into this time, STARFOCUS_SEED=N starts from another number, and STARFOCUS_CASE=N
// repeats one case.
template <class Check>
void ForRandomCases(int cases, const Check& check) {
  using Clock = std::chrono::steady_clock;
  const char *one = std::getenv("STARFOCUS_CASE"), *seconds = std::getenv("STARFOCUS_SECONDS"),
             *seed = std::getenv("STARFOCUS_SEED");
  const auto number_of = [](const char* text) { return std::strtoull(text, nullptr, 10); };
  const std::chrono::duration<double> time(seconds != nullptr ? std::atof(seconds) : 0);
  const uint64_t first = one != nullptr    ? number_of(one)
                         : seed != nullptr ? 1000000000u * number_of(seed)
                                           : 1000000000u;
  const uint64_t end = first + (one != nullptr ? 1u : uint64_t(test::Rounds(cases)));
  const Clock::time_point start = Clock::now();
  for (uint64_t number = first; seconds != nullptr ? Clock::now() - start < time : number < end;
       ++number) {
    INFO("to repeat this case, set STARFOCUS_CASE=", number);
    test::Random random(number);
    for (int k = 0; k < 8; ++k) random.Next();  // neighbouring seeds start with similar numbers
    check(&random);
  }
}

}  // namespace properties

#endif  // STARFOCUS_TESTS_OPERATIONS_RANDOM_CASES_H_
