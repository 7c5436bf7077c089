// SPDX-License-Identifier: Apache-2.0
// Stress test: families of random refocusings, each with a property that must hold. A family and a
// number identify a case, so that every failure can be repeated.
#ifndef STARFOCUS_TESTS_OPERATIONS_STRESS_H_
#define STARFOCUS_TESTS_OPERATIONS_STRESS_H_

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tests/support/test_scene.h"

namespace starfocus::stress {

struct Outcome {
  double error = 0;     // Value of the quantity that Family::measures names.
  std::string failure;  // Description of the failure in one line; empty without a failure.
};

struct Family {
  const char* name;
  const char* measures;  // Name of the quantity in Outcome::error.
  int share;             // Number of cases per round.
  Outcome (*run)(test::Random* random);
};

const std::vector<Family>& Families();

struct FamilyReport {
  const Family* family = nullptr;
  uint64_t cases = 0, failures = 0;
  double largest = 0;         // Largest error of all cases.
  uint64_t largest_case = 0;  // Number of the case with the largest error.
};

struct Report {
  std::vector<FamilyReport> families;
  uint64_t cases = 0, failures = 0;
  double seconds = 0;
};

struct Options {
  double seconds = 10;
  uint64_t seed = 1;
  std::string family;                        // Name of the family to run; empty: all families.
  std::function<void(double seconds)> done;  // Receives the elapsed time in seconds; may be empty.
};

// Runs one case. If the case fails, Outcome::failure describes the failure.
Outcome RunCase(const Family& family, uint64_t number);

// Runs cases of all families in turn until the time is up. Passes a line about each failure to
// `failed`.
Report RunStress(const Options& options, const std::function<void(const std::string&)>& failed);

}  // namespace starfocus::stress

#endif  // STARFOCUS_TESTS_OPERATIONS_STRESS_H_
