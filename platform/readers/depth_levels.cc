// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/depth_levels.h"

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

void ToOrder(Near near, DepthPhoto* photo) {
  photo->guesses_near = near == Near::kUnknown;
  if (near == Near::kBlack) ToRange(1, 0, &photo->map);
  if (near == Near::kWhite) Forget(HUGE_VALF, &photo->map);
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
  ChooseProfile(&photo);
  return photo;
}

}  // namespace starfocus
