// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/capture.h"

#include <algorithm>
#include <filesystem>
#include <new>
#include <system_error>

#include "platform/folder.h"
#include "platform/readers/depth_photo_file.h"
#include "platform/readers/hci.h"
#include "platform/readers/middlebury.h"
#include "platform/readers/photo_scale.h"
#include "platform/readers/stanford.h"
#include "platform/readers/view_array.h"

namespace starfocus {
namespace {

namespace fs = std::filesystem;

constexpr double kPhotoFStop = 1.8;

using Names = std::vector<std::string>;

bool Has(const Names& names, const std::string& name) {
  return std::binary_search(names.begin(), names.end(), name);
}

Names PicturesOf(const Names& names) {
  Names pictures;
  for (const std::string& name : names) {
    const std::string extension = LowerExtension(name);
    if (extension == ".png" || extension == ".jpg" || extension == ".jpeg" || extension == ".ppm") {
      pictures.push_back(name);
    }
  }
  return pictures;
}

std::string OpenOwn(const std::string& folder, const Names& names, Capture* capture) {
  capture->format = "light-field folder";
  std::string error = FindViewFiles(folder, &capture->files);
  if (error.empty() && HasDisparity(folder)) capture->map_path = DisparityPath(folder);
  const bool pair = Has(names, "im0.png") && Has(names, "calib.txt");
  return error.empty() && pair ? ReadMiddlebury(folder, capture) : error;
}

std::string OpenArray(const std::string& folder, const Names& pictures, Capture* capture) {
  ViewArray array;
  std::string error = FindArray(folder, pictures, &array);
  if (!error.empty()) return error;
  if (array.paths.empty()) {
    return Expected(
        folder,
        "views named as view_+0.0_+0.0.png, input_Cam000.png, out_00_00.png, im0.png or "
        "with a row and a column each",
        std::to_string(pictures.size()) + " pictures, the first " + pictures[0]);
  }
  const bool stanford = IsStanford(pictures[0]) && array.rows > 1;
  capture->format = stanford ? "Stanford light field" : "rows and columns of views";
  if (stanford) OrderStanford(&array);
  Star star;
  error = ChooseStar(folder, array, &star, &capture->facts);
  capture->files = std::move(star.views);
  if (HasDisparity(folder)) capture->map_path = DisparityPath(folder);
  return error;
}

std::string OpenFolder(const std::string& folder, Capture* capture) {
  Names names;
  const std::string error = ListFolder(folder, &names);
  if (!error.empty()) return error;
  const Names pictures = PicturesOf(names);
  if (pictures.empty() || std::any_of(names.begin(), names.end(), IsViewFile)) {
    return OpenOwn(folder, names, capture);
  }
  return IsHci(names) ? OpenHci(folder, names, capture) : OpenArray(folder, pictures, capture);
}

std::string OpenPhoto(const std::string& path, const CaptureOptions& options, Capture* capture) {
  DepthPhoto photo;
  std::string depth = options.depth;
  std::string error = ReadDepthPhotoFile(path, &depth, options.near, &photo);
  if (error.empty()) error = MakeLightField(path, &photo, &capture->light_field);
  if (!error.empty()) return error;
  const LightField& light_field = capture->light_field;
  capture->format = photo.format;
  capture->photo = true;
  capture->files = {{{0, 0}, path}};
  capture->map_path = depth.empty() ? path : depth;
  capture->care = MapCare::kRepair;
  capture->widest = 1;
  capture->f_stop = kPhotoFStop;
  capture->has_focus = photo.has_focus;
  capture->focus_x =
      std::min(static_cast<int>(photo.focus_x * light_field.width()), light_field.width() - 1);
  capture->focus_y =
      std::min(static_cast<int>(photo.focus_y * light_field.height()), light_field.height() - 1);
  capture->focus = photo.focus_value;
  capture->metadata = std::move(photo.metadata);
  capture->facts = std::move(photo.facts);
  capture->notes = std::move(photo.notes);
  return "";
}

}  // namespace

std::string OpenCapture(const std::string& path, const CaptureOptions& options, Capture* capture) {
  try {
    Capture result;
    result.path = path;
    std::error_code ignored;
    const fs::file_status status = fs::status(path, ignored);
    std::string error = CheckPlainFile(path);
    if (!error.empty()) return error;
    if (!fs::exists(status)) {
      return Expected(path, "a light-field folder or a depth photo", "nothing");
    }
    error =
        fs::is_directory(status) ? OpenFolder(path, &result) : OpenPhoto(path, options, &result);
    if (error.empty()) *capture = std::move(result);
    return error;
  } catch (const std::bad_alloc&) {
    return OutOfMemory(path, "read it");
  }
}

std::string LoadCapture(const Positions& wanted, Capture* capture, ThreadRunner* runner) {
  std::vector<ViewFile> chosen;
  std::string error = SelectViewFiles(capture->path, capture->files, wanted, &chosen);
  if (!error.empty() || capture->photo) return error;
  error = LoadViewFiles(chosen, &capture->light_field, runner);
  if (!error.empty() || capture->map_path.empty()) return error;
  error = LoadMap(capture->map_path, &capture->light_field);
  if (capture->map_scale == 1) return error;
  for (float& value : capture->light_field.disparity.values) {
    value *= static_cast<float>(capture->map_scale);
  }
  return error;
}

std::vector<std::string> CaptureFiles(const Capture& capture) {
  std::vector<std::string> files;
  for (const ViewFile& file : capture.files) files.push_back(file.path);
  if (!capture.map_path.empty()) files.push_back(capture.map_path);
  return files;
}

}  // namespace starfocus
