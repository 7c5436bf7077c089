// SPDX-License-Identifier: Apache-2.0
// Run-time checks of the ranges in fixed.h; this file is empty without STARFOCUS_CHECK_RANGES.
#include "lib/base/fixed.h"

#ifdef STARFOCUS_CHECK_RANGES
#include <cstdio>
#include <cstdlib>

namespace starfocus {

void (*on_range_failure)(const FixedRange& range, int64_t value) = nullptr;

void FailRange(const FixedRange& range, int64_t value) {
  if (on_range_failure != nullptr) {
    on_range_failure(range, value);
    return;
  }
  std::fprintf(stderr, "starfocus: %s is %lld, outside [%lld, %lld]\n", range.name,
               static_cast<long long>(value), static_cast<long long>(range.low),
               static_cast<long long>(range.high));
  std::abort();
}

}  // namespace starfocus
#endif
