// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/stereo_folders.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <system_error>

#include "platform/file.h"
#include "platform/folder.h"
#include "platform/natural_order.h"

namespace starfocus {
namespace {

namespace fs = std::filesystem;

constexpr char kLeft[] = "left", kRight[] = "right";

using Names = std::vector<std::string>;

// Lists the pictures of a folder, without hidden files and the map and coverage of a light field.
Result<Names> ListPictures(const fs::path& folder) {
  constexpr const char* kPictureExtensions[] = {".png",  ".jpg",  ".jpeg", ".ppm",
                                                ".webp", ".heic", ".heif", ".avif"};
  Result<Names> names = ListFolder(folder.string());
  if (!names) return names;
  Names pictures;
  std::copy_if(names->begin(), names->end(), std::back_inserter(pictures),
               [&](const std::string& name) {
                 if (name[0] == '.' || name == "disparity.png" || name == "coverage.png")
                   return false;
                 return std::find(std::begin(kPictureExtensions), std::end(kPictureExtensions),
                                  LowerExtension(name)) != std::end(kPictureExtensions);
               });
  return pictures;
}

// Returns an error if `names` contains a name that `others` lacks. Both lists are sorted.
Error CheckCounterparts(const std::string& folder, const Names& names, const Names& others,
                        const std::string& other) {
  Names alone;
  std::set_difference(names.begin(), names.end(), others.begin(), others.end(),
                      std::back_inserter(alone));
  if (alone.empty()) return {};
  return Expected(folder, "pictures of the same names in left and right",
                  "no " + alone[0] + " in " + other);
}

}  // namespace

Result<std::vector<StereoFiles>> FindStereoFolders(const std::string& folder) {
  const fs::path left = fs::path(folder) / kLeft, right = fs::path(folder) / kRight;
  std::vector<StereoFiles> pairs;
  std::error_code ignored;
  if (!fs::is_directory(left, ignored) || !fs::is_directory(right, ignored)) return pairs;
  const Result<Names> own = ListPictures(folder);
  if (!own) return own.error();
  if (!own->empty()) return pairs;  // A folder of views or photos.
  const Result<Names> first = ListPictures(left), second = ListPictures(right);
  if (!first) return first.error();
  if (!second) return second.error();
  if (first->size() != 1 || second->size() != 1) {
    if (Error error = CheckCounterparts(folder, *first, *second, kRight)) return error;
    if (Error error = CheckCounterparts(folder, *second, *first, kLeft)) return error;
  }
  for (size_t k = 0; k < first->size(); ++k) {
    pairs.push_back({(left / (*first)[k]).string(), (right / (*second)[k]).string()});
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const StereoFiles& a, const StereoFiles& b) { return NaturalLess(a.left, b.left); });
  return pairs;
}

std::string FindRightPicture(const std::string& left) {
  std::error_code failure;
  const fs::path file = fs::absolute(left, failure), folder = file.parent_path();
  if (failure || folder.filename() != kLeft) return "";
  // The path keeps the form that the user typed.
  const fs::path typed = fs::path(left).parent_path();
  const fs::path beside = typed.filename() == kLeft ? typed.parent_path() : folder.parent_path();
  const fs::path right = beside / kRight / file.filename();
  return fs::is_regular_file(right, failure) ? right.string() : "";
}

}  // namespace starfocus
