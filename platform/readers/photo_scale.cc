// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/photo_scale.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "platform/readers/depth_levels.h"
#include "platform/readers/map_orientation.h"
#include "platform/readers/matte.h"
#include "platform/readers/orientation.h"
#include "platform/readers/robust_range.h"
#include "platform/readers/unknown_depth.h"
#include "platform/text.h"
#include "starfocus/starfocus.h"

namespace starfocus {
namespace {

// Diagonal of a full-frame sensor of 36 x 24 mm, the reference of "35 mm equivalent" focal lengths.
// If the file states neither a lens nor distances, a portrait is assumed: a 50 mm lens at a
// distance of 1.5 m.
constexpr double kDiagonal = 43.2666, kPortraitLens = 50, kPortraitDistance = 1.5;

// Position of a pixel of the resized map between two pixels of the original map.
struct Between {
  int first, second;
  float weight;  // weight of `second`
};

std::vector<Between> Places(int from, int to) {
  std::vector<Between> places;
  for (int k = 0; k < to; ++k) {
    const double at = std::clamp((k + 0.5) * from / to - 0.5, 0.0, from - 1.0);
    const int first = static_cast<int>(at);
    places.push_back({first, std::min(first + 1, from - 1), static_cast<float>(at - first)});
  }
  return places;
}

// The jobs of a resizing, each of which fills kRows rows.
struct ResizeTask {
  static constexpr int kRows = 64;

  const FloatMap& map;
  std::vector<Between> columns, rows;
  FloatMap* result;

