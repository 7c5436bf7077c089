// SPDX-License-Identifier: Apache-2.0
#include "platform/light_field.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <system_error>

#include "platform/folder.h"
#include "platform/image_io.h"
#include "platform/levels.h"
#include "platform/progress.h"
#include "platform/writers/png.h"
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
constexpr char kCoverageName[] = "coverage.png";
// Maps of stereo pairs: Middlebury's and ETH3D's.
constexpr const char* kPairDisparityNames[] = {"disp0.pfm", "disp0GT.pfm"};

struct SaveJob {
  const std::string& folder;
  const LightField& light_field;
  const Positions positions;
  std::vector<Error> errors;  // of each view
  Progress progress;

  static void Run(void* data, int32_t index, int32_t) {
    SaveJob* self = static_cast<SaveJob*>(data);
    const std::string path = Join(self->folder, ViewName(self->positions[size_t(index)]) + ".png");
    self->errors[size_t(index)] = WriteImage(path, self->light_field.views[size_t(index)]);
    self->progress.Step();
  }
};

struct LoadJob {
  const std::vector<ViewFile>& files;
  std::vector<Image>* views;
  std::vector<Error> errors;  // of each view
  Progress progress;

  static void Run(void* data, int32_t index, int32_t) {
    LoadJob* self = static_cast<LoadJob*>(data);
    const std::string& path = self->files[size_t(index)].path;
    Error* error = &self->errors[size_t(index)];
    *error = CheckPlainFile(path);
    if (!*error) *error = ReadImage(path, &(*self->views)[size_t(index)]);
    self->progress.Step();
  }
};

Error SaveCoverage(const std::string& folder, const LightField& light_field) {
  GreyImage image;
  image.width = light_field.views[0].width;
  image.height = light_field.views[0].height;
  image.levels.assign(light_field.coverage.begin(), light_field.coverage.end());
  const std::string path = Join(folder, kCoverageName);
  Bytes png;
  if (Error error = EncodeGreyPng(path, image, &png)) return error;
  return WriteFile(path, png);
}

}  // namespace

void ConfigureViews(const LightField& light_field, sf_config* config) {
  config->views = static_cast<int32_t>(light_field.views.size());
  std::copy(light_field.positions.begin(), light_field.positions.end(), config->positions);
}

std::string DisparityPath(const std::string& folder) {
  const std::string path = Join(folder, kDisparityName);
  std::error_code error;
  if (fs::exists(path, error)) return path;
  for (const char* name : kPairDisparityNames) {
    if (fs::exists(Join(folder, name), error)) return Join(folder, name);
  }
  return path;
}

bool IsLightFieldFile(const std::string& name) {
  return IsViewFile(name) || name == kDisparityName || name == kCoverageName ||
         std::find(std::begin(kPairDisparityNames), std::end(kPairDisparityNames), name) !=
             std::end(kPairDisparityNames);
}

std::vector<std::string> LightFieldFiles(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (IsLightFieldFile(entry.path().filename().string())) files.push_back(entry.path().string());
  }
  return files;
}

Error ReadDisparity(const std::string& folder, FloatMap* map) {
  const std::string path = DisparityPath(folder);
  if (Error error = CheckPlainFile(path)) return error;
  return ReadPfm(path, map);
}

bool HasDisparity(const std::string& folder) {
  std::error_code error;
  return fs::exists(DisparityPath(folder), error);
}

