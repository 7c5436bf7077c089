// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/gdepth.h"

#include "platform/image_io.h"
#include "platform/levels.h"
#include "platform/readers/base64.h"
#include "platform/readers/depth_levels.h"

namespace starfocus {
namespace {

const std::string kDepth = "http://ns.google.com/photos/1.0/depthmap/|";
const std::string kFocus = "http://ns.google.com/photos/1.0/focus/|";
const std::string kImage = "http://ns.google.com/photos/1.0/image/|";

std::string DecodeData(const std::string& where, const std::string& text, Bytes* bytes) {
  if (DecodeBase64(text, bytes) && !bytes->empty()) return "";
  return Expected(where, "a picture in base64", "something else");
}

// How many metres a unit of distance is; 0 for an unknown one.
double MetresOf(const std::string* units) {
  if (units == nullptr) return 0;
  return *units == "m" ? 1 : *units == "mm" ? 0.001 : 0;
}

std::string ReadMap(const std::string& where, const XmpNode& xmp, DepthPhoto* photo) {
  const std::string* data = FindProperty(xmp, kDepth + "Data");
  if (data == nullptr) {
    return Expected(where, "GDepth:Data, the map, in its XMP or extended XMP", "none");
  }
  Bytes bytes;
  std::string error = DecodeData(where + " (GDepth:Data)", *data, &bytes);
  if (error.empty()) error = DecodeLevels(where + " (GDepth:Data)", &bytes, &photo->map);
  DepthRange range;
  const std::string* format = FindProperty(xmp, kDepth + "Format");
  const std::string* near = FindProperty(xmp, kDepth + "Near");
  const std::string* far = FindProperty(xmp, kDepth + "Far");
  if (error.empty()) error = ReadDepthRange(where, format, near, far, &range);
  if (!error.empty()) return error;
  const std::string* units = FindProperty(xmp, kDepth + "Units");
  const double metres = MetresOf(units);
  const double unit = metres > 0 ? metres : 1;
  range.near *= unit;
  range.far *= unit;
  ToInverse(range, &photo->map);
  photo->meaning = metres > 0 ? MapMeaning::kInverseMetres : MapMeaning::kInverse;
  TellMap(*format + " from " + *near + " to " + *far +
              (metres > 0 ? " " + *units : " of unknown units"),
          photo);
  double distance = 0;
  if (ReadXmpNumber(FindProperty(xmp, kFocus + "FocalDistance"), &distance) && distance > 0) {
    photo->focus_value = 1 / (distance * unit);
  }
  const std::string* measure = FindProperty(xmp, kDepth + "MeasureType");
  if (measure != nullptr && *measure == "OpticRay") {
    photo->facts.emplace_back("distances", "along rays, taken for those along the axis");
  }
  return "";
}

// The sharp picture in the place of the one that shows it blurred.
std::string ReadSharp(const std::string& where, const XmpNode& xmp, DepthPhoto* photo) {
  const std::string* data = FindProperty(xmp, kImage + "Data");
  if (data == nullptr) return "";
  Bytes bytes;
  std::string error = DecodeData(where + " (GImage:Data)", *data, &bytes);
  if (error.empty()) error = DecodeImage(where + " (GImage:Data)", &bytes, &photo->picture);
  if (error.empty()) {
    photo->facts.emplace_back("picture", "the sharp one inside (GImage:Data)");
  }
  return error;
}

void ReadFocus(const XmpNode& xmp, DepthPhoto* photo) {
  const std::string* x = FindProperty(xmp, kFocus + "FocalPointX");
  const std::string* y = FindProperty(xmp, kFocus + "FocalPointY");
  photo->has_focus = ReadXmpNumber(x, &photo->focus_x) && ReadXmpNumber(y, &photo->focus_y) &&
                     photo->focus_x >= 0 && photo->focus_x <= 1 && photo->focus_y >= 0 &&
                     photo->focus_y <= 1;
  if (photo->has_focus) {
    photo->facts.emplace_back("focus", "at " + *x + "," + *y + " of width and height");
  } else if (std::isfinite(photo->focus_value)) {
    photo->facts.emplace_back("focus", *FindProperty(xmp, kFocus + "FocalDistance") + " away");
  }
}

}  // namespace

bool HasGdepth(const XmpNode& xmp) {
  return FindProperty(xmp, kDepth + "Format") != nullptr ||
         FindProperty(xmp, kDepth + "Data") != nullptr;
}

std::string ReadGdepth(const std::string& where, Span file, const JpegParts& parts,
                       const XmpNode& xmp, DepthPhoto* photo) {
  photo->format = "GDepth photo (JPEG)";
  std::string error = ReadJpegPicture(where, file, parts, photo);
  if (error.empty()) error = ReadSharp(where, xmp, photo);
  if (error.empty()) error = ReadMap(where, xmp, photo);
  if (error.empty()) ReadFocus(xmp, photo);
  return error;
}

}  // namespace starfocus
