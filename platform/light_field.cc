// SPDX-License-Identifier: Apache-2.0
#include "platform/light_field.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <system_error>

#include "platform/decoders/deep.h"
#include "platform/deep_image.h"
#include "platform/folder.h"
#include "platform/helper/helper.h"
#include "platform/image_io.h"
#include "platform/levels.h"
#include "platform/progress.h"
#include "platform/text.h"
#include "platform/writers/deep_picture.h"
#include "platform/writers/png.h"
#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"

namespace starfocus {
namespace {

namespace fs = std::filesystem;

std::string Join(const std::string& folder, const std::string& name) {
  return (fs::path(folder) / name).string();
}

constexpr char kDisparityName[] = "disparity.pfm";
constexpr char kCoverageName[] = "coverage.png";
// File names of disparity maps in stereo pairs of Middlebury and ETH3D.
constexpr const char* kPairDisparityNames[] = {"disp0.pfm", "disp0GT.pfm"};

Error CheckSize(const std::string& path, int width, int height, const Image& centre) {
  if (width == centre.width && height == centre.height) return {};
  return Expected(path,
                  SizeText(centre.width, centre.height) + " pixels, the size of the centre view",
                  SizeText(width, height));
}

struct SaveJob {
  const std::string& folder;
  const LightField& light_field;
  const Positions positions;
  std::vector<Error> errors;  // one per view
  Progress progress;

  std::string PathOf(int32_t index) const {
    const bool is_half = !light_field.deep.empty() && light_field.deep[0].is_half;
    return Join(folder, ViewName(positions[size_t(index)]) + (is_half ? ".exr" : ".png"));
  }
  Error Write(int32_t index) const {
    const std::string path = PathOf(index);
    if (light_field.deep.empty()) return WriteImage(path, light_field.views[size_t(index)]);
    DeepOptions options;
    options.picture.metadata.colours = light_field.deep_colours;
    std::vector<std::string> notes;
    return WriteDeepImage(path, light_field.deep[size_t(index)], options, &notes);
  }
  static void Run(void* data, int32_t index, int32_t) {
    SaveJob* self = static_cast<SaveJob*>(data);
    self->errors[size_t(index)] = self->Write(index);
    self->progress.Step();
  }
};

struct LoadJob {
  const std::vector<ViewFile>& files;
  std::vector<Result<DecodedPicture>> views;
  Progress progress;

