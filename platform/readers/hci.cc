// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/hci.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "platform/readers/key_values.h"
#include "platform/readers/view_array.h"

namespace starfocus {
namespace {

constexpr char kPrefix[] = "input_Cam", kExtension[] = ".png";
constexpr char kMap[] = "gt_disp_lowres.pfm", kParameters[] = "parameters.cfg";

bool IsView(const std::string& name) {
  constexpr size_t kBegin = sizeof(kPrefix) - 1, kEnd = sizeof(kExtension) - 1;
  return name.size() == kBegin + 3 + kEnd && name.compare(0, kBegin, kPrefix) == 0 &&
         name.compare(name.size() - kEnd, kEnd, kExtension) == 0;
}

bool Has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// Sets the widest f-stop, which belongs to a lens whose rim passes through the outermost views.
// The widest f-stop is the focal length, divided by twice the distance of the outermost views from
// the centre.
Error ReadParameters(const std::string& path, int reach, Capture* capture) {
  Result<KeyValues> read = ReadKeyValues(path);
  if (!read) return read.error();
  KeyValues& values = *read;
  const auto baseline = NumberOf(values, "baseline_mm");
  const auto focal = NumberOf(values, "focal_length_mm");
  if (!(baseline > 0.0 && focal > 0.0)) return {};  // a missing value (nullopt) is less than 0
  capture->widest = *focal / (2 * reach * *baseline);
  char f_stop[32];
  std::snprintf(f_stop, sizeof(f_stop), "%.3g", capture->widest);
  capture->facts.emplace_back("cameras", values["baseline_mm"] + " mm apart, lenses of " +
                                             values["focal_length_mm"] + " mm; radius 1 is f/" +
                                             f_stop);
  return {};
}

}  // namespace

bool IsHci(const std::vector<std::string>& names) {
  return std::any_of(names.begin(), names.end(), IsView);
}

Result<Capture> OpenHci(const std::string& folder, const std::vector<std::string>& names) {
  Capture capture;
  capture.format = "HCI 4D light field";
  ViewArray array;
  for (const std::string& name : names) {
    if (IsView(name)) array.paths.push_back((std::filesystem::path(folder) / name).string());
  }
  const auto side = static_cast<int>(std::lround(std::sqrt(double(array.paths.size()))));
  if (size_t(side) * size_t(side) != array.paths.size()) {
    return Expected(
        folder, "a square number of views, such as 81",
        std::to_string(array.paths.size()) + " views named " + kPrefix + "000.png and so on");
  }
  array.rows = array.columns = side;
  Result<Star> star = ChooseStar(folder, array, &capture.facts);
  if (!star) return star.error();
  capture.files = std::move(star->views);
  if (Has(names, kMap)) {
    capture.map_path = (std::filesystem::path(folder) / kMap).string();
    capture.map_scale = star->reach;  // the HCI map stores disparities between neighbouring views
  }
  if (!Has(names, kParameters)) return capture;
  const std::string parameters = (std::filesystem::path(folder) / kParameters).string();
  if (Error error = ReadParameters(parameters, star->reach, &capture)) return error;
  return capture;
}

}  // namespace starfocus
