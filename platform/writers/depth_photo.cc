// SPDX-License-Identifier: Apache-2.0
#include "platform/writers/depth_photo.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "platform/base64.h"
#include "platform/writers/jpeg.h"
#include "platform/writers/jpeg_segments.h"
#include "platform/writers/png.h"
#include "starfocus/starfocus.h"

namespace starfocus {
namespace {

const std::string kNamespaces =
    " xmlns:GDepth=\"http://ns.google.com/photos/1.0/depthmap/\""
    " xmlns:GImage=\"http://ns.google.com/photos/1.0/image/\""
    " xmlns:GFocus=\"http://ns.google.com/photos/1.0/focus/\""
    " xmlns:Starfocus=\"" +
    std::string(kOwnNamespace) + "\"";

std::string Attribute(const std::string& name, const std::string& value) {
  return " " + name + "=\"" + value + "\"";
}

std::string Attribute(const std::string& name, double value) {
  char text[40];
  std::snprintf(text, sizeof(text), "%.9g", value);
  return Attribute(name, std::string(text));
}

// Range of the disparities of a map. If all disparities of the map are equal, extends the range,
// because readers require near < far.
struct Range {
  double low, high;

  explicit Range(const FloatMap& map) {
    const auto [least, most] = std::minmax_element(map.values.begin(), map.values.end());
    high = double(*most);
    low = std::min(double(*least), high - 1e-3);
  }
};

// Converts disparities to grey levels, from 0 for the nearest disparity to 255 for the farthest.
GreyImage Levels(const FloatMap& map, const Range& range) {
  GreyImage grey = {map.width, map.height, {}};
  grey.levels.reserve(map.values.size());
  for (const float d : map.values) {
    const double level = 255 * (range.high - double(d)) / (range.high - range.low);
    grey.levels.push_back(static_cast<uint16_t>(level + 0.5));
  }
  return grey;
}

// Returns the attributes NearDisparity and FarDisparity. If a disparity for a lens of f/1 is
// outside
// +-STARFOCUS_MAX_DISPARITY, all disparities are shifted into this range. A shift of all
// disparities has no effect on the blur.
Result<std::string> OwnAttributes(const std::string& path, const SharpOriginal& photo,
                                  const Range& range) {
  double near = photo.widest * range.high, far = photo.widest * range.low;
  const double moved =
      std::clamp(0.0, -STARFOCUS_MAX_DISPARITY - far,
                 std::max(-STARFOCUS_MAX_DISPARITY - far, STARFOCUS_MAX_DISPARITY - near));
  near += moved;
  far += moved;
  if (near > STARFOCUS_MAX_DISPARITY) {
    return Expected(path, "a disparity range of at most 1000 pixels at f/1",
                    std::to_string(near - far));
  }
  const double diagonal = std::hypot(photo.before->width, photo.before->height);
  return Attribute(std::string("Starfocus:") + kNearDisparity, near / diagonal) +
         Attribute(std::string("Starfocus:") + kFarDisparity, far / diagonal);
}

std::string FocusAttributes(const SharpOriginal& photo, double low) {
  const auto longer = double(std::max(photo.before->width, photo.before->height));
  const double nearness = photo.focus - low + 1;  // 1 / distance; 0 at infinity
  return Attribute("GFocus:BlurAtInfinity", photo.aperture * std::fabs(nearness) / longer) +
         Attribute("GFocus:FocalDistance", 1 / std::max(nearness, 1e-3));
}

}  // namespace

Result<Bytes> EncodeDepthPhoto(const std::string& path, const Image& picture,
                               const SharpOriginal& photo, int quality, const Metadata& metadata) {
  const Range range(*photo.disparity);
  const Result<std::string> own = OwnAttributes(path, photo, range);
  if (!own) return own.error();
  const Result<Bytes> map = EncodeGreyPng(path, Levels(*photo.disparity, range));
  if (!map) return map;
  const Result<Bytes> before = EncodeJpeg(path, *photo.before, quality, {{}, metadata.icc}, {});
  if (!before) return before;
  const std::string attributes =
      Attribute("GDepth:Format", "RangeInverse") +
      Attribute("GDepth:Near", 1 / (range.high - range.low + 1)) + Attribute("GDepth:Far", 1) +
      Attribute("GDepth:Mime", "image/png") + Attribute("GImage:Mime", "image/jpeg") +
      FocusAttributes(photo, range.low) + *own;
  const std::string extended = Attribute("GDepth:Data", EncodeBase64(*map)) +
                               Attribute("GImage:Data", EncodeBase64(*before));
  Bytes segments;
  // Omit the rdf:Descriptions of `metadata` if they do not fit into the XMP packet of the map.
  if (!AppendExtendedXmp(kNamespaces, attributes, extended, metadata.xmp, &segments) &&
      !AppendExtendedXmp(kNamespaces, attributes, extended, "", &segments)) {
    return Expected(path, "a depth map and a sharp picture of less than 4 GiB", "more");
  }
  Metadata others = metadata;
  others.xmp.clear();  // a JPEG file may have only one XMP packet
  return EncodeJpeg(path, picture, quality, others, segments);
}

}  // namespace starfocus
