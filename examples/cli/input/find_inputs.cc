// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/input/find_inputs.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <system_error>

#include "platform/console.h"
#include "platform/file.h"
#include "platform/natural_order.h"
#include "platform/readers/capture.h"
#include "platform/readers/depth_photo_file.h"
#include "platform/readers/pair.h"
#include "platform/readers/stereo_folders.h"

namespace starfocus {
namespace {

namespace fs = std::filesystem;

// Returns the reason why a file is no photo, or an empty string if the file is a photo. Judges a
// file by its name only. `has_depth` states that the file has a depth picture next to it, or that a
// command computes its depth or matte.
std::string ReasonToSkip(const std::string& name, bool has_depth) {
  const std::string extension = LowerExtension(name);
  if (IsDepthPictureName(name)) return "a depth picture that no photo uses";
  if (extension == ".png" || extension == ".webp" || extension == ".ppm") {
    return has_depth ? "" : "a PNG, WebP or PPM picture without a depth picture next to it";
  }
  const bool is_photo = extension == ".jpg" || extension == ".jpeg" || extension == ".mpo" ||
                        extension == ".heic" || extension == ".heif" || extension == ".avif";
  return is_photo ? "" : "a file of another type";
}

std::string Text(const SkippedPath& skipped) { return skipped.path + ": " + skipped.reason; }

// Returns the error for a folder without inputs. A folder with files of a light field is assumed to
// be a damaged light field.
Error NothingFound(const std::string& path, const std::vector<SkippedPath>& skipped) {
  if (!LightFieldFiles(path).empty()) return OpenCapture(path, {}).error();
  return Expected(path, "a light field, or a folder of photos or light fields",
                  skipped.empty() ? "an empty folder" : Text(skipped[0]));
}

// Returns true if the folder is one light field. A row of pictures with numbers in their names is
// not a light field if one of the pictures has depth, or if `has_command` states that a command
// computes the depth or the matte of each picture.
bool IsLightField(const std::string& folder, bool has_command) {
  const Result<Capture> capture = OpenCapture(folder, {});
  if (!capture || capture->row.empty() || !capture->map_path.empty()) return bool(capture);
  const Result<DepthPictures> pictures = ListDepthPictures(folder);
  if (has_command || !pictures) return false;
  return std::none_of(capture->row.begin(), capture->row.end(), [&](const std::string& path) {
    return !pictures->Of(fs::path(path).filename().string()).empty() || StoresDepth(path);
  });
}

}  // namespace

Result<FoundInputs> FindInputs(const std::string& path, bool has_command, const std::string& out) {
  std::error_code ignored;
  const Result<std::vector<StereoFiles>> pairs = FindStereoFolders(path);
  if (!pairs) return pairs.error();
  if (pairs->size() > 1) {
    FoundInputs lefts;
    for (const StereoFiles& pair : *pairs) lefts.paths.push_back(pair.left);
    return lefts;
  }
  if (!fs::is_directory(path, ignored) || IsLightField(path, has_command)) {
    return FoundInputs{{path}, {}};
  }
  const Result<DepthPictures> pictures = ListDepthPictures(path);
  if (!pictures) return pictures.error();
  FoundInputs found;
  std::set<std::string> used;  // depth pictures of the photos that were found
  for (const auto& entry : fs::directory_iterator(path, ignored)) {
    const std::string one = entry.path().string();
    const std::string name = entry.path().filename().string();
    if (name[0] == '.' || fs::equivalent(entry.path(), out, ignored)) continue;
    std::string reason;
    if (entry.is_directory(ignored)) {
      if (!IsLightField(one, has_command)) reason = "a folder that is not a light field";
    } else {
      const std::vector<std::string> depth = pictures->Of(name);
      reason = ReasonToSkip(name, has_command || !depth.empty());
      if (reason.empty() && !depth.empty()) used.insert((fs::path(path) / depth[0]).string());
    }
    if (reason.empty()) {
      found.paths.push_back(one);
    } else {
      found.skipped.push_back({one, reason});
    }
  }
  const auto is_used = [&](const SkippedPath& one) { return used.count(one.path) != 0; };
  found.skipped.erase(std::remove_if(found.skipped.begin(), found.skipped.end(), is_used),
                      found.skipped.end());
  std::sort(found.paths.begin(), found.paths.end(), NaturalLess);
  std::sort(found.skipped.begin(), found.skipped.end(),
            [](const SkippedPath& a, const SkippedPath& b) { return NaturalLess(a.path, b.path); });
  if (found.paths.empty()) return NothingFound(path, found.skipped);
  return found;
}

std::string NameOfInput(const std::string& input) {
  std::error_code ignored;
  fs::path path = fs::absolute(input, ignored).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();  // "folder/"
  return (fs::is_directory(input, ignored) ? path.filename() : path.stem()).string();
}

void TellSkipped(const std::vector<SkippedPath>& skipped) {
  for (const SkippedPath& one : skipped) TellLine("starfocus: skipped " + Text(one));
}

}  // namespace starfocus
