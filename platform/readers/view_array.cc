// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/view_array.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "starfocus/starfocus.h"

namespace starfocus {
namespace {

constexpr size_t kMostViews = 4096, kMostDigits = 6;

// A file name, split into numbers and the text between the numbers.
struct Parts {
  std::string between;  // text with a zero byte in place of each number
  std::vector<int> numbers;
};

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

// Splits a name. Each run of digits is a number.
Parts Split(const std::string& stem) {
  Parts parts;
  for (size_t at = 0; at < stem.size();) {
    if (!IsDigit(stem[at])) {
      parts.between += stem[at++];
      continue;
    }
    const size_t begin = at;
    while (at < stem.size() && IsDigit(stem[at])) ++at;
    const bool fits = at - begin <= kMostDigits;
    parts.numbers.push_back(fits ? std::stoi(stem.substr(begin, at - begin)) : -1);
    parts.between += '\0';
  }
  return parts;
}

// Returns the indices of the numbers that differ between the file names.
std::vector<size_t> FindVarying(const std::vector<Parts>& names) {
  std::vector<size_t> varying;
  for (size_t k = 0; k < names[0].numbers.size(); ++k) {
    const auto differs = [&](const Parts& parts) {
      return k < parts.numbers.size() && parts.numbers[k] != names[0].numbers[k];
    };
    if (std::any_of(names.begin(), names.end(), differs)) varying.push_back(k);
  }
  return varying;
}

std::string Count(int rows, int columns) {
  return std::to_string(rows) + " rows of " + std::to_string(columns);
}

// Returns the number of views on each side of the centre view in a row of `count` views. If `count`
// is even, the last view is ignored.
int HalfOf(int count) { return (count - 1) / 2; }

// Returns the distance from the centre view to the outermost chosen views, counted in views. If
// `half` is odd and larger than 4, the distance is half - 1, which is even.
int ReachOf(int half) { return half % 2 == 1 && half > 4 ? half - 1 : half; }

struct Chooser {
  const ViewArray& array;
  int row, column;  // row and column of the centre view
  Star* star;

  void Add(int down, int across) const {
    const size_t index = size_t(row + down) * size_t(array.columns) + size_t(column + across);
    const double reach = star->reach;
    star->views.push_back({{across / reach, down / reach}, array.paths[index]});
  }
};

void ChooseSquare(const Chooser& chooser) {
  const Star& star = *chooser.star;
  const int views = star.reach % 2 == 0 ? 17 : 9;
  for (const starfocus_position& at : StarPositions(views)) {
    chooser.Add(static_cast<int>(at.v * star.reach), static_cast<int>(at.u * star.reach));
  }
}

// Chooses views of a single row or column: all views, or every second or third view, and so on.
void ChooseLine(const Chooser& chooser, bool is_row) {
  const int reach = chooser.star->reach, step = (2 * reach) / (STARFOCUS_MAX_VIEWS - 1) + 1;
  for (int k = 0; k <= reach; k += step) {
    for (const int at : {k, -k}) {
      if (k != 0 || at == 0) is_row ? chooser.Add(0, at) : chooser.Add(at, 0);
      if (k == 0) break;
    }
  }
}

}  // namespace

Result<Star> ChooseStar(const std::string& where, const ViewArray& array, Facts* facts) {
  Star star;
  const int half_rows = HalfOf(array.rows), half_columns = HalfOf(array.columns);
  const Chooser chooser = {array, half_rows, half_columns, &star};
  star.reach = std::min(half_rows, half_columns);
  if (star.reach > 0) {
    star.reach = ReachOf(star.reach);
    ChooseSquare(chooser);
  } else {
    star.reach = std::max(half_rows, half_columns);
    if (star.reach == 0 || (array.rows > 1 && array.columns > 1)) {
      return Expected(
          where, "at least 3 rows and 3 columns of views, or one row or column of at least 3 views",
          Count(array.rows, array.columns));
    }
    ChooseLine(chooser, array.rows == 1);
  }
  facts->emplace_back("views", std::to_string(star.views.size()) + " of " +
                                   Count(array.rows, array.columns) + ", the outermost " +
                                   std::to_string(star.reach) + " from the centre");
  return star;
}

Result<ViewArray> FindArray(const std::string& folder, const std::vector<std::string>& names) {
  std::vector<Parts> parts;
  for (const std::string& name : names) {
    parts.push_back(Split(std::filesystem::path(name).stem().string()));
  }
  if (names.size() < 3 || names.size() > kMostViews) return ViewArray();
  const std::vector<size_t> varying = FindVarying(parts);
  if (varying.empty()) return ViewArray();
  std::map<std::pair<int, int>, std::string> places;
  std::set<int> rows, columns;
  for (size_t k = 0; k < names.size(); ++k) {
    if (parts[k].numbers.size() != parts[0].numbers.size()) return ViewArray();
    const int first = parts[k].numbers[varying[0]];
    const int second = varying.size() > 1 ? parts[k].numbers[varying[1]] : -1;
    const std::pair<int, int> at =
        varying.size() > 1 ? std::pair(first, second) : std::pair(0, first);
    if (!places.emplace(at, names[k]).second) return ViewArray();
    rows.insert(at.first);
    columns.insert(at.second);
  }
  if (rows.size() * columns.size() != names.size()) {
    return Expected(folder,
                    "a picture for each place in " +
                        Count(static_cast<int>(rows.size()), static_cast<int>(columns.size())),
                    std::to_string(names.size()) + " pictures, the first " + names[0]);
  }
  ViewArray array = {static_cast<int>(rows.size()), static_cast<int>(columns.size()), {}};
  for (const auto& place : places) {
    array.paths.push_back((std::filesystem::path(folder) / place.second).string());
  }
  return array;
}

}  // namespace starfocus
