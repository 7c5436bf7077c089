// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/capture.h"

#include <algorithm>
#include <filesystem>
#include <new>
#include <system_error>
#include <utility>

#include "platform/folder.h"
#include "platform/readers/depth_photo_file.h"
#include "platform/readers/hci.h"
#include "platform/readers/middlebury.h"
#include "platform/readers/photo_scale.h"
#include "platform/readers/sample_bits.h"
#include "platform/readers/stanford.h"
#include "platform/readers/stereo_folders.h"
#include "platform/readers/stereo_pair.h"
#include "platform/readers/view_array.h"
#include "platform/standard_stream.h"

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

Result<Capture> OpenOwn(const std::string& folder, const Names& names) {
  Capture capture;
  capture.format = "light-field folder";
  if (Error error = FindViewFiles(folder).MoveTo(&capture.files)) return error;
  if (HasDisparity(folder)) capture.map_path = DisparityPath(folder);
  capture.coverage_path = CoveragePath(folder);
  // In disparity maps of stereo pairs, infinite values mean unknown disparities.
  if (Has(names, "im0.png")) capture.care = MapCare::kFill;
  if (!Has(names, "im0.png") || !Has(names, "calib.txt")) return capture;
  if (Error error = ReadMiddlebury(folder, &capture)) return error;
  return capture;
}

Result<Capture> OpenArray(const std::string& folder, const Names& pictures) {
  Result<ViewArray> found = FindArray(folder, pictures);
  if (!found) return found.error();
  ViewArray& array = *found;
  if (array.paths.empty()) {
    return Expected(
        folder,
        "views with names like view_+0.0_+0.0.png, input_Cam000.png, out_00_00.png or im0.png, "
        "or with a row and a column in each name",
        pictures.size() == 1
            ? "only the picture " + pictures[0]
            : std::to_string(pictures.size()) + " pictures, the first " + pictures[0]);
  }
  const bool stanford = IsStanford(pictures[0]) && array.rows > 1;
  Capture capture;
  capture.format = stanford ? "Stanford light field" : "rows and columns of views";
  if (stanford) OrderStanford(&array);
  Result<Star> star = ChooseStar(folder, array, &capture.facts);
  if (!star) return star.error();
  capture.files = std::move(star->views);
  if (array.rows == 1 || array.columns == 1) capture.row = std::move(array.paths);
  if (HasDisparity(folder)) capture.map_path = DisparityPath(folder);
  return capture;
}

Result<Capture> OpenLayout(const std::string& folder) {
  const Result<Names> names = ListFolder(folder);
  if (!names) return names.error();
  if (std::optional<Capture> pair = FindGreyMapPair(folder, *names)) return std::move(*pair);
  const Names pictures = PicturesOf(*names);
  if (pictures.empty() || std::any_of(names->begin(), names->end(), IsViewFile)) {
    return OpenOwn(folder, *names);
  }
  return IsHci(*names) ? OpenHci(folder, *names) : OpenArray(folder, pictures);
}

Result<Capture> OpenFolder(const std::string& folder) {
  Result<Capture> capture = OpenLayout(folder);
  if (!capture) return capture;
  const auto none = [](const Bytes&) { return false; };  // reads only the beginning of the file
  const Result<Bytes> beginning = ReadFileIf(capture->files[0].path, none);
  if (beginning) NoteSampleBits(SampleBitsOf(*beginning), &capture->lost);
  return capture;
}

// Moves the two views of a stereo pair from `photo` to `capture`. A stereo pair has no map.
// `right` is the path of the right picture, which may be equal to `path`.
void TakePair(const std::string& path, const std::string& right, DepthPhoto* photo,
              Capture* capture) {
  capture->files = {{{0, 0}, path}, {{1, 0}, right}};
  capture->light_field.positions = {{0, 0}, {1, 0}};
  capture->light_field.views.push_back(std::move(photo->picture));
  capture->light_field.views.push_back(std::move(photo->right));
  capture->light_field.is_linear = photo->is_linear;
}

// Converts a fraction of the width or height, in [0, 1], to a pixel coordinate.
int PixelAt(double share, int pixels) {
  return std::min(static_cast<int>(share * pixels), pixels - 1);
}

// Fills a capture with what all photos have, one view or a pair.
void MoveDescription(DepthPhoto* photo, Capture* capture) {
  capture->format = photo->format;
  capture->metadata = std::move(photo->metadata);
  capture->facts = std::move(photo->facts);
  capture->notes = std::move(photo->notes);
  capture->lost = std::move(photo->lost);
  if (!photo->is_blurred) return;
  capture->facts.emplace_back("portrait", "the camera has blurred the background");
  capture->notes.push_back(
      "the camera has already blurred the background of this portrait, so refocusing blurs the "
      "background again (an export without the portrait effect prevents this)");
}

Result<Capture> OpenPhoto(const std::string& path, const CaptureOptions& options) {
  const bool two_files = !options.right.empty();
  Result<DepthPhoto> read =
      two_files ? ReadPictureFiles(path, options.right)
                : ReadDepthPhotoFile(path, options.map, {options.depth, options.matte});
  if (!read) return read.error();
  if (read->right.pixels.empty()) return TakePhoto(path, options, std::move(*read));
  Capture capture;
  if (Error error = AlignPair(InputName(path), &*read)) return error;
  MoveDescription(&*read, &capture);
  TakePair(path, read->right_path.empty() ? path : read->right_path, &*read, &capture);
  return capture;
}

