// SPDX-License-Identifier: Apache-2.0
// Checks for the kernels of all kernel tables, and comparison of results with values computed by
// hand.
#ifndef STARFOCUS_TESTS_KERNELS_CHECK_KERNELS_H_
#define STARFOCUS_TESTS_KERNELS_CHECK_KERNELS_H_

#include <doctest/doctest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "tests/kernels/kernel_call.h"

namespace test {

// Calls each kernel of a table with random arguments on every target. All targets must return the
// bits that the reference returns, and write nothing else. `Call` is the type of kernel call, such
// as KernelCall, that the cases make.
template <class Call, class Cases, class Table>
void CheckKernels(const Cases& cases, const Table& reference,
                  const std::vector<const Table*>& targets) {
  constexpr int kRounds = STARFOCUS_EMULATED ? 200 : 1000;
  uint64_t seed = 0;
  for (const auto& one : cases) {
    const std::string name = one.kernel;
    CAPTURE(name);
    Met met;
    ++seed;
    for (int round = 0; round < kRounds; ++round) {
      Draw draw = Draw::ForTest(seed, round);
      Call call(&draw);
      one.make(&draw, &call);
      const std::string wrong = call.Check(reference, targets, &met);
      CAPTURE(round);
      REQUIRE_MESSAGE(wrong.empty(), wrong);
    }
    // Each situation in `met` must occur more than kRounds / 50 times, so that the random calls
    // test the situation.
    for (const auto& what : met) {
      CAPTURE(what.first);
      CHECK(what.second > kRounds / 50);
    }
  }
}

// Compares an array with the expected values, element by element.
template <class T>
void CheckValues(const char* what, const T* found, const std::vector<int64_t>& expected) {
  CAPTURE(what);
  for (size_t n = 0; n < expected.size(); ++n) {
    CAPTURE(n);
    CHECK(int64_t(found[n]) == expected[n]);
  }
}

}  // namespace test

#endif  // STARFOCUS_TESTS_KERNELS_CHECK_KERNELS_H_
