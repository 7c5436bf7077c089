// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/counts.h"

#include <algorithm>
#include <sstream>

#include "platform/file.h"
#include "tests/bench/row.h"

namespace starfocus::bench {
namespace {

Counts& Find(const std::string& name, std::vector<Counts>* counts) {
  const auto found = std::find_if(counts->begin(), counts->end(),
                                  [&](const Counts& each) { return each.name == name; });
  if (found != counts->end()) return *found;
  counts->push_back({name, kNone, kNone, kNone, kNone});
  return counts->back();
}

// `per_pixel` makes the value of a line from what follows "CASE KERNELS"; false: not such a line.
template <class PerPixel>
Error ReadFileOf(const std::string& path, double Counts::*simd, double Counts::*plain,
                 PerPixel per_pixel, std::vector<Counts>* counts) {
  if (path.empty()) return {};
  const Result<Bytes> bytes = ReadFile(path);
  if (!bytes) return bytes.error();
  std::istringstream text(std::string(bytes->begin(), bytes->end()));
  for (std::string line; std::getline(text, line);) {
    std::istringstream words(line);
    std::string name, kernels;
    double value = 0;
    words >> name >> kernels;
    if ((kernels != "simd" && kernels != "reference") || !per_pixel(&words, &value)) continue;
    Find(name, counts).*(kernels == "simd" ? simd : plain) = value;
  }
  return {};
}

}  // namespace

Error ReadCounts(const std::string& x86, const std::string& arm, std::vector<Counts>* counts) {
  const Error error = ReadFileOf(
      x86, &Counts::x86_simd, &Counts::x86_plain,
      [](std::istream* words, double* value) { return bool(*words >> *value); }, counts);
  if (error) return error;
  return ReadFileOf(
      arm, &Counts::arm_simd, &Counts::arm_plain,
      [](std::istream* words, double* value) {
        double pixels = 0, instructions = 0;
        if (!(*words >> pixels >> instructions) || !(pixels > 0)) return false;
        *value = instructions / pixels;
        return true;
      },
      counts);
}

}  // namespace starfocus::bench
