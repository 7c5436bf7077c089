// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/matte_file.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "platform/levels.h"
#include "platform/readers/map_orientation.h"
#include "platform/readers/matte.h"
#include "platform/readers/orientation.h"
#include "platform/readers/pair.h"
#include "platform/text.h"

namespace starfocus {
namespace {

// Part of the range by which values may lie outside it, because networks and resampling round.
constexpr float kTolerance = 0.01F;

// Returns the value of full alpha of a matte whose largest value is `high`.
float FullAlpha(const Samples& samples, float high) {
  // No subject has an alpha up to 2 of 255, so that such a matte exceeds the range from 0 to 1.
  constexpr float kLeastLevel = 2;
  // An alpha channel contains no labels.
  if (high <= 1 + kTolerance && !samples.is_alpha) return 1;
  if (samples.largest > 0 && !samples.is_wide) return static_cast<float>(samples.largest);
  return high <= kLeastLevel ? 1 : 255;
}

// Converts the values of a matte to alpha from 0 to 1.
Error ToAlpha(const std::string& where, Samples* samples) {
  std::vector<float>& values = samples->map.values;
  if (!std::all_of(values.begin(), values.end(), [](float value) { return std::isfinite(value); }))
    return Expected(where, "a matte of finite values", "NaN or infinity");
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const float white = FullAlpha(*samples, *high);
  if (*low < -kTolerance * white || *high > (1 + kTolerance) * white) {
    return Expected(where, "alpha from 0 to 1 or from 0 to 255",
                    "values from " + NumberText(double(*low)) + " to " + NumberText(double(*high)));
  }
  for (float& value : values) value = std::clamp(value / white, 0.0F, 1.0F);
  return {};
}

Error TakeMatte(const std::string& where, const DepthOptions& options, DepthOrientation choice,
                Samples samples, DepthPhoto* photo) {
  if (Error error = ToAlpha(where, &samples)) return error;
  StandWithPhoto(choice, true, photo, &samples.map);
  if (Error error = CheckMatte(where, samples.map, photo->picture, options.is_frame)) return error;
  photo->matte = std::move(samples.map);
  return {};
}

}  // namespace

Error ReadMatteFile(const std::string& path, const DepthOptions& options, DepthPhoto* photo) {
  Result<Samples> samples = ReadSamples(path, Alpha::kTaken, options);
  return samples ? TakeMattePicture(path, options, std::move(*samples), photo) : samples.error();
}

Error TakeMattePicture(const std::string& path, const DepthOptions& options, Samples samples,
                       DepthPhoto* photo) {
  if (photo->map.values.empty()) photo->format = "photo and matte";
  // The mattes in the photo are not used.
  photo->facts.erase(std::remove_if(photo->facts.begin(), photo->facts.end(),
                                    [](const auto& fact) { return fact.first == "mattes"; }),
                     photo->facts.end());
  photo->facts.emplace_back("matte picture", path);
  photo->matte_path = path;
  return TakeMatte(path, options, options.orientation, std::move(samples), photo);
}

Error EstimateMatte(const std::string& where, const DepthOptions& options, DepthPhoto* photo) {
  ApplyOrientation(photo);
  Result<Samples> samples = options.estimate_matte(photo->picture);
  if (!samples) return samples.error();
  if (photo->map.values.empty()) photo->format = "photo with computed matte";
  photo->facts.emplace_back("matte picture", "computed by --matte-command");
  return TakeMatte(where + " (matte of the matte command)", options, DepthOrientation::kUpright,
                   std::move(*samples), photo);
}

}  // namespace starfocus
