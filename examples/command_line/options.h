// SPDX-License-Identifier: Apache-2.0
// Targets for tables of options: numbers, choices, the shape of an aperture, and other types. Each
// target parses a text into a variable. The initial value of the variable is the default of the
// option.
#ifndef STARFOCUS_EXAMPLES_COMMAND_LINE_OPTIONS_H_
#define STARFOCUS_EXAMPLES_COMMAND_LINE_OPTIONS_H_

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "examples/command_line/command.h"
#include "platform/result.h"
#include "platform/view_files.h"
#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"

namespace starfocus {

// Targets for an integer in [low, high].
Target Whole(int low, int high, int* value);
Target Whole(int low, int high, std::optional<int>* value);
Target Threads(int* value);  // 1 to 64

inline constexpr char kThreadsHelp[] =
    "Number of threads, 1 to 64; default: the number of cores that the process may use";

// Option --threads of a command whose default is the number of cores that the process may use. Sets
// `value` to this default.
Option ThreadsOption(int* value);

// Targets for a finite number. `expected` describes the range [low, high] in error messages.
Target Number(double* value);
Target Number(std::optional<double>* value);
Target Number(double low, double high, const std::string& expected, double* value);
Target Number(double low, double high, const std::string& expected, std::optional<double>* value);

// Target for one of several words, each of which stands for a value.
template <class T>
using Words = std::vector<std::pair<const char*, T>>;
template <class T, class Value>
Target Choice(const Words<T>& words, Value* value);
Target Transfer(starfocus_transfer* value);
Target Transfer(std::optional<starfocus_transfer>* value);

// Target for an f-stop above 0. Accepts the ways in which f-stops are printed: 1.8, f/1.8
// and f1.8.
Target FStop(std::optional<double>* value);

// Pixel coordinates, which are two integers from 0 to 65535.
struct Pixel {
  int x = 0, y = 0;
};
Target Pair(char separator, Pixel* value);
Target Pair(char separator, std::optional<Pixel>* value);

// Disparities in focus, far <= near.
struct FocusBand {
  double far = 0, near = 0;
};

// Target for X,Y,W,H, a rectangle of integers with W and H above 0.
Target Region(starfocus_region* value);

// Target for views: 17, 9, 5 or 1 for that number of views in the standard layout, or U,V:U,V...
// for views at these positions. The first position must be 0,0, and coordinates must be within +-1.
// Coordinates are rounded to four decimals, as in file names.
Target Views(Positions* positions);

// Parses finite numbers separated by `separator`. Returns an empty list if any part is invalid.
std::vector<double> ReadNumbers(const std::string& text, char separator);

// Formats `value` with %g.
std::string Short(double value);

// Formats `value` with three significant digits, such as 14.2.
std::string ThreeDigits(double value);

// Formats `value` with a fixed number of decimals.
std::string Decimal(double value, int decimals);

// Formats words as "a, b or c".
std::string OneOf(const std::vector<std::string>& words);

template <class T, class Value>
Target Choice(const Words<T>& words, Value* value) {
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

struct ShapeOptions {
  std::string shape = "fall-off";  // name of the shape as typed
  double theta = 0.26, cats_eye = 0;
};

void AddShapeOptions(Command* command, ShapeOptions* options);

// Returns a lens with the shape of the options; other fields have their defaults.
Result<starfocus::Params> ParseShape(const ShapeOptions& options);

// Returns a suffix for file names that identifies the shape, or "" for the default shape.
std::string ShapeSuffix(const ShapeOptions& options);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_COMMAND_LINE_OPTIONS_H_
