// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/pair.h"

#include <filesystem>
#include <system_error>

#include "platform/image_io.h"
#include "platform/readers/depth_levels.h"
#include "platform/readers/orientation.h"

namespace starfocus {
namespace {

namespace fs = std::filesystem;

std::string ReadLevels(const std::string& path, FloatMap* map) {
  Bytes bytes;
  const std::string error = ReadFile(path, &bytes);
  return error.empty() ? DecodeLevels(path, &bytes, map) : error;
}

bool Lies(int width, int height) { return width > height; }

// A depth picture is turned with its photo, unless it stands already as the photo will.
void TurnPictureFirst(DepthPhoto* photo) {
  const bool turns = photo->orientation >= 5;
  if (!turns || Lies(photo->map.width, photo->map.height) ==
                    Lies(photo->picture.width, photo->picture.height)) {
    return;
  }
  FloatMap map;
  std::swap(map, photo->map);
  ApplyOrientation(photo);
  std::swap(map, photo->map);
}

}  // namespace

std::string FindDepthPicture(const std::string& photo) {
  const fs::path path(photo);
  const std::string stem = path.stem().string(), ending = "-image";
  std::string name = stem;
  if (stem.size() > ending.size() &&
      stem.compare(stem.size() - ending.size(), ending.size(), ending) == 0) {
    name.erase(stem.size() - ending.size());
  }
  for (const char* extension : {".png", ".jpg", ".jpeg"}) {
    const fs::path depth = path.parent_path() / (name + "-depth" + extension);
    std::error_code error;
    if (depth != path && fs::is_regular_file(depth, error)) return depth.string();
  }
  return "";
}

std::string ReadDepthPicture(const std::string& path, Near near, DepthPhoto* photo) {
  photo->format = "photo and depth picture";
  photo->facts.emplace_back("depth picture", path);
  std::string error = CheckPlainFile(path);
  if (!error.empty()) return error;
  if (LowerExtension(path) == ".pfm") {
    error = ReadPfm(path, &photo->map);
    near = Near::kWhite;
  } else {
    error = ReadLevels(path, &photo->map);
  }
  if (!error.empty()) return error;
  TurnPictureFirst(photo);
  TellMap("in an order, without distances", photo);
  ToOrder(near, photo);
  return "";
}

}  // namespace starfocus
