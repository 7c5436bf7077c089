// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/depth_photo_file.h"

#include "platform/image_io.h"
#include "platform/readers/apple_depth.h"
#include "platform/readers/depth_levels.h"
#include "platform/readers/dynamic_depth.h"
#include "platform/readers/exif.h"
#include "platform/readers/gdepth.h"
#include "platform/readers/heic.h"
#include "platform/readers/pair.h"
#include "platform/readers/profile.h"
#include "platform/readers/xmp.h"

namespace starfocus {
namespace {

constexpr char kGainMap[] = "http://ns.adobe.com/hdr-gain-map/1.0/|Version";
constexpr char kExtendedXmp[] = "http://ns.adobe.com/xmp/note/|HasExtendedXMP";

// Both packets of a JPEG file, the extended one as a child of the other.
std::string ReadXmp(const std::string& where, const JpegParts& parts, XmpNode* root) {
  if (parts.xmp.empty() || !CanReadXmp()) return "";
  std::string error =
      ParseXmp(where, reinterpret_cast<const char*>(parts.xmp.data), parts.xmp.size, root);
  if (!error.empty()) return error;
  const std::string* guid = FindProperty(*root, kExtendedXmp);
  if (guid == nullptr) return "";
  std::string text;
  error = JoinExtensions(where, parts, *guid, &text);
  if (!error.empty()) return error;
  XmpNode extended;
  error = ParseXmp(where, text.data(), text.size(), &extended);
  root->children.push_back(std::move(extended));
  return error;
}

// The picture and what map there is, by the first of the formats that the file has.
std::string DecodeByFormat(const std::string& where, Span file, const JpegParts& parts,
                           const XmpNode& xmp, Near near, DepthPhoto* photo) {
  if (HasGdepth(xmp)) return ReadGdepth(where, file, parts, xmp, photo);
  if (HasDynamicDepth(xmp)) return ReadDynamicDepth(where, file, parts, xmp, near, photo);
  Span map;
  XmpNode apple;
  bool gain_map = false;
  std::string error = FindAppleMap(where, file, parts, &map, &apple, &gain_map);
  if (!error.empty()) return error;
  if (gain_map) photo->facts.emplace_back("gain map", "left out");
  return map.empty() ? ReadJpegPicture(where, file, parts, photo)
                     : ReadAppleJpeg(where, file, parts, map, apple, photo);
}

std::string DecodeJpegPhoto(const std::string& where, Span file, bool with_map, Near near,
                            DepthPhoto* photo) {
  JpegParts parts;
  XmpNode xmp;
  std::string error = ReadJpegParts(where, file, &parts);
  if (!error.empty()) return error;
  if (!with_map) return ReadJpegPicture(where, file, parts, photo);
  error = ReadXmp(where, parts, &xmp);
  if (!error.empty()) return error;
  if (FindProperty(xmp, kGainMap) != nullptr) photo->facts.emplace_back("gain map", "left out");
  return DecodeByFormat(where, file, parts, xmp, near, photo);
}

std::string NoMap(const std::string& path) {
  return Expected(path,
                  "a depth map in the file, beside it as NAME-depth.png or .jpg, or by --depth",
                  CanReadXmp() ? "a picture without one"
                               : "a picture without one that is read (this build has no expat)");
}

}  // namespace

std::string DecodeDepthPhoto(const std::string& where, Span file, bool with_map, Near near,
                             DepthPhoto* photo) {
  if (IsHeif(file)) return ReadHeif(where, file, near, photo);
  if (IsJpeg(file)) return DecodeJpegPhoto(where, file, with_map, near, photo);
  Bytes bytes(file.data, file.data + file.size);
  const std::string error = DecodeImage(where, &bytes, &photo->picture, &photo->metadata);
  if (!error.empty()) return error;
  ReadExif(photo);
  CheckProfile(photo);
  return "";
}

std::string ReadDepthPhotoFile(const std::string& path, std::string* depth, Near near,
                               DepthPhoto* photo) {
  Bytes bytes;
  std::string error = ReadFile(path, &bytes);
  const Span file = {bytes.data(), bytes.size()};
  if (error.empty()) error = DecodeDepthPhoto(path, file, depth->empty(), near, photo);
  if (!error.empty()) return error;
  if (depth->empty() && !photo->map.values.empty()) return "";
  if (depth->empty()) *depth = FindDepthPicture(path);
  return depth->empty() ? NoMap(path) : ReadDepthPicture(*depth, near, photo);
}

}  // namespace starfocus
