// SPDX-License-Identifier: Apache-2.0
// Tests the order of file names by their numbers.
#include "platform/natural_order.h"

#include <doctest/doctest.h>

#include <algorithm>

namespace starfocus::natural_order_test {
namespace {

using Names = std::vector<std::string>;

TEST_CASE("natural order: names are sorted by their numbers, whatever order they come in") {
  const Names sorted = {"-1",
                        "0",
                        "00",
                        "1.5",
                        "1.10",
                        "2",
                        "F_1",
                        "a",
                        "a01",
                        "a1",
                        "a1b2",
                        "a1b10",
                        "a2b1",
                        "a10",
                        "a10-x",
                        "a010_1",
                        "frame",
                        "frame_9.png",
                        "frame_10.png",
                        "frame_18446744073709551616",
                        "frame_18446744073709551617"};
  for (const std::string& a : sorted) {
    for (const std::string& b : sorted) {
      CAPTURE(a);
      CAPTURE(b);
      CHECK(NaturalLess(a, b) == (&a < &b));
    }
  }
  Names names = sorted;
  for (int turn = 0; turn < 50; ++turn) {
    std::next_permutation(names.begin(), names.end());
    std::reverse(names.begin() + turn % 10, names.end());
    Names again = names;
    std::sort(again.begin(), again.end(), NaturalLess);
    CHECK(again == sorted);
  }
}

TEST_CASE("natural order: a name has a shape and numbers without leading zeros") {
  const NumberedName name = ParseNumberedName("Shot_02_depth_0104");
  CHECK(name.shape == "shot_#_depth_#");
  CHECK(name.numbers == Names{"2", "104"});
  CHECK(ParseNumberedName("000").numbers == ParseNumberedName("0").numbers);
  CHECK(ParseNumberedName("depth").numbers.empty());
}

}  // namespace
}  // namespace starfocus::natural_order_test
