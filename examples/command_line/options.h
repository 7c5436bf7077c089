// SPDX-License-Identifier: Apache-2.0
// What options take, for their tables: numbers, choices and others, each read into a variable whose
// value is the default.
#ifndef STARFOCUS_EXAMPLES_COMMAND_LINE_OPTIONS_H_
#define STARFOCUS_EXAMPLES_COMMAND_LINE_OPTIONS_H_

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "examples/command_line/command.h"
#include "platform/view_files.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// A whole number in [low, high].
Target Whole(int low, int high, int* value);
Target Whole(int low, int high, std::optional<int>* value);
Target Threads(int* value);  // 1 to 64

// A finite number; those in [low, high] are what is `expected`.
Target Number(double* value);
Target Number(std::optional<double>* value);
Target Number(double low, double high, const std::string& expected, double* value);
Target Number(double low, double high, const std::string& expected, std::optional<double>* value);

// One of several words, each with its value.
template <class T>
using Words = std::vector<std::pair<const char*, T>>;
template <class T>
Target Choice(const Words<T>& words, T* value);
Target Transfer(starfocus_transfer* value);

// Two whole numbers from 0 to 65535.
struct Pixel {
  int x = 0, y = 0;
};
Target Pair(char separator, Pixel* value);
Target Pair(char separator, std::optional<Pixel>* value);

// X,Y,W,H: a rectangle of whole numbers, neither side 0.
Target Region(starfocus_region* value);

// 17, 9, 5 or 1: those of the star, or U,V:U,V and so on: views at those positions, the first one
// at 0,0, all within +-1, rounded to four decimals as names of files are.
Target Views(Positions* positions);

// Finite numbers with `separator` between them; none where one is none.
std::vector<double> ReadNumbers(const std::string& text, char separator);

// `value` with %g.
std::string Short(double value);

// "a, b or c".
std::string OneOf(const std::vector<std::string>& words);

template <class T>
Target Choice(const Words<T>& words, T* value) {
  std::vector<std::string> names;
  std::string shown;
  for (const auto& [name, its] : words) {
    names.push_back(name);
    if (its == *value) shown = name;
  }
  const auto read = [words, expected = OneOf(names), value](const std::string& text) {
    for (const auto& [name, its] : words) {
      if (text != name) continue;
      *value = its;
      return std::string();
    }
    return expected;
  };
  return Target(read, shown);
}

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_COMMAND_LINE_OPTIONS_H_