Error LoadViewFiles(const std::vector<ViewFile>& files, LightField* light_field,
                    ThreadRunner* runner) {
  LightField result;
  for (const ViewFile& file : files) result.positions.push_back(file.position);
  result.views.resize(files.size());
  LoadJob load = {files,
                  &result.views,
                  std::vector<Error>(files.size()),
                  {"reading views", static_cast<int64_t>(files.size())}};
  const auto count = static_cast<int32_t>(files.size());
  if (runner != nullptr) {
    ThreadRunner::Run(runner, LoadJob::Run, &load, count);
  } else {
    for (int32_t k = 0; k < count; ++k) LoadJob::Run(&load, k, 0);
  }
  for (size_t k = 0; k < files.size(); ++k) {
    if (load.errors[k]) return load.errors[k];
    const Image &centre = result.views[0], &view = result.views[k];
    if (view.width != centre.width || view.height != centre.height) {
      return Expected(files[k].path, SizeText(centre.width, centre.height) + " as the centre view",
                      SizeText(view.width, view.height));
    }
  }
  *light_field = std::move(result);
  return {};
}

Error LoadCaptured(const std::string& folder, const Positions& wanted, LightField* light_field,
                   ThreadRunner* runner) {
  std::vector<ViewFile> files;
  if (Error error = ChooseViewFiles(folder, wanted, &files)) return error;
  return LoadViewFiles(files, light_field, runner);
}

Error LoadMap(const std::string& path, LightField* light_field) {
  FloatMap map;
  if (Error error = CheckPlainFile(path)) return error;
  if (Error error = ReadPfm(path, &map)) return error;
  return TakeMap(path, std::move(map), light_field);
}

Error TakeMap(const std::string& path, FloatMap map, LightField* light_field) {
  const Image& centre = light_field->views[0];
  if (map.width != centre.width || map.height != centre.height) {
    return Expected(path, SizeText(centre.width, centre.height) + " as the centre view",
                    SizeText(map.width, map.height));
  }
  light_field->disparity = std::move(map);
  return {};
}

std::string CoveragePath(const std::string& folder) {
  std::error_code error;
  std::string path = Join(folder, kCoverageName);
  return fs::exists(path, error) ? path : "";
}

Error LoadCoverage(const std::string& path, LightField* light_field) {
  Bytes bytes;
  Samples samples;
  if (Error error = CheckPlainFile(path)) return error;
  if (Error error = ReadFile(path, &bytes)) return error;
  if (Error error = DecodeCoverage(path, &bytes, &samples)) return error;
  const Image& centre = light_field->views[0];
  if (samples.map.width != centre.width || samples.map.height != centre.height) {
    return Expected(path, SizeText(centre.width, centre.height) + " as the centre view",
                    SizeText(samples.map.width, samples.map.height));
  }
  const float scale = 255 / static_cast<float>(samples.largest);
  light_field->coverage.clear();
  for (const float value : samples.map.values) {
    light_field->coverage.push_back(static_cast<uint8_t>(value * scale + 0.5F));
  }
  return {};
}

Error LoadLightField(const std::string& folder, const Positions& wanted, LightField* light_field,
                     ThreadRunner* runner) {
  LightField result;
  Error error = LoadCaptured(folder, wanted, &result, runner);
  if (!error) error = LoadMap(DisparityPath(folder), &result);
  const std::string coverage = CoveragePath(folder);
  if (!error && !coverage.empty()) error = LoadCoverage(coverage, &result);
  if (!error) *light_field = std::move(result);
  return error;
}

Error SaveLightField(const std::string& folder, const LightField& light_field,
                     ThreadRunner* runner) {
  if (Error error = MakeFolder(folder)) return error;
  const Positions& given = light_field.positions;
  const auto views = static_cast<int>(light_field.views.size());
  SaveJob save = {folder,
                  light_field,
                  given.empty() ? StarPositions(views) : given,
                  std::vector<Error>(light_field.views.size()),
                  {"writing views", views}};
  const int status = ThreadRunner::Run(runner, SaveJob::Run, &save, views);
  if (status != 0) return Expected(folder, "a thread runner", "none");
  for (const Error& error : save.errors) {
    if (error) return error;
  }
  if (!light_field.coverage.empty()) {
    if (Error error = SaveCoverage(folder, light_field)) return error;
  }
  if (light_field.disparity.values.empty()) return {};
  return WritePfm(DisparityPath(folder), light_field.disparity);
}

}  // namespace starfocus
