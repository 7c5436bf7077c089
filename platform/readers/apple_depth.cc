// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/apple_depth.h"

#include <algorithm>

#include "platform/levels.h"
#include "platform/readers/depth_levels.h"
#include "platform/readers/multi_picture.h"

namespace starfocus {
namespace {

const std::string kPixels = "http://ns.apple.com/pixeldatainfo/1.0/|";
const std::string kDepth = "http://ns.apple.com/depthData/1.0/|";

std::string TypeOf(const XmpNode& xmp) {
  const std::string* type = FindProperty(xmp, kPixels + "AuxiliaryImageType");
  return type == nullptr ? "" : *type;
}

bool IsMap(const std::string& type) { return type == "disparity" || type == "depth"; }

}  // namespace

std::string UnderstandApple(const std::string& where, const XmpNode& xmp, DepthPhoto* photo) {
  const bool disparity = TypeOf(xmp) != "depth";
  const std::string* low = FindProperty(xmp, kPixels + "FloatMinValue");
  const std::string* high = FindProperty(xmp, kPixels + "FloatMaxValue");
  double from = 0, to = 0;
  if (!ReadXmpNumber(low, &from) || !ReadXmpNumber(high, &to)) {
    TellMap(std::string(disparity ? "disparities" : "depths") + " without a range", photo);
    ToOrder(disparity ? Near::kWhite : Near::kBlack, photo);
    return "";
  }
  if (!(from >= 0) || !(to > from)) {
    return Expected(where, "a depth map from 0 or more to more", *low + " to " + *high);
  }
  ToRange(from, to, &photo->map);
  if (!disparity) Invert(&photo->map);
  const std::string* accuracy = FindProperty(xmp, kDepth + "Accuracy");
  const bool absolute = accuracy != nullptr && *accuracy == "absolute";
  photo->meaning = absolute ? MapMeaning::kInverseMetres : MapMeaning::kInverse;
  TellMap(std::string(disparity ? "disparities" : "depths") + " from " + *low + " to " + *high +
              (disparity ? " per metre, " : " metres, ") +
              (absolute ? "absolute" : "right up to a factor"),
          photo);
  return "";
}

std::string FindAppleMap(const std::string& where, Span file, const JpegParts& parts, Span* map,
                         XmpNode* xmp, bool* gain_map) {
  if (!CanReadXmp()) return "";
  std::vector<Span> pictures;
  std::string error = ListMultiPictures(where, file, parts, &pictures);
  if (!error.empty()) return error;
  for (const Span& picture : pictures) {
    JpegParts inner;
    if (!IsJpeg(picture) || !ReadJpegParts(where, picture, &inner).empty() || inner.xmp.empty()) {
      continue;
    }
    XmpNode root;
    error = ParseXmp(where, reinterpret_cast<const char*>(inner.xmp.data), inner.xmp.size, &root);
    if (!error.empty()) return error;
    const std::string type = TypeOf(root);
    if (type.find("gainmap") != std::string::npos) *gain_map = true;
    if (!IsMap(type) || !map->empty()) continue;
    *map = picture;
    *xmp = std::move(root);
  }
  return "";
}

std::string ReadAppleJpeg(const std::string& where, Span file, const JpegParts& parts, Span map,
                          const XmpNode& xmp, DepthPhoto* photo) {
  photo->format = "Apple depth photo (JPEG)";
  std::string error = ReadJpegPicture(where, file, parts, photo);
  if (!error.empty()) return error;
  Bytes bytes(map.data, map.data + map.size);
  error = DecodeLevels(where + " (auxiliary picture)", &bytes, &photo->map);
  return error.empty() ? UnderstandApple(where, xmp, photo) : error;
}

}  // namespace starfocus
