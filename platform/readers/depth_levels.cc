// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/depth_levels.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "platform/image_io.h"
#include "platform/readers/exif.h"
#include "platform/readers/profile.h"
#include "platform/readers/unknown_depth.h"
#include "platform/text.h"

namespace starfocus {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

// Returns the mean of the known values of a map in rows `from` to `to` - 1.
double MeanOfRows(const FloatMap& map, int from, int to) {
  double sum = 0, count = 0;
  for (int y = from; y < to; ++y) {
    for (int x = 0; x < map.width; ++x) {
      if (!std::isfinite(map.at(x, y))) continue;
      sum += double(map.at(x, y));
      count += 1;
    }
  }
  return count > 0 ? sum / count : 0;
}

bool HasInfinity(const FloatMap& map) {
  return std::find(map.values.begin(), map.values.end(), HUGE_VALF) != map.values.end();
}

}  // namespace

void ToInverse(const DepthRange& range, FloatMap* map) {
  if (range.inverse) return ToRange(1 / range.near, 1 / range.far, map);
  ToRange(range.near, range.far, map);
  Invert(map);
}

void ToRange(double low, double high, FloatMap* map) {
  for (float& value : map->values) value = static_cast<float>(low + double(value) * (high - low));
}

void Invert(FloatMap* map) {
  for (float& value : map->values) value = value > 0 ? 1 / value : kUnknown;
}

Near GuessNear(const FloatMap& map) {
  const int third = (map.height + 2) / 3;
  return !HasInfinity(map) &&
                 MeanOfRows(map, map.height - third, map.height) > MeanOfRows(map, 0, third)
             ? Near::kWhite
             : Near::kBlack;
}

void ToOrder(Near near, DepthPhoto* photo) {
  if (near == Near::kUnknown) {
    near = GuessNear(photo->map);
    photo->notes.push_back(
        std::string(near == Near::kWhite ? "white" : "black") +
        " is taken as near in the depth picture, because " +
        (HasInfinity(photo->map) ? "only distances are infinite"
                                 : "the lower part of the picture is assumed to be nearer") +
        " (--near " + (near == Near::kWhite ? "black" : "white") + " overrides this)");
  }
  if (near == Near::kBlack) {
    ToRange(1, 0, &photo->map);
  } else {
    Forget(HUGE_VALF, &photo->map);
  }
  photo->meaning = MapMeaning::kOrder;
}

void TellMap(const std::string& text, DepthPhoto* photo) {
  photo->facts.emplace_back("map", SizeText(photo->map.width, photo->map.height) + ", " + text);
}

Result<DepthPhoto> ReadJpegPicture(const std::string& where, Span file, const JpegParts& parts) {
  Result<DecodedPicture> picture = DecodeImage(where, Bytes(file.data, file.data + file.size));
  if (!picture) return picture.error();
  DepthPhoto photo;
  photo.picture = std::move(picture->image);
  photo.metadata = parts.metadata;
  if (!parts.ignored.empty()) photo.notes.push_back(parts.ignored);
  ReadExif(&photo);
  CheckProfile(&photo);
  return photo;
}

}  // namespace starfocus
