// SPDX-License-Identifier: Apache-2.0
// Computes the range of a map without the few outliers of sensors and matching algorithms.
#ifndef STARFOCUS_PLATFORM_READERS_ROBUST_RANGE_H_
#define STARFOCUS_PLATFORM_READERS_ROBUST_RANGE_H_

#include <vector>

namespace starfocus {

struct RobustRange {
  bool known = false;  // false: the map has no finite value
  float low = 0, high = 0;
};

// Returns the quantiles of 0.1 % and 99.9 % of the finite values. If there are fewer than 1000
// values, returns their minimum and maximum.
RobustRange RobustRangeOf(const std::vector<float>& values);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_ROBUST_RANGE_H_
