// SPDX-License-Identifier: Apache-2.0
#include "platform/light_field.h"

#include <cstdio>
#include <filesystem>
#include <system_error>

#include "platform/image_io.h"
#include "starfocus/starfocus.h"

namespace starfocus {
namespace {

namespace fs = std::filesystem;

std::string Join(const std::string& folder, const std::string& name) {
  return (fs::path(folder) / name).string();
}

std::string SizeText(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

constexpr char kDisparityName[] = "disparity.pfm";
constexpr const char* kViewExtensions[] = {".png", ".ppm", ".jpg"};

// The file of view `index`, empty when there is none.
std::string FindView(const std::string& folder, int index) {
  for (const char* extension : kViewExtensions) {
    const std::string path = Join(folder, ViewName(index) + extension);
    std::error_code error;
    if (fs::exists(path, error)) return path;
  }
  return "";
}

std::string CheckFolder(const std::string& folder) {
  std::error_code error;
  const fs::file_status status = fs::status(folder, error);
  if (fs::is_directory(status)) return "";
  return Expected(folder, "a light-field folder", fs::exists(status) ? "a file" : "nothing");
}

// First view in [0, end) without a file, or `end`.
int FirstMissing(const std::string& folder, int end) {
  int index = 0;
  while (index < end && !FindView(folder, index).empty()) ++index;
  return index;
}

std::string MissingView(const std::string& folder, int index) {
  return Expected(Join(folder, ViewName(index) + ".png"), "a view (or .ppm, .jpg)", "no file");
}

// The number of views to load: `views`, or all of the largest set.
std::string ChooseViews(const std::string& folder, int views, int* chosen) {
  if (views == 0) return CountViews(folder, chosen);
  if (!IsStarSet(views)) return Expected(folder, "1, 5, 9 or 17 views", std::to_string(views));
  std::string error = CheckFolder(folder);
  if (!error.empty()) return error;
  const int missing = FirstMissing(folder, views);
  if (missing == 0) return MissingView(folder, 0);
  if (missing < views) {
    return Expected(folder, std::to_string(views) + " views",
                    "no " + ViewName(missing) + ".png (or .ppm, .jpg)");
  }
  *chosen = views;
  return "";
}

struct SaveJob {
  const std::string& folder;
  const LightField& light_field;
  std::vector<std::string> errors;  // of each view

  static void Run(void* data, int32_t index, int32_t) {
    SaveJob* self = static_cast<SaveJob*>(data);
    const std::string path = Join(self->folder, ViewName(index) + ".png");
    self->errors[size_t(index)] = WriteImage(path, self->light_field.views[size_t(index)]);
  }
};

}  // namespace

bool IsStarSet(int views) {
  for (int set : kStarSets) {
    if (set == views) return true;
  }
  return false;
}

std::string ViewName(int index) {
  double u = 0, v = 0;
  sf_view_position(index, &u, &v);
  char name[32];
  std::snprintf(name, sizeof(name), "view_%+.1f_%+.1f", u, v);
  return name;
}

std::string DisparityPath(const std::string& folder) { return Join(folder, kDisparityName); }

bool IsLightFieldFile(const std::string& name) {
  for (int index = 0; index < SF_MAX_VIEWS; ++index) {
    for (const char* extension : kViewExtensions) {
      if (name == ViewName(index) + extension) return true;
    }
  }
  return name == kDisparityName;
}

std::vector<std::string> LightFieldFiles(const std::string& folder) {
  std::vector<std::string> files;
  for (int index = 0; index < SF_MAX_VIEWS; ++index) {
    const std::string view = FindView(folder, index);
    if (!view.empty()) files.push_back(view);
  }
  if (HasDisparity(folder)) files.push_back(DisparityPath(folder));
  return files;
}

std::string CountViews(const std::string& folder, int* views) {
  const std::string error = CheckFolder(folder);
  if (!error.empty()) return error;
  const int missing = FirstMissing(folder, SF_MAX_VIEWS);
  if (missing == 0) return MissingView(folder, 0);
  int complete = 0;
  for (int set : kStarSets) {
    if (set <= missing) complete = set;
  }
  for (int index = complete; index < SF_MAX_VIEWS; ++index) {
    if (!FindView(folder, index).empty()) return MissingView(folder, missing);
  }
  *views = complete;
  return "";
}

std::string ReadDisparity(const std::string& folder, FloatMap* map) {
  const std::string path = DisparityPath(folder), error = CheckPlainFile(path);
  return error.empty() ? ReadPfm(path, map) : error;
}

bool HasDisparity(const std::string& folder) {
  std::error_code error;
  return fs::exists(DisparityPath(folder), error);
}

std::string LoadCaptured(const std::string& folder, int views, std::vector<Image>* captured) {
  int chosen = 0;
  std::string error = ChooseViews(folder, views, &chosen);
  if (!error.empty()) return error;
  std::vector<Image> result(static_cast<size_t>(chosen));
  for (int i = 0; i < chosen; ++i) {
    const std::string path = FindView(folder, i);
    Image& view = result[size_t(i)];
    error = CheckPlainFile(path);
    if (error.empty()) error = ReadImage(path, &view);
    if (!error.empty()) return error;
    const Image& centre = result[0];
    if (view.width != centre.width || view.height != centre.height) {
      return Expected(path, SizeText(centre.width, centre.height) + " as the centre view",
                      SizeText(view.width, view.height));
    }
  }
  *captured = std::move(result);
  return "";
}

std::string LoadLightField(const std::string& folder, int views, LightField* light_field) {
  LightField result;
  std::string error = LoadCaptured(folder, views, &result.views);
  if (error.empty()) error = ReadDisparity(folder, &result.disparity);
  if (!error.empty()) return error;
  const Image& centre = result.views[0];
  if (result.width() != centre.width || result.height() != centre.height) {
    return Expected(DisparityPath(folder),
                    SizeText(centre.width, centre.height) + " as the centre view",
                    SizeText(result.width(), result.height()));
  }
  *light_field = std::move(result);
  return "";
}

std::string SaveLightField(const std::string& folder, const LightField& light_field,
                           ThreadRunner* runner) {
  std::error_code failure;
  fs::create_directories(folder, failure);
  if (failure) return Expected(folder, "a folder that can be made", failure.message());
  SaveJob save = {folder, light_field, std::vector<std::string>(light_field.views.size())};
  const int status = ThreadRunner::Run(runner, SaveJob::Run, &save,
                                       static_cast<int32_t>(light_field.views.size()));
  if (status != 0) return Expected(folder, "a thread runner", "none");
  for (const std::string& error : save.errors) {
    if (!error.empty()) return error;
  }
  return WritePfm(DisparityPath(folder), light_field.disparity);
}

}  // namespace starfocus
