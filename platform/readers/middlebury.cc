// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/middlebury.h"

#include <filesystem>

#include "platform/readers/key_values.h"

namespace starfocus {

std::string ReadMiddlebury(const std::string& folder, Capture* capture) {
  KeyValues values;
  const std::string error =
      ReadKeyValues((std::filesystem::path(folder) / "calib.txt").string(), &values);
  if (!error.empty()) return error;
  capture->format = "Middlebury stereo pair";
  capture->care = MapCare::kFill;
  double baseline = 0, offset = 0;
  if (NumberOf(values, "baseline", &baseline)) {
    capture->facts.emplace_back("cameras", values["baseline"] + " mm apart");
  }
  if (NumberOf(values, "doffs", &offset)) {
    capture->facts.emplace_back("infinity", "at disparity -" + values["doffs"]);
  }
  return "";
}

}  // namespace starfocus
