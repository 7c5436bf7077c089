// SPDX-License-Identifier: Apache-2.0
#include "tests/operations/ranges.h"

#include "lib/base/fixed.h"

namespace starfocus::stress {
namespace {

#ifdef STARFOCUS_CHECK_RANGES
std::string first;

void Remember(const FixedRange& range, int64_t value) {
  if (!first.empty()) return;
  first = std::string(range.name) + " is " + std::to_string(value) + ", outside [" +
          std::to_string(range.low) + ", " + std::to_string(range.high) + "]";
}
#endif

}  // namespace

#ifdef STARFOCUS_CHECK_RANGES
std::string RangeFailure() { return first; }
void ForgetRangeFailure() {
  first.clear();
  on_range_failure = Remember;
}
#else
std::string RangeFailure() { return ""; }
void ForgetRangeFailure() {}
#endif

}  // namespace starfocus::stress
