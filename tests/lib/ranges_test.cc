// SPDX-License-Identifier: Apache-2.0
// Tests the run-time checks of the table in fixed.h.
#include <doctest/doctest.h>

#include "lib/base/fixed.h"

namespace ranges_test {
namespace {

constexpr starfocus::FixedRange kRange = {"test", -2, 3};

#ifdef STARFOCUS_CHECK_RANGES
int told = 0;
int64_t last = 0;

void Remember(const starfocus::FixedRange& range, int64_t value) {
  CHECK(range.name == kRange.name);
  ++told;
  last = value;
}

TEST_CASE("ranges: only a value outside its range is reported") {
  starfocus::on_range_failure = Remember;
  const int16_t values[] = {-2, 3, 4, 0};
  starfocus::CheckAll(kRange, values, 4);
  CHECK(told == 1);
  CHECK(last == 4);
  CHECK(starfocus::Checked(kRange, -3) == -3);
  CHECK(told == 2);
  starfocus::on_range_failure = nullptr;
}
#else
TEST_CASE("ranges: a build without range checks reports nothing") {
  static_assert(starfocus::Checked(kRange, 4) == 4);
  const int16_t values[] = {-3, 4};
  starfocus::CheckAll(kRange, values, 2);
}
#endif

}  // namespace
}  // namespace ranges_test
