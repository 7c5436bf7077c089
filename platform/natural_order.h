// SPDX-License-Identifier: Apache-2.0
// Compares file names by the numbers in them, as people count frames: frame_9 before frame_10.
#ifndef STARFOCUS_PLATFORM_NATURAL_ORDER_H_
#define STARFOCUS_PLATFORM_NATURAL_ORDER_H_

#include <string>
#include <vector>

namespace starfocus {

// Returns true if `a` comes before `b`. Runs of the digits 0 to 9 are compared as numbers of any
// length, and other characters by their bytes. Names that differ only in leading zeros are compared
// by their bytes, so that the order of different names is always defined.
bool NaturalLess(const std::string& a, const std::string& b);

// A name without its numbers: "shot_2_depth_0104" has the shape "shot_#_depth_#" and the numbers
// "2" and "104". Numbers have no leading zeros, and letters of the shape are in lower case.
struct NumberedName {
  std::string shape;
  std::vector<std::string> numbers;
};

NumberedName ParseNumberedName(const std::string& name);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_NATURAL_ORDER_H_
