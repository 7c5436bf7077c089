// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/robust_range.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace starfocus {

RobustRange RobustRangeOf(const std::vector<float>& values) {
  constexpr size_t kOneOf = 1000;
  std::vector<float> known;
  known.reserve(values.size());
  std::copy_if(values.begin(), values.end(), std::back_inserter(known),
               [](float value) { return std::isfinite(value); });
  if (known.empty()) return {};
  const auto beyond = static_cast<ptrdiff_t>((known.size() - 1) / kOneOf);
  const auto at_low = known.begin() + beyond, at_high = known.end() - 1 - beyond;
  std::nth_element(known.begin(), at_low, known.end());
  const float low = *at_low;
  std::nth_element(at_low, at_high, known.end());
  return {true, low, *at_high};
}

}  // namespace starfocus
