// SPDX-License-Identifier: Apache-2.0
// Computes the value range of a map without the few outliers that sensors and matching algorithms
// produce.
#ifndef STARFOCUS_PLATFORM_READERS_ROBUST_RANGE_H_
#define STARFOCUS_PLATFORM_READERS_ROBUST_RANGE_H_

#include <vector>

namespace starfocus {

struct RobustRange {
  bool known = false;  // false if no value is finite
  float low = 0, high = 0;
};

// Returns the quantiles of 0.1 % and 99.9 % of the finite values. Returns the minimum and maximum
// if fewer than 1000 values are finite.
RobustRange RobustRangeOf(const std::vector<float>& values);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_ROBUST_RANGE_H_
