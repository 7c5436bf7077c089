// SPDX-License-Identifier: Apache-2.0
#include "platform/natural_order.h"

#include "platform/text.h"

namespace starfocus {
namespace {

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

// Reads the number that starts at `*at`, and moves `*at` behind it. Returns its digits without
// leading zeros; the result for 0 is empty.
std::string TakeNumber(const std::string& text, size_t* at) {
  while (*at < text.size() && text[*at] == '0') ++*at;
  const size_t begin = *at;
  while (*at < text.size() && IsDigit(text[*at])) ++*at;
  return text.substr(begin, *at - begin);
}

}  // namespace

bool NaturalLess(const std::string& a, const std::string& b) {
  size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (IsDigit(a[i]) && IsDigit(b[j])) {
      const std::string first = TakeNumber(a, &i), second = TakeNumber(b, &j);
      if (first.size() != second.size()) return first.size() < second.size();
      if (first != second) return first < second;
    } else {
      const auto first = static_cast<unsigned char>(a[i++]);
      const auto second = static_cast<unsigned char>(b[j++]);
      if (first != second) return first < second;
    }
  }
  if ((i < a.size()) != (j < b.size())) return j < b.size();
  return a < b;
}

NumberedName ParseNumberedName(const std::string& name) {
  NumberedName result;
  for (size_t at = 0; at < name.size();) {
    if (IsDigit(name[at])) {
      result.numbers.push_back(TakeNumber(name, &at));
      result.shape += '#';
    } else {
      result.shape += name[at++];
    }
  }
  result.shape = Lower(result.shape);
  return result;
}

}  // namespace starfocus
