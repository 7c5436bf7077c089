// SPDX-License-Identifier: Apache-2.0
// Tries to break the engine: families of random refocusings, each with a property that must hold.
// A case is its family and a number, nothing else, so that every failure can be repeated.
#ifndef STARFOCUS_TESTS_STRESS_STRESS_H_
#define STARFOCUS_TESTS_STRESS_STRESS_H_

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tests/support/test_scene.h"

namespace starfocus::stress {

struct Outcome {
  double error = 0;     // what Family::measures, of this case
  std::string failure;  // one line; empty when all is well
};

struct Family {
  const char* name;
  const char* measures;  // what `error` is
  int share;             // cases per round
  Outcome (*run)(test::Random* random);
};

const std::vector<Family>& Families();

struct FamilyReport {
  const Family* family = nullptr;
  uint64_t cases = 0, failures = 0;
  double largest = 0;         // error
  uint64_t largest_case = 0;  // the case that had it
};

struct Report {
  std::vector<FamilyReport> families;
  uint64_t cases = 0, failures = 0;
  double seconds = 0;
};

struct Options {
  double seconds = 10;
  uint64_t seed = 1;
  std::string family;                        // empty: all
  std::function<void(double seconds)> done;  // told of the time that has gone, if there
};

// One case; `text` gets what it was when it fails.
Outcome RunCase(const Family& family, uint64_t number);

// Runs cases of all families in turn until the time is up; told of each failure in a line.
Report RunStress(const Options& options, const std::function<void(const std::string&)>& failed);

}  // namespace starfocus::stress

#endif  // STARFOCUS_TESTS_STRESS_STRESS_H_