// Opens a folder of views, or a folder with the folders `left` and `right` of one stereo pair.
Result<Capture> OpenDirectory(const std::string& path, const CaptureOptions& options) {
  const Result<std::vector<StereoFiles>> pairs = FindStereoFolders(path);
  if (!pairs) return pairs.error();
  if (pairs->empty()) return OpenFolder(path);
  const StereoFiles& first = pairs->front();
  if (pairs->size() > 1) {
    return Expected(path, "one stereo pair in left and right",
                    std::to_string(pairs->size()) + " (" + first.left + " opens the first)");
  }
  CaptureOptions two_files = options;
  two_files.right = first.right;
  return OpenPhoto(first.left, two_files);
}

// Keeps only the chosen views of a light field.
void SelectViews(const std::vector<ViewFile>& chosen, LightField* light_field) {
  LightField result;
  result.is_linear = light_field->is_linear;
  for (const ViewFile& file : chosen) {
    for (size_t k = 0; k < light_field->views.size(); ++k) {
      if (!SamePosition(light_field->positions[k], file.position)) continue;
      result.positions.push_back(file.position);
      result.views.push_back(light_field->views[k]);
    }
  }
  *light_field = std::move(result);
}

// Loads the map of a capture whose views are already loaded.
Error LoadMapOf(Capture* capture) {
  if (LowerExtension(capture->map_path) != ".pfm") return LoadGreyMap(capture);
  Error error = LoadMap(capture->map_path, &capture->light_field);
  if (capture->map_scale == 1) return error;
  for (float& value : capture->light_field.disparity.values) {
    value *= static_cast<float>(capture->map_scale);
  }
  return error;
}

Error LoadViews(const Positions& wanted, Capture* capture, ThreadRunner* runner) {
  const Result<std::vector<ViewFile>> chosen =
      SelectViewFiles(capture->path, capture->files, wanted);
  if (!chosen) return chosen.error();
  if (capture->photo) {
    FitMap(&capture->light_field, runner);
    return {};
  }
  if (!capture->light_field.views.empty()) {
    SelectViews(*chosen, &capture->light_field);
    return {};
  }
  if (Error error = LoadViewFiles(*chosen, runner).MoveTo(&capture->light_field)) return error;
  return capture->map_path.empty() ? Error() : LoadMapOf(capture);
}

}  // namespace

Result<Capture> OpenCapture(const std::string& path, const CaptureOptions& options) {
  try {
    bool folder = false;
    if (path != "-") {
      std::error_code failure;
      const fs::file_status status = fs::status(path, failure);
      if (Error error = CheckPlainFile(path)) return error;
      if (!fs::exists(status)) return Cannot("read", path, failure);
      folder = fs::is_directory(status);
    }
    Result<Capture> capture = folder ? OpenDirectory(path, options) : OpenPhoto(path, options);
    if (capture) capture->path = InputName(path);
    return capture;
  } catch (const std::bad_alloc&) {
    return OutOfMemory(path, "read it");
  }
}

Result<Capture> TakePhoto(const std::string& path, const CaptureOptions& options,
                          DepthPhoto photo) {
  Capture capture;
  LightField& light_field = capture.light_field;
  Error error = MakePhotoField(InputName(path), &photo, options.map).MoveTo(&light_field);
  if (error) return error;
  if (!photo.matte.values.empty()) {
    capture.matte = Matte(photo.matte);
    photo.facts.emplace_back("matte", Description(capture.matte));
  }
  MoveDescription(&photo, &capture);
  if (photo.deep) {
    light_field.deep.push_back(std::move(*photo.deep));
    light_field.deep_colours = std::move(photo.deep_colours);
  }
  capture.gain_map = std::move(photo.gain_map);
  if (!options.small_map) FitMap(&light_field);
  const Image& picture = light_field.views[0];
  capture.photo = true;
  capture.survey = std::move(photo.survey);
  capture.files = {{{0, 0}, path}};
  const bool two_surfaces = !light_field.coverage.empty();
  if (two_surfaces) capture.subject = AssumedSubject(picture);
  const std::string& map_path = two_surfaces ? photo.matte_path : photo.depth_path;
  capture.map_path = map_path.empty() ? path : map_path;
  capture.care = photo.is_ready || two_surfaces ? MapCare::kNone : MapCare::kRepair;
  capture.widest = 1;
  capture.f_stop = kPhotoFStop;
  capture.has_focus = photo.has_focus;
  capture.focus_x = PixelAt(photo.focus_x, picture.width);
  capture.focus_y = PixelAt(photo.focus_y, picture.height);
  capture.has_subject = photo.has_subject;
  capture.subject_x = PixelAt(photo.subject_x, picture.width);
  capture.subject_y = PixelAt(photo.subject_y, picture.height);
  capture.focus = photo.focus_value;
  return capture;
}

Error LoadCapture(const Positions& wanted, Capture* capture, ThreadRunner* runner) {
  Error error = LoadViews(wanted, capture, runner);
  if (!error && !capture->coverage_path.empty()) {
    error = LoadCoverage(capture->coverage_path, &capture->light_field);
  }
  return error;
}

std::vector<std::string> CaptureFiles(const Capture& capture) {
  std::vector<std::string> files;
  for (const ViewFile& file : capture.files) files.push_back(file.path);
  for (const std::string& path : {capture.map_path, capture.coverage_path}) {
    if (!path.empty()) files.push_back(path);
  }
  return files;
}

}  // namespace starfocus
