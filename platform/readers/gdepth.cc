// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/gdepth.h"

#include <cmath>
#include <utility>

#include "platform/base64.h"
#include "platform/levels.h"
#include "platform/readers/depth_levels.h"
#include "platform/readers/depth_range.h"
#include "platform/readers/original_picture.h"
#include "platform/writers/depth_photo.h"

namespace starfocus {
namespace {

const std::string kDepth = "http://ns.google.com/photos/1.0/depthmap/|";
const std::string kFocus = "http://ns.google.com/photos/1.0/focus/|";
const std::string kImage = "http://ns.google.com/photos/1.0/image/|";

Result<Bytes> DecodeData(const std::string& where, const std::string& text) {
  std::optional<Bytes> bytes = DecodeBase64(text);
  if (bytes && !bytes->empty()) return std::move(*bytes);
  return Expected(where, "a picture in base64", "other data");
}

Error ReadMap(const XmpNode& xmp, Near near, DepthPhoto* photo) {
  const std::string* data = FindProperty(xmp, kDepth + "Data");
  if (data == nullptr) {
    return Expected("GDepth", "the depth map GDepth:Data in XMP or extended XMP", "none");
  }
  const Result<Bytes> bytes = DecodeData("GDepth:Data", *data);
  if (!bytes) return bytes.error();
  if (Error error = DecodeLevels("GDepth:Data", *bytes).MoveTo(&photo->map)) return error;
  const RangeProperties range = {
      FindProperty(xmp, kDepth + "Format"), FindProperty(xmp, kDepth + "Near"),
      FindProperty(xmp, kDepth + "Far"), FindProperty(xmp, kDepth + "Units")};
  const double unit = ApplyRange(range, near, photo);
  const auto distance = XmpNumber(FindProperty(xmp, kFocus + "FocalDistance"));
  if (unit > 0 && distance > 0.0) photo->focus_value = 1 / (*distance * unit);
  const std::string* measure = FindProperty(xmp, kDepth + "MeasureType");
  if (unit > 0 && measure != nullptr && *measure == "OpticRay") {
    photo->facts.emplace_back("distances",
                              "measured along rays, but used as distances along the axis");
  }
  return {};
}

// If starfocus wrote the file, converts the inverse distances back to the original disparities, in
// pixels of photo->picture.
void ReadOwnDisparities(const XmpNode& xmp, DepthPhoto* photo) {
  const std::string own = std::string(kOwnNamespace) + "|";
  const auto low = XmpNumber(FindProperty(xmp, own + kFarDisparity));
  const auto high = XmpNumber(FindProperty(xmp, own + kNearDisparity));
  const auto near = XmpNumber(FindProperty(xmp, kDepth + "Near"));
  const auto far = XmpNumber(FindProperty(xmp, kDepth + "Far"));
  const bool known = low && high && near && far && *low < *high;
  if (!known || photo->meaning != MapMeaning::kInverse) return;
  const double diagonal = std::hypot(photo->picture.width, photo->picture.height);
  const double factor = diagonal * (*high - *low) / (1 / *near - 1 / *far);
  const double zero = diagonal * *low - factor / *far;
  ToRange(zero, zero + factor, &photo->map);
  photo->focus_value = zero + factor * photo->focus_value;
  photo->meaning = MapMeaning::kDisparity;
  photo->is_ready = true;
}

// Replaces the primary picture, which is already blurred, by the sharp picture in the XMP.
void ReadSharp(const XmpNode& xmp, DepthPhoto* photo) {
  const std::string* data = FindProperty(xmp, kImage + "Data");
  if (data == nullptr) return;
  const Result<Bytes> bytes = DecodeData("GImage:Data", *data);
  if (bytes) return TakeOriginal("GImage:Data", {bytes->data(), bytes->size()}, photo);
  photo->notes.push_back("the sharp picture in the file is ignored: " + bytes.error().line());
}

void ReadFocus(const XmpNode& xmp, DepthPhoto* photo) {
  const std::string* x_text = FindProperty(xmp, kFocus + "FocalPointX");
  const std::string* y_text = FindProperty(xmp, kFocus + "FocalPointY");
  const auto x = XmpNumber(x_text), y = XmpNumber(y_text);
  photo->has_focus = x && y && *x >= 0 && *x <= 1 && *y >= 0 && *y <= 1;
  if (photo->has_focus) {
    photo->focus_x = *x;
    photo->focus_y = *y;
    photo->facts.emplace_back(
        "focus", "at " + *x_text + "," + *y_text + ", as fractions of width and height");
  } else if (std::isfinite(photo->focus_value)) {
    photo->facts.emplace_back("focus", *FindProperty(xmp, kFocus + "FocalDistance") + " away");
  }
}

}  // namespace

bool HasGdepth(const XmpNode& xmp) {
  return FindProperty(xmp, kDepth + "Format") != nullptr ||
         FindProperty(xmp, kDepth + "Data") != nullptr;
}

Error ReadGdepth(const XmpNode& xmp, Near near, DepthPhoto* photo) {
  if (Error error = ReadMap(xmp, near, photo)) return error;
  photo->format = "GDepth photo (JPEG)";
  ReadSharp(xmp, photo);
  ReadOwnDisparities(xmp, photo);
  ReadFocus(xmp, photo);
  return {};
}

}  // namespace starfocus
