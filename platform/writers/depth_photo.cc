// SPDX-License-Identifier: Apache-2.0
#include "platform/writers/depth_photo.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "platform/writers/base64.h"
#include "platform/writers/jpeg.h"
#include "platform/writers/jpeg_segments.h"
#include "platform/writers/png.h"

namespace starfocus {
namespace {

constexpr char kNamespaces[] =
    " xmlns:GDepth=\"http://ns.google.com/photos/1.0/depthmap/\""
    " xmlns:GImage=\"http://ns.google.com/photos/1.0/image/\""
    " xmlns:GFocus=\"http://ns.google.com/photos/1.0/focus/\"";

std::string Attribute(const std::string& name, const std::string& value) {
  return " " + name + "=\"" + value + "\"";
}

std::string Attribute(const std::string& name, double value) {
  char text[40];
  std::snprintf(text, sizeof(text), "%.9g", value);
  return Attribute(name, std::string(text));
}

// 0 where it is nearest, 255 where it is farthest.
GreyImage Levels(const FloatMap& map, float low, float high) {
  GreyImage grey = {map.width, map.height, {}};
  grey.levels.reserve(map.values.size());
  const double range = std::max(1e-6, double(high) - low);
  for (const float d : map.values) {
    grey.levels.push_back(static_cast<uint16_t>(std::lround(255 * (double(high) - d) / range)));
  }
  return grey;
}

std::string FocusAttributes(const SharpOriginal& photo, float low) {
  const auto longer = double(std::max(photo.before->width, photo.before->height));
  const double nearness = photo.focus - low + 1;  // one over its distance; infinity is at 0
  return Attribute("GFocus:BlurAtInfinity", photo.aperture * std::fabs(nearness) / longer) +
         Attribute("GFocus:FocalDistance", 1 / std::max(nearness, 1e-3));
}

}  // namespace

std::string EncodeDepthPhoto(const std::string& path, const Image& picture,
                             const SharpOriginal& photo, int quality, const Metadata& metadata,
                             Bytes* jpeg) {
  const std::vector<float>& values = photo.disparity->values;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  Bytes map, before, segments;
  std::string error = EncodeGreyPng(path, Levels(*photo.disparity, *low, *high), &map);
  if (error.empty())
    error = EncodeJpeg(path, *photo.before, quality, {{}, metadata.icc}, {}, &before);
  if (!error.empty()) return error;
  const std::string attributes =
      Attribute("GDepth:Format", "RangeInverse") +
      Attribute("GDepth:Near", 1 / (double(*high) - *low + 1)) + Attribute("GDepth:Far", 1) +
      Attribute("GDepth:Mime", "image/png") + Attribute("GImage:Mime", "image/jpeg") +
      FocusAttributes(photo, *low);
  const std::string extended =
      Attribute("GDepth:Data", EncodeBase64(map)) + Attribute("GImage:Data", EncodeBase64(before));
  // Descriptions that have no room beside those of the map are left out.
  if (!AppendExtendedXmp(kNamespaces, attributes, extended, metadata.xmp, &segments) &&
      !AppendExtendedXmp(kNamespaces, attributes, extended, "", &segments)) {
    return Expected(path, "less than 4 GiB beside the picture", "more");
  }
  Metadata others = metadata;
  others.xmp.clear();  // a file has one packet
  return EncodeJpeg(path, picture, quality, others, segments, jpeg);
}

}  // namespace starfocus