  static void Run(void* data, int32_t index, int32_t) {
    const ResizeTask& task = *static_cast<const ResizeTask*>(data);
    const int end = std::min((index + 1) * kRows, task.result->height);
    for (int y = index * kRows; y < end; ++y) task.FillRow(y);
  }
  void FillRow(int y) const {
    const Between& row = rows[size_t(y)];
    const float* above = map.values.data() + size_t(row.first) * size_t(map.width);
    const float* below = map.values.data() + size_t(row.second) * size_t(map.width);
    float* to = result->values.data() + size_t(y) * size_t(result->width);
    for (const Between& column : columns) {
      float sum = 0, weights = 0, low = std::numeric_limits<float>::infinity(), high = -low;
      const auto add = [&](float value, float weight) {
        if (!std::isfinite(value)) return;
        sum += weight * value;
        weights += weight;
        low = std::min(low, value);
        high = std::max(high, value);
      };
      add(above[column.first], (1 - column.weight) * (1 - row.weight));
      add(above[column.second], column.weight * (1 - row.weight));
      add(below[column.first], (1 - column.weight) * row.weight);
      add(below[column.second], column.weight * row.weight);
      // Clamp the mean, because rounding errors may move a mean outside the range of the averaged
      // values.
      *to++ = weights > 0 ? std::clamp(sum / weights, low, high)
                          : std::numeric_limits<float>::quiet_NaN();
    }
  }
};

std::string Rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.3g", value);
  return text;
}

// Returns the disparity that an inverse distance of 1 / m corresponds to. The result is the blur
// radius in pixels of an infinitely distant point, for an f/1 lens of focal length `focal_35mm`,
// focused at 1 m.
double DisparityPerDiopter(double focal_35mm, double diagonal_pixels) {
  return focal_35mm / kDiagonal * diagonal_pixels * focal_35mm / 1000 / 2;
}

// Replaces each map value by the disparity factor * (value - zero), at most `most`.
void Scale(double factor, double zero, double most, DepthPhoto* photo) {
  photo->focus_value = factor * (photo->focus_value - zero);
  for (float& value : photo->map.values) {
    value = static_cast<float>(
        std::clamp(factor * (double(value) - zero), -STARFOCUS_MAX_DISPARITY, most));
  }
}

// Returns the disparity of the nearest surface if neither the file nor the map states distances.
double NearestDisparity(double diagonal_pixels) {
  return DisparityPerDiopter(kPortraitLens, diagonal_pixels) / kPortraitDistance;
}

void ToDisparity(const RobustRange& range, double diagonal, DepthPhoto* photo) {
  if (photo->meaning == MapMeaning::kInverseMetres) {
    const double focal = photo->focal_35mm > 0 ? photo->focal_35mm : kPortraitLens;
    Scale(DisparityPerDiopter(focal, diagonal), 0, STARFOCUS_MAX_DISPARITY, photo);
    photo->facts.emplace_back("scale", "f-stops are those of a " + Rounded(focal) +
                                           " mm lens on full frame" +
                                           (photo->focal_35mm > 0 ? "" : " (assumed)"));
    return;
  }
  const bool order = photo->meaning == MapMeaning::kOrder;
  const double nearest = NearestDisparity(diagonal);
  const double zero = order ? double(range.low) : 0, extent = double(range.high) - zero;
  if (order) {
    for (float& value : photo->map.values) value = std::max(value, range.low);
  }
  Scale(extent > 0 ? nearest / extent : 0, zero, std::min(nearest, STARFOCUS_MAX_DISPARITY), photo);
  photo->facts.emplace_back("scale",
                            std::string("unknown: the nearest surface is assumed to be 1.5 m ") +
                                (order ? "and the farthest surface infinitely far " : "") +
                                "in front of a 50 mm lens on full frame");
}

// Returns an error if a disparity of the map is out of range. CheckDisparities does not change the
// map.
Error CheckDisparities(const std::string& where, DepthPhoto* photo) {
  const auto [low, high] = std::minmax_element(photo->map.values.begin(), photo->map.values.end());
  if (double(*low) >= -STARFOCUS_MAX_DISPARITY && double(*high) <= STARFOCUS_MAX_DISPARITY) {
    photo->facts.emplace_back("scale", "disparities of the map, in pixels");
    return {};
  }
  const double limit = STARFOCUS_MAX_DISPARITY;
  return Expected(where, "disparities from -" + Rounded(limit) + " to " + Rounded(limit),
                  Rounded(double(*low)) + " to " + Rounded(double(*high)));
}

// Returns a description of the values of the map, which must be equal for all frames of a clip.
std::string KindOf(const DepthPhoto& photo) {
  const std::string& samples = photo.survey.kind;
  switch (photo.meaning) {
    case MapMeaning::kInverseMetres:
      return "distances";
    case MapMeaning::kInverse:
      return "distances of unknown units";
    case MapMeaning::kDisparity:
      return "disparities";
    default:
      return "relative depth" + (samples.empty() ? "" : " in " + samples);
  }
}

// Measures the map. Returns the range of its values, or of the values in all maps of the clip.
// Inverts the map and the range if smaller values are nearer, which is a guess with a note.
RobustRange Survey(const MapSurvey* clip, DepthPhoto* photo) {
  MapSurvey& own = photo->survey;
  own.kind = KindOf(*photo);
  own.range = RobustRangeOf(photo->map.values);
  if (photo->guesses_near) {
    const MapSurvey near = SurveyNear(photo->map);
    own.rise = near.rise;
    own.has_infinity = near.has_infinity;
  }
  const MapSurvey& all = clip != nullptr ? *clip : own;
  if (!photo->guesses_near) return all.range;
  const bool white = all.GuessNear() == Near::kWhite;
  photo->notes.push_back(
      std::string(white ? "white" : "black") + " is taken as near in the depth picture, because " +
      (all.has_infinity    ? "only distances are infinite"
       : all.has_distances ? "its values look like distances"
                           : "the lower part of the picture is assumed to be nearer") +
      " (--near " + (white ? "black" : "white") + " overrides this)");
  if (white) return all.range;
  ToRange(1, 0, &photo->map);
  return {all.range.known, 1 - all.range.high, 1 - all.range.low};
}

// Fills unknown values of the depth map and adds a note that states their number.
void FillUnknown(DepthPhoto* photo) {
  const size_t filled = FillBehind(&photo->map), all = photo->map.values.size();
  if (filled == 0) return;
  photo->notes.push_back(
      std::to_string(filled) + " of " + std::to_string(all) +
      " pixels of the depth map are unknown and were filled from the background");
}

// Converts the map of an upright photo to disparities.
Result<FloatMap> ConvertMap(const std::string& where, const MapSurvey* clip, DepthPhoto* photo) {
  const Image& picture = photo->picture;
  const FloatMap& map = photo->map;
  if (!HasSameProportions(map, picture.width, picture.height)) {
    return Expected(
        where, "a depth map with the proportions of the picture",
        SizeText(map.width, map.height) + " for " + SizeText(picture.width, picture.height));
  }
  const RobustRange range = Survey(clip, photo);
  if (!photo->survey.range.known) return Expected(where, "a map with known depths", "none");
  FillUnknown(photo);
  if (photo->meaning == MapMeaning::kDisparity) {
    if (Error error = CheckDisparities(where, photo)) return error;
  } else {
    ToDisparity(range, std::hypot(picture.width, picture.height), photo);
  }
  return std::move(photo->map);
}

// Removes a matte that cannot be used, and adds a note, as for square mattes of other pictures.
// Returns an error if the photo then has neither a matte nor a map.
Error JudgeMatte(const std::string& where, bool is_frame, DepthPhoto* photo) {
  if (photo->matte.values.empty()) return {};
  const FloatMap& matte = photo->matte;
  const Image& picture = photo->picture;
  const Error error = CheckMatte(where, matte, picture, is_frame);
  const MatteContent content = ContentOf(matte);
  if (!error && content != MatteContent::kBoth) {
    photo->notes.push_back(content == MatteContent::kEmpty
                               ? "the matte is empty, so the frame has no subject"
                               : "the matte is full, so the frame has no background");
  }
  if (!error && IsStretched(matte, picture.width, picture.height)) {
    photo->notes.push_back("the square matte of " + SizeText(matte.width, matte.height) +
                           " pixels is stretched over the picture of " +
                           SizeText(picture.width, picture.height) +
                           " pixels, as networks compute it");
  }
  if (!error || photo->map.values.empty()) return error;
  photo->notes.push_back("the matte in the file is ignored: " + error.line());
  photo->matte = {};
  return {};
}

// Fills map and coverage of an upright photo without depth from its matte.
Error FillSurfaces(const std::string& where, bool floor, DepthPhoto* photo,
                   LightField* light_field) {
  const Image& picture = light_field->views[0];
  photo->survey.kind = "a matte without depth";
  photo->facts.emplace_back("scale",
                            std::string("unknown: the subject is assumed to be 1.5 m and the ") +
                                (floor ? "upper part of the " : "") +
                                "background infinitely far in front of a 50 mm lens on full frame");
  return FillTwoSurfaces(where, Matte(photo->matte), AssumedSubject(picture), floor, light_field);
}

}  // namespace

