// SPDX-License-Identifier: Apache-2.0
#include "examples/command_line/arguments.h"

#include <algorithm>
#include <cstddef>

namespace starfocus {
namespace {

// Returns the edit distance of `a` and `b` (optimal string alignment): the number of letters to
// insert, remove, replace, or swap with the next letter.
size_t Distance(const std::string& a, const std::string& b) {
  std::vector<std::vector<size_t>> least(a.size() + 1, std::vector<size_t>(b.size() + 1));
  for (size_t i = 0; i <= a.size(); ++i) {
    for (size_t k = 0; k <= b.size(); ++k) {
      size_t& here = least[i][k];
      if (i == 0 || k == 0) {
        here = i + k;
        continue;
      }
      const bool same = a[i - 1] == b[k - 1];
      here = std::min(
          {least[i - 1][k] + 1, least[i][k - 1] + 1, least[i - 1][k - 1] + (same ? 0 : 1)});
      const bool swapped = i > 1 && k > 1 && a[i - 1] == b[k - 2] && a[i - 2] == b[k - 1];
      if (swapped) here = std::min(here, least[i - 2][k - 2] + 1);
    }
  }
  return least[a.size()][b.size()];
}

std::string WithoutDashes(const std::string& name) {
  return name.substr(std::min(name.find_first_not_of('-'), name.size()));
}

// Describes the parts of an option's type: the separator between the parts, and the number of
// parts. The type "X,Y" has two parts, and "D0:D1:N" has three. The separator is 0 if values of the
// type are not divided into parts.
struct Parts {
  char separator = 0;
  size_t count = 1;
};

bool IsPartName(char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); }

Parts PartsOf(const std::string& type) {
  Parts parts;
  // Values of a type such as "D,U ..." may be repeated.
  const std::string text = type.substr(0, type.find(' '));
  for (size_t i = 0; i < text.size(); ++i) {
    if (IsPartName(text[i])) continue;
    const bool inside = i > 0 && i + 1 < text.size() && IsPartName(text[i + 1]);
    const bool known = text[i] == ',' || text[i] == ':' || text[i] == 'x';
    if (!inside || !known || (parts.separator != 0 && parts.separator != text[i])) return {};
    parts.separator = text[i];
    ++parts.count;
  }
  return parts;
}

// Appends all numbers in `text` to `numbers`. `separator` or spaces separate the numbers. Returns
// false if the text contains anything else.
bool AddNumbers(const std::string& text, char separator, std::vector<std::string>* numbers) {
  const std::string between = std::string(" ") + separator;
  for (size_t begin = text.find_first_not_of(between); begin < text.size();) {
    const size_t end = std::min(text.find_first_of(between, begin), text.size());
    const std::string number = text.substr(begin, end - begin);
    if (number.find_first_not_of("0123456789+-.") != std::string::npos ||
        number.find_first_of("0123456789") == std::string::npos) {
      return false;
    }
    numbers->push_back(number);
    begin = text.find_first_not_of(between, end);
  }
  return true;
}

// Returns the complete value that starts with `first` and continues in the arguments from index
// `next`. Returns an empty string if `first` is already complete, or if separators cannot complete
// the value.
std::string Joined(const std::string& first, const std::vector<std::string>& arguments, size_t next,
                   const Parts& parts, std::string* found) {
  std::vector<std::string> numbers;
  *found = first;
  if (!AddNumbers(first, parts.separator, &numbers) || numbers.empty()) return "";
  const bool spaces = first.find(' ') != std::string::npos;
  if (numbers.size() >= parts.count && !spaces) return "";
  for (; numbers.size() < parts.count && next < arguments.size(); ++next) {
    if (!AddNumbers(arguments[next], parts.separator, &numbers)) return "";
    *found += " " + arguments[next];
  }
  if (numbers.size() != parts.count) return "";
  std::string joined = numbers[0];
  for (size_t k = 1; k < numbers.size(); ++k) joined += parts.separator + numbers[k];
  return joined;
}

Error WrongParts(const std::string& name, const std::string& type, const Parts& parts,
                 const std::string& joined, const std::string& found) {
  std::string fault = " (a comma is missing)";
  if (parts.separator == ':') fault = " (a colon is missing)";
  if (parts.separator == 'x') fault = " (an x is missing)";
  if (found.find(parts.separator) != std::string::npos) fault = " (with spaces)";
  return Error::Usage(
      name, type.substr(0, type.find(' ')) + " without spaces, as in " + name + " " + joined,
      "'" + found + "'" + fault);
}

}  // namespace

std::string NearestName(const std::string& typed, const std::vector<std::string>& names) {
  const std::string wanted = WithoutDashes(typed);
  const size_t far = std::max<size_t>(wanted.size() < 4 ? 2 : 3, wanted.size() / 3 + 1);
  size_t least = far;
  std::string nearest;
  for (const std::string& name : names) {
    const std::string its = WithoutDashes(name);
    // Accept a name even if the user has typed only the start of the name.
    const bool beginning = wanted.size() >= 3 && its.compare(0, wanted.size(), wanted) == 0;
    const size_t distance = beginning ? 1 : Distance(wanted, its);
    if (distance >= least || distance >= its.size()) continue;
    least = distance;
    nearest = name;
  }
  return nearest;
}

Error CheckSeparators(const std::vector<std::string>& arguments,
                      const std::vector<Option>& options) {
  for (size_t i = 0; i < arguments.size() && arguments[i] != "--"; ++i) {
    const size_t equals = arguments[i].find('=');
    const std::string name = arguments[i].substr(0, equals);
    for (const Option& option : options) {
      if (option.type == nullptr) continue;
      const Parts parts = PartsOf(option.type);
      const std::vector<std::string> names = NamesOf(option);
      if (parts.separator == 0 || std::find(names.begin(), names.end(), name) == names.end()) {
        continue;
      }
      const bool inside = equals != std::string::npos;
      if (!inside && i + 1 == arguments.size()) continue;
      const std::string value = inside ? arguments[i].substr(equals + 1) : arguments[i + 1];
      std::string found;
      const std::string joined = Joined(value, arguments, i + (inside ? 1 : 2), parts, &found);
      if (joined.empty()) continue;
      return WrongParts(name, option.type, parts, joined, found);
    }
  }
  return {};
}

}  // namespace starfocus