  static void Run(void* data, int32_t index, int32_t) {
    LoadJob* self = static_cast<LoadJob*>(data);
    const std::string& path = self->files[size_t(index)].path;
    self->views[size_t(index)] = ReadPicture(path);
    self->progress.Step();
  }
};

Error SaveCoverage(const std::string& folder, const LightField& light_field) {
  GreyImage image;
  image.width = light_field.views[0].width;
  image.height = light_field.views[0].height;
  image.levels.assign(light_field.coverage.begin(), light_field.coverage.end());
  const std::string path = Join(folder, kCoverageName);
  return WriteFile(path, EncodeGreyPng(path, image));
}

}  // namespace

void ConfigureViews(const LightField& light_field, starfocus_config* config) {
  config->views = static_cast<int32_t>(light_field.views.size());
  std::copy(light_field.positions.begin(), light_field.positions.end(), config->positions);
}

starfocus_depth_map EngineMap(const FloatMap& map) {
  return starfocus_depth_float(map.values.data(), map.stride(), map.width, map.height);
}

starfocus_disparity_stats MeasureDisparity(const FloatMap& map) {
  starfocus_disparity_stats stats = {};
  const starfocus_depth_map depth = EngineMap(map);
  starfocus_measure_disparity(&depth, &stats, nullptr);
  return stats;
}

starfocus_image EngineImage(const DeepImage& deep, int first) {
  constexpr starfocus_format kFormats[2][2] = {
      {STARFOCUS_FORMAT_RGB16, STARFOCUS_FORMAT_RGBA16},
      {STARFOCUS_FORMAT_RGB_HALF, STARFOCUS_FORMAT_RGBA_HALF}};
  starfocus_image image = starfocus_image_rgb(deep.row(first), 2 * deep.row_samples());
  image.format = kFormats[deep.is_half ? 1 : 0][deep.channels - 3];
  return image;
}

starfocus_image EngineImage(const PlanarImage& planar) {
  auto* const luma = const_cast<uint8_t*>(planar.samples.data());
  const size_t bytes = planar.is_deep ? 2 : 1, row = size_t(planar.chroma_width());
  starfocus_image image = starfocus_image_rgb(luma, bytes * size_t(planar.width));
  image.format = planar.is_deep ? STARFOCUS_FORMAT_P010 : STARFOCUS_FORMAT_I420;
  image.matrix = planar.matrix;
  image.range = planar.range;
  image.planes[1] = luma + bytes * planar.luma_samples();
  image.planes[2] = luma + planar.luma_samples() + planar.chroma_samples();
  image.strides[1] = planar.is_deep ? 2 * bytes * row : row;
  image.strides[2] = row;
  return image;
}

starfocus_light_field EngineRows(const LightField& light_field, int first, bool deep) {
  starfocus_light_field rows = starfocus::NewLightField();
  const bool planar = !light_field.planar.samples.empty();
  if (planar) rows.views[0] = EngineImage(light_field.planar);
  for (size_t i = 0; i < light_field.views.size() && !planar; ++i) {
    const Image& view = light_field.views[i];
    rows.views[i] = deep ? EngineImage(light_field.deep[i], first)
                         : starfocus_image_rgb(view.row(first), view.stride());
  }
  const FloatMap& map = light_field.disparity;
  const size_t before = size_t(first) * size_t(map.width);
  rows.depth =
      starfocus_depth_float(map.values.data() + before, map.stride(), map.width, map.height);
  if (!light_field.coverage.empty()) {
    rows.coverage = light_field.coverage.data() + before;
    rows.coverage_stride = size_t(map.width);
  }
  return rows;
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

Result<FloatMap> ReadDisparity(const std::string& folder) { return ReadPfm(DisparityPath(folder)); }

bool HasDisparity(const std::string& folder) {
  std::error_code error;
  return fs::exists(DisparityPath(folder), error);
}

namespace {

// Returns true if light is proportional to the 8-bit codes of a view. Half floats have renditions.
bool IsLinearView(const Result<DecodedPicture>& view) {
  const bool is_half = view->deep && view->deep->is_half;
  return !is_half && TransferOf(ColoursOf(view->metadata)) == STARFOCUS_TRANSFER_NONE;
}

// Takes the deep pictures of the views, if there is any, and the colours of the first. Views of 8
// bits are expanded. Codes of different transfers become half floats.
void TakeDeep(std::vector<Result<DecodedPicture>>* views, LightField* light_field) {
  const auto is_deep = [](const Result<DecodedPicture>& view) { return view->deep.has_value(); };
  if (std::none_of(views->begin(), views->end(), is_deep)) return;
  for (size_t k = 0; k < views->size(); ++k) {
    std::optional<DeepImage>& deep = (*views)[k]->deep;
    light_field->deep.push_back(deep ? std::move(*deep) : Widen(light_field->views[k], {}));
  }
  light_field->deep_colours = ColoursOf(views->front()->metadata);
  const DeepImage& first = light_field->deep[0];
  const bool alike =
      std::all_of(light_field->deep.begin(), light_field->deep.end(), [&](const DeepImage& deep) {
        return deep.is_half || (!first.is_half && deep.transfer == first.transfer);
      });
  if (alike) return;
  for (DeepImage& deep : light_field->deep) deep = deep.is_half ? std::move(deep) : ToHalf(deep);
}

}  // namespace

Result<LightField> LoadViewFiles(const std::vector<ViewFile>& files, ThreadRunner* runner) {
  LoadJob load = {files,
                  std::vector<Result<DecodedPicture>>(files.size(), DecodedPicture()),
                  {"reading views", static_cast<int64_t>(files.size())}};
  const auto count = static_cast<int32_t>(files.size());
  if (runner != nullptr) {
    ThreadRunner::Run(runner, LoadJob::Run, &load, count);
  } else {
    for (int32_t k = 0; k < count; ++k) LoadJob::Run(&load, k, 0);
  }
  LightField result;
  for (size_t k = 0; k < files.size(); ++k) {
    if (!load.views[k]) return load.views[k].error();
    result.positions.push_back(files[k].position);
    result.views.push_back(std::move(load.views[k]->image));
    const Image& view = result.views[k];
    Error error = CheckSize(files[k].path, view.width, view.height, result.views[0]);
    if (error) return error;
  }
  result.is_linear = std::all_of(load.views.begin(), load.views.end(), IsLinearView);
  TakeDeep(&load.views, &result);
  return result;
}

Error LoadMap(const std::string& path, LightField* light_field) {
  Result<FloatMap> map = ReadPfm(path);
  return map ? TakeMap(path, std::move(*map), light_field) : map.error();
}

Error TakeMap(const std::string& path, FloatMap map, LightField* light_field) {
  if (Error error = CheckSize(path, map.width, map.height, light_field->views[0])) return error;
  light_field->disparity = std::move(map);
  return {};
}

std::string CoveragePath(const std::string& folder) {
  std::error_code error;
  std::string path = Join(folder, kCoverageName);
  return fs::exists(path, error) ? path : "";
}

Error LoadCoverage(const std::string& path, LightField* light_field) {
  const Result<Bytes> bytes = ReadFile(path);
  if (!bytes) return bytes.error();
  const Result<Samples> samples =
      Confined<Samples>(path, [&] { return DecodeSamples(path, Alpha::kTaken, *bytes); });
  if (!samples) return samples.error();
  const FloatMap& map = samples->map;
  if (Error error = CheckSize(path, map.width, map.height, light_field->views[0])) return error;
  const float scale = 255 / static_cast<float>(samples->largest);
  light_field->coverage.clear();
  for (const float value : map.values) {
    light_field->coverage.push_back(static_cast<uint8_t>(value * scale + 0.5F));
  }
  return {};
}

Result<LightField> LoadLightField(const std::string& folder, const Positions& wanted,
                                  ThreadRunner* runner) {
  const Result<std::vector<ViewFile>> files = ChooseViewFiles(folder, wanted);
  if (!files) return files.error();
  Result<LightField> result = LoadViewFiles(*files, runner);
  if (!result) return result;
  if (Error error = LoadMap(DisparityPath(folder), &*result)) return error;
  const std::string coverage = CoveragePath(folder);
  if (coverage.empty()) return result;
  if (Error error = LoadCoverage(coverage, &*result)) return error;
  return result;
}

Error SaveLightField(const std::string& folder, const LightField& light_field,
                     ThreadRunner* runner) {
  OutputFolder made;
  if (Error error = made.Create(folder)) return error;
  const Positions& given = light_field.positions;
  const auto views = static_cast<int>(std::max(light_field.views.size(), light_field.deep.size()));
  SaveJob save = {folder,
                  light_field,
                  given.empty() ? StarPositions(views) : given,
                  std::vector<Error>(size_t(views)),
                  {"writing views", views}};
  const int status = ThreadRunner::Run(runner, SaveJob::Run, &save, views);
  if (status != 0) return Expected(folder, "a thread runner", "none");
  const auto failed = std::find_if(save.errors.begin(), save.errors.end(),
                                   [](const Error& error) { return bool(error); });
  Error error = failed == save.errors.end() ? Error() : *failed;
  const bool covers = !light_field.coverage.empty();
  if (!error && covers) error = SaveCoverage(folder, light_field);
  if (!error && !light_field.disparity.values.empty()) {
    error = WritePfm(DisparityPath(folder), light_field.disparity);
  }
  if (!error) return {};
  // Part of a light field would be taken for a damaged one.
  std::error_code ignored;
  for (int k = 0; k < views; ++k) {
    if (!save.errors[size_t(k)]) fs::remove(save.PathOf(k), ignored);
  }
  if (covers) fs::remove(Join(folder, kCoverageName), ignored);
  return error;
}

}  // namespace starfocus
