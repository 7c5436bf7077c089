// SPDX-License-Identifier: Apache-2.0
#include "examples/lab/bench/field.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "examples/lab/bench/metrics.h"
#include "platform/image_io.h"
#include "starfocus/starfocus.hpp"

namespace starfocus::bench {
namespace {

namespace fs = std::filesystem;

void Measure(Field* field) {
  const auto [low, high] =
      std::minmax_element(field->data.disparity.values.begin(), field->data.disparity.values.end());
  field->low = *low;
  field->high = *high;
}

Error LoadTruths(const std::string& folder, Field* field) {
  std::vector<fs::path> paths;
  std::error_code failure;
  for (const auto& entry : fs::directory_iterator(folder, failure)) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  for (const fs::path& path : paths) {
    Truth truth;
    const std::string name = path.filename().string();
    if (std::sscanf(name.c_str(), "truth_dt%lf_ut%lf", &truth.focus, &truth.aperture) != 2) {
      continue;
    }
    Result<Image> picture = ReadImage(path.string());
    if (!picture) return picture.error();
    truth.picture = std::move(*picture);
    if (truth.picture.width != field->data.width() ||
        truth.picture.height != field->data.height()) {
      return Expected(path.string(), "the size of the views", "another");
    }
    field->truths.push_back(std::move(truth));
  }
  return {};
}

// Returns the pixel of the original row that is shown at x in a row of alternately mirrored copies.
// The original row has `size` pixels.
int Mirror(int x, int size) {
  const int place = x % (2 * size);
  return place < size ? place : 2 * size - 1 - place;
}

}  // namespace

double Field::FocusAt(double quantile) const { return Quantile(data.disparity.values, quantile); }

double Field::LargestBlur(double focus, double aperture) const {
  return aperture * std::max(std::fabs(low - focus), std::fabs(high - focus));
}

const Image* Field::FindTruth(double focus, double aperture) const {
  for (const Truth& truth : truths) {
    if (std::fabs(truth.focus - focus) < 1e-6 && truth.aperture == aperture) return &truth.picture;
  }
  return nullptr;
}

Error LoadField(const std::string& folder, Field* field) {
  const fs::path path = fs::path(folder).lexically_normal();
  field->name = (path.has_filename() ? path : path.parent_path()).filename().string();
  Result<LightField> loaded = LoadLightField(folder, {});
  if (!loaded) return loaded.error();
  field->data = std::move(*loaded);
  FloatMap* map = &field->data.disparity;
  const starfocus_status status = starfocus_fill_disparity(
      map->values.data(), sizeof(float) * size_t(map->width), map->width, map->height, nullptr);
  if (status != STARFOCUS_OK)
    return Expected(folder, "a disparity map", starfocus_status_string(status));
  Measure(field);
  return LoadTruths(folder, field);
}

Field Tile(const Field& field, int width, int height, int views) {
  Field tiled;
  tiled.name = field.name;
  const int w = field.data.width(), h = field.data.height();
  for (int i = 0; i < std::min(views, field.views()); ++i) {
    Image image(width, height);
    for (int y = 0; y < height; ++y) {
      const uint8_t* source = field.data.views[size_t(i)].row(Mirror(y, h));
      for (int x = 0; x < width; ++x) {
        std::copy_n(source + 3 * Mirror(x, w), 3, image.row(y) + 3 * x);
      }
    }
    tiled.data.views.push_back(std::move(image));
  }
  FloatMap& map = tiled.data.disparity;
  map.width = width;
  map.height = height;
  map.values.reserve(size_t(width) * size_t(height));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      map.values.push_back(field.data.disparity.at(Mirror(x, w), Mirror(y, h)));
    }
  }
  Measure(&tiled);
  return tiled;
}

Field Stretch(const Field& field, double factor, int views) {
  Field stretched;
  stretched.name = field.name;
  stretched.data.disparity = field.data.disparity;
  const auto count = std::min(size_t(views), field.data.views.size());
  stretched.data.views.assign(field.data.views.begin(),
                              field.data.views.begin() + std::ptrdiff_t(count));
  for (float& value : stretched.data.disparity.values) value = float(value * factor);
  Measure(&stretched);
  return stretched;
}

starfocus_light_field Rows(const LightField& data, int views) {
  starfocus_light_field rows = starfocus::NewLightField();
  for (int i = 0; i < views; ++i) {
    const Image& view = data.views[size_t(i)];
    rows.views[i] = starfocus_image_rgb(view.pixels.data(), view.stride());
  }
  rows.depth =
      starfocus_depth_float(data.disparity.values.data(), sizeof(float) * size_t(data.width()),
                            data.width(), data.height());
  return rows;
}

}  // namespace starfocus::bench