double AssumedSubject(const Image& picture) {
  const double nearest = NearestDisparity(std::hypot(picture.width, picture.height));
  return std::min(nearest, STARFOCUS_MAX_DISPARITY);
}

FloatMap Resize(const FloatMap& map, int width, int height, ThreadRunner* runner) {
  if (map.width == width && map.height == height) return map;
  FloatMap result = {width, height, {}};
  result.values.resize(size_t(width) * size_t(height));
  ResizeTask task = {map, Places(map.width, width), Places(map.height, height), &result};
  const int jobs = (height + ResizeTask::kRows - 1) / ResizeTask::kRows;
  if (runner != nullptr) {
    ThreadRunner::Run(runner, ResizeTask::Run, &task, jobs);
  } else {
    for (int job = 0; job < jobs; ++job) ResizeTask::Run(&task, job, 0);
  }
  return result;
}

Result<LightField> MakePhotoField(const std::string& where, DepthPhoto* photo,
                                  const DepthOptions& options) {
  ApplyOrientation(photo);
  if (Error error = JudgeMatte(where, options.is_frame, photo)) return error;
  const bool has_map = !photo->map.values.empty();
  LightField light_field;
  if (has_map) {
    const Error error = ConvertMap(where, options.clip, photo).MoveTo(&light_field.disparity);
    if (error) return error;
  }
  light_field.views.push_back(std::move(photo->picture));
  light_field.positions = {{0, 0}};
  light_field.is_linear = photo->is_linear;
  if (has_map) return light_field;
  if (Error error = FillSurfaces(where, options.floor, photo, &light_field)) return error;
  return light_field;
}

void FitMap(LightField* light_field, ThreadRunner* runner) {
  const Image& picture = light_field->views[0];
  FloatMap& map = light_field->disparity;
  if (map.width == picture.width && map.height == picture.height) return;
  map = Resize(map, picture.width, picture.height, runner);
}

}  // namespace starfocus
