// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/middlebury.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <limits>

#include "platform/helper/helper.h"
#include "platform/levels.h"
#include "platform/readers/key_values.h"

namespace starfocus {
namespace {

// A size in which Middlebury publishes a scene. `multiple` is the ratio of grey levels to
// disparities in maps of the published size. The published sizes of a pair are sorted from large to
// small.
struct Size {
  int least_height, multiple;
};

// A kind of stereo pair whose map is a grey picture: its file names and published sizes.
struct GreyMapPair {
  const char *format, *left, *right, *map;
  Size sizes[4];
};

constexpr const char* kViewExtensions[] = {".png", ".ppm", ".pgm"};
// Middlebury's pictures of 2003 are 375, 750 or 1500 pixels high. Middlebury's pictures of 2005 and
// 2006 are 370, 555 or 1110 pixels high. Data sets of 2001 use the file names of 2003, and grey
// levels of 8 times the disparity.
constexpr GreyMapPair kPairs[] = {{"Middlebury stereo pair of 2003",
                                   "im2",
                                   "im6",
                                   "disp2",
                                   {{1125, 1}, {560, 2}, {0, 4}, {0, 8}}},
                                  {"Middlebury stereo pair of 2005 or 2006",
                                   "view1",
                                   "view5",
                                   "disp1",
                                   {{830, 1}, {460, 2}, {0, 3}, {0, 3}}}};

// Returns the entry of `names` that consists of `name` and a known extension, or an empty string if
// no such entry exists.
std::string Find(const std::vector<std::string>& names, const std::string& name) {
  for (const char* extension : kViewExtensions) {
    if (std::binary_search(names.begin(), names.end(), name + extension)) return name + extension;
  }
  return "";
}

// Returns the mean difference of the left and right pictures at corresponding pixels, assuming that
// grey levels are `multiple` times the disparity. Compares only pixels that have a corresponding
// pixel in the right picture, whatever the value of `multiple` is.
double Difference(const LightField& field, const FloatMap& levels, int multiple) {
  // kCutOff limits the difference at occluded pixels, and kStep = 2 skips every other row.
  constexpr int kCutOff = 90, kStep = 2;
  const Image &left = field.views[0], &right = field.views[1];
  double sum = 0, count = 0;
  for (int y = 0; y < levels.height; y += kStep) {
    for (int x = 0; x < levels.width; ++x) {
      const double level = double(levels.at(x, y));
      if (std::isnan(level) || level > x) continue;
      const uint8_t* a = left.row(y) + 3 * size_t(x);
      const uint8_t* b = right.row(y) + 3 * static_cast<size_t>(std::lround(x - level / multiple));
      int difference = 0;
      for (int c = 0; c < 3; ++c) difference += std::abs(a[c] - b[c]);
      sum += std::min(difference, kCutOff);
      count += 1;
    }
  }
  return count > 0 ? sum / count : 0;
}

int ChooseMultiple(const GreyMapPair& pair, const LightField& field, const FloatMap& levels) {
  // Replaces the default multiple by another multiple whose result of Difference is less than
  // kClearly times the result of the default multiple, minus kLevel for rounding errors.
  constexpr double kClearly = 0.7, kLevel = 1;
  const Size* own =
      std::find_if(std::begin(pair.sizes), std::end(pair.sizes),
                   [&](const Size& size) { return levels.height >= size.least_height; });
  int best = own->multiple;
  if (field.views.size() < 2) return best;
  double least = kClearly * Difference(field, levels, best) - kLevel;
  for (const Size& size : pair.sizes) {
    const double difference = Difference(field, levels, size.multiple);
    if (difference >= least) continue;
    least = difference;
    best = size.multiple;
  }
  return best;
}

}  // namespace

Error ReadMiddlebury(const std::string& folder, Capture* capture) {
  Result<KeyValues> read = ReadKeyValues((std::filesystem::path(folder) / "calib.txt").string());
  if (!read) return read.error();
  KeyValues& values = *read;
  capture->format = "Middlebury stereo pair";
  if (NumberOf(values, "baseline")) {
    capture->facts.emplace_back("cameras", values["baseline"] + " mm apart");
  }
  if (const auto offset = NumberOf(values, "doffs")) {
    const std::string& text = values["doffs"];
    const std::string there = *offset > 0 ? "-" + text : *offset < 0 ? text.substr(1) : "0";
    capture->facts.emplace_back("infinity", "at disparity " + there);
  }
  return {};
}

std::optional<Capture> FindGreyMapPair(const std::string& folder,
                                       const std::vector<std::string>& names) {
  for (const GreyMapPair& pair : kPairs) {
    const std::string left = Find(names, pair.left), right = Find(names, pair.right);
    const std::string map = Find(names, pair.map);
    if (left.empty() || right.empty() || map.empty()) continue;
    const std::filesystem::path path(folder);
    Capture capture;
    capture.format = pair.format;
    capture.care = MapCare::kFill;
    capture.files = {{{0, 0}, (path / left).string()}, {{1, 0}, (path / right).string()}};
    capture.map_path = (path / map).string();
    return capture;
  }
  return {};
}

Error LoadGreyMap(Capture* capture) {
  const std::string& path = capture->map_path;
  const Result<Bytes> bytes = ReadFile(path);
  if (!bytes) return bytes.error();
  Result<Samples> samples =
      Confined<Samples>(path, [&] { return DecodeSamples(path, Alpha::kTransparent, *bytes); });
  if (!samples) return samples.error();
  std::replace(samples->map.values.begin(), samples->map.values.end(), 0.0F,
               std::numeric_limits<float>::quiet_NaN());
  LightField* field = &capture->light_field;
  if (Error error = TakeMap(path, std::move(samples->map), field)) return error;
  const auto* pair =
      std::find_if(std::begin(kPairs), std::end(kPairs),
                   [&](const GreyMapPair& one) { return capture->format == one.format; });
  const int multiple = ChooseMultiple(*pair, *field, field->disparity);
  for (float& value : field->disparity.values) value /= static_cast<float>(multiple);
  capture->facts.emplace_back(
      "map", "levels are " + std::to_string(multiple) + " times the disparity, 0 is unknown");
  return {};
}

}  // namespace starfocus
