// SPDX-License-Identifier: Apache-2.0
// The range of a map without the few values beyond it that sensors and matchers get wrong.
#ifndef STARFOCUS_PLATFORM_READERS_ROBUST_RANGE_H_
#define STARFOCUS_PLATFORM_READERS_ROBUST_RANGE_H_

#include <vector>

namespace starfocus {

struct RobustRange {
  bool known = false;  // false: no value is finite
  float low = 0, high = 0;
};

// The quantiles of 0.1 % and 99.9 % of the finite values; of less than 1000 values both ends.
RobustRange RobustRangeOf(const std::vector<float>& values);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_ROBUST_RANGE_H_
