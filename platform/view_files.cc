// SPDX-License-Identifier: Apache-2.0
#include "platform/view_files.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <optional>
#include <system_error>

#include "platform/file.h"
#include "platform/folder.h"
#include "platform/text.h"

namespace starfocus {
namespace {

namespace fs = std::filesystem;

constexpr int kStarSets[] = {1, 5, 9, 17};
constexpr const char* kExtensions[] = {".png", ".ppm", ".jpg", ".exr"};
constexpr const char* kPair[] = {"im0.png", "im1.png"};  // Views at (0, 0) and (1, 0).
constexpr double kDecimals = 1e4;                        // Names have up to four decimals.
constexpr double kAlike = 0.5 / kDecimals;

// Formats a coordinate, for example "+0.5". Whole numbers are formatted with one decimal.
std::string CoordinateText(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%+.4f", std::fabs(value) < kAlike ? 0 : value);
  std::string name = text;
  while (name.back() == '0' && name[name.size() - 2] != '.') name.pop_back();
  return name;
}

// Parses the characters [at, end) of a text as a sign, digits and decimals.
std::optional<double> ReadCoordinate(const std::string& text, size_t at, size_t end) {
  if (end > text.size() || at + 2 > end || (text[at] != '+' && text[at] != '-')) return {};
  const std::string number = text.substr(at, end - at);
  if (number.find_first_not_of("0123456789.", 1) != std::string::npos) return {};
  return ParseNumber(number);
}

// Parts of a view's file name.
struct NameParts {
  starfocus_position position;
  size_t extension;  // Index into kExtensions.
};

// Parses the file name of a view. Returns nullopt if `name` is not the file name of a view.
std::optional<NameParts> ReadName(const std::string& name) {
  constexpr char kPrefix[] = "view_";
  constexpr size_t kBegin = sizeof(kPrefix) - 1, kExtension = 4;
  if (name.size() < kBegin + kExtension || name.compare(0, kBegin, kPrefix) != 0) return {};
  const size_t end = name.size() - kExtension, middle = name.find('_', kBegin);
  const auto* extension =
      std::find(std::begin(kExtensions), std::end(kExtensions), name.substr(end));
  if (extension == std::end(kExtensions) || middle >= end) return {};
  const auto u = ReadCoordinate(name, kBegin, middle), v = ReadCoordinate(name, middle + 1, end);
  if (!u || !v) return {};
  return NameParts{RoundedPosition(*u, *v), static_cast<size_t>(extension - kExtensions)};
}

Error CheckFolder(const std::string& folder) {
  std::error_code error;
  const fs::file_status status = fs::status(folder, error);
  if (fs::is_directory(status)) return {};
  return Expected(folder, "a light-field folder", fs::exists(status) ? "a file" : "nothing");
}

// Returns the index of a position in the list of starfocus_view_position, or the size of the list
// if the list does not contain the position.
size_t StarIndex(const starfocus_position& position) {
  const Positions star = StarPositions(STARFOCUS_MAX_VIEWS);
  size_t index = 0;
  while (index < star.size() && !SamePosition(star[index], position)) ++index;
  return index;
}

bool ComesBefore(const ViewFile& a, const ViewFile& b) {
  const size_t first = StarIndex(a.position), second = StarIndex(b.position);
  if (first != second) return first < second;
  if (a.position.u != b.position.u) return a.position.u < b.position.u;
  return a.position.v < b.position.v;
}

// Returns the files of views in a folder. If a folder has several files of one view, ListNames
// returns the file whose extension is first in kExtensions.
Result<std::vector<ViewFile>> ListNames(const std::string& folder) {
  const Result<std::vector<std::string>> names = ListFolder(folder);
  if (!names) return names.error();
  std::vector<ViewFile> files;
  for (const std::string& name : *names) {
    const std::optional<NameParts> parts = ReadName(name);
    if (!parts) continue;
    const std::string stem = name.substr(0, name.size() - 4);
    const auto has = [&](size_t other) {
      return std::binary_search(names->begin(), names->end(), stem + kExtensions[other]);
    };
    bool first = true;
    for (size_t other = 0; other < parts->extension; ++other) first = first && !has(other);
    if (first) files.push_back({parts->position, (fs::path(folder) / name).string()});
  }
  return files;
}

// Returns the two views of a stereo pair, for folders without files that have the names of views.
std::vector<ViewFile> ListPair(const std::string& folder) {
  std::vector<ViewFile> files;
  for (size_t k = 0; k < std::size(kPair); ++k) {
    const std::string path = (fs::path(folder) / kPair[k]).string();
    std::error_code error;
    if (!fs::exists(path, error)) return {};
    files.push_back({{static_cast<double>(k), 0}, path});
  }
  return files;
}

}  // namespace

bool IsStarSet(int views) {
  return std::find(std::begin(kStarSets), std::end(kStarSets), views) != std::end(kStarSets);
}

Positions StarPositions(int views) {
  Positions positions(static_cast<size_t>(views));
  for (int index = 0; index < views; ++index) {
    starfocus_position& position = positions[static_cast<size_t>(index)];
    starfocus_view_position(index, &position.u, &position.v, nullptr);
  }
  return positions;
}

bool AreStar(const Positions& positions) {
  const auto views = static_cast<int>(positions.size());
  if (!IsStarSet(views)) return false;
  const Positions star = StarPositions(views);
  return std::equal(star.begin(), star.end(), positions.begin(), SamePosition);
}

starfocus_position RoundedPosition(double u, double v) {
  return {std::round(u * kDecimals) / kDecimals, std::round(v * kDecimals) / kDecimals};
}

bool SamePosition(const starfocus_position& a, const starfocus_position& b) {
  return std::fabs(a.u - b.u) < kAlike && std::fabs(a.v - b.v) < kAlike;
}

std::string ViewName(const starfocus_position& position) {
  return "view_" + CoordinateText(position.u) + "_" + CoordinateText(position.v);
}

bool IsViewFile(const std::string& name) {
  return ReadName(name) || name == kPair[0] || name == kPair[1];
}

Result<std::vector<ViewFile>> FindViewFiles(const std::string& folder) {
  if (Error error = CheckFolder(folder)) return error;
  const Result<std::vector<ViewFile>> named = ListNames(folder);
  if (!named) return named.error();
  std::vector<ViewFile> found = named->empty() ? ListPair(folder) : *named;
  for (const ViewFile& file : found) {
    if (std::fabs(file.position.u) > 1 || std::fabs(file.position.v) > 1) {
      return Expected(file.path, "a view with u and v from -1 to 1", "a position outside");
    }
  }
  std::sort(found.begin(), found.end(), ComesBefore);
  for (size_t k = 1; k < found.size(); ++k) {
    if (SamePosition(found[k].position, found[k - 1].position)) {
      return Expected(found[k].path, "a different position for each view",
                      "the position of " + found[k - 1].path);
    }
  }
  if (found.empty() || !SamePosition(found[0].position, {0, 0})) {
    const std::string centre = (fs::path(folder) / (ViewName({0, 0}) + ".png")).string();
    return Expected(centre, "the centre view (.png, .ppm or .jpg)", "no file");
  }
  if (found.size() > STARFOCUS_MAX_VIEWS) {
    return Expected(folder, "at most " + std::to_string(STARFOCUS_MAX_VIEWS) + " views",
                    std::to_string(found.size()));
  }
  found[0].position = {0, 0};
  return found;
}

Result<std::vector<ViewFile>> SelectViewFiles(const std::string& where,
                                              const std::vector<ViewFile>& files,
                                              const Positions& wanted) {
  if (wanted.empty()) return files;
  std::vector<ViewFile> chosen;
  for (const starfocus_position& position : wanted) {
    const auto at = std::find_if(files.begin(), files.end(), [&](const ViewFile& file) {
      return SamePosition(file.position, position);
    });
    if (at == files.end()) {
      return Expected(where, std::to_string(wanted.size()) + " views",
                      "no " + ViewName(position) + ".png (or .ppm, .jpg)");
    }
    chosen.push_back(*at);
  }
  return chosen;
}

Result<std::vector<ViewFile>> ChooseViewFiles(const std::string& folder, const Positions& wanted) {
  const Result<std::vector<ViewFile>> files = FindViewFiles(folder);
  return files ? SelectViewFiles(folder, *files, wanted) : files;
}

}  // namespace starfocus
