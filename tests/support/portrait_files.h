// SPDX-License-Identifier: Apache-2.0
// Writes portraits of phones: JPEG files with an original, a depth map, a confidence map, a gain
// map and a video behind the picture. Tests use these files, and fuzz targets use them as seeds.
#ifndef STARFOCUS_TESTS_SUPPORT_PORTRAIT_FILES_H_
#define STARFOCUS_TESTS_SUPPORT_PORTRAIT_FILES_H_

#include <string>
#include <vector>

#include "tests/support/photo_files.h"

namespace starfocus::photos {

constexpr int kOriginalLevel = 200;  // level of the original

constexpr char kPortraitNames[] =
    "xmlns:Camera=\"http://ns.google.com/photos/dd/1.0/camera/\" "
    "xmlns:DepthMap=\"http://ns.google.com/photos/dd/1.0/depthmap/\" "
    "xmlns:Image=\"http://ns.google.com/photos/dd/1.0/image/\" "
    "xmlns:Old=\"http://ns.google.com/photos/dd/1.0/item/\" "
    "xmlns:Item=\"http://ns.google.com/photos/1.0/container/item/\" "
    "xmlns:GCamera=\"http://ns.google.com/photos/1.0/camera/\"";

// A part of a portrait that follows the blurred picture.
struct Part {
  std::string semantic, uri, bytes, mime = "image/jpeg";
};

enum class Lengths { kRight, kMissing, kWrong };
enum class Directories {
  kBoth,     // Dynamic Depth lists original, depth and confidence; the later directory the others.
  kLater,    // The later directory lists everything by its semantics.
  kRepeated  // Both directories list everything.
};

inline std::string GainMapXmp() {
  return XmpSegment(Packet("xmlns:hdrgm=\"http://ns.adobe.com/hdr-gain-map/1.0/\"",
                           "hdrgm:Version=\"1.0\" hdrgm:GainMapMax=\"2.5\""));
}

// Returns a video whose data contain the start of a JPEG file.
inline std::string Video(const std::string& jpeg) {
  return Big(16, 4) + "ftypisom" + Big(0, 4) + Big(60, 4) + "mdat" + jpeg.substr(0, 52);
}

// Returns all parts of a portrait whose picture has the given size. The depth map is a ramp.
inline std::vector<Part> PortraitParts(int width, int height) {
  const std::string original = Encode(Plain(width, height, kOriginalLevel), ".jpg");
  return {
      {"GainMap", "gainmap", Insert(Encode(Ramp(width / 2, height / 2), ".jpg"), GainMapXmp())},
      {"Original", "android/original_image", original},
      {"Depth", "android/depthmap", Encode(Ramp(width, height), ".jpg")},
      {"Confidence", "android/confidencemap", Encode(Plain(width, height, 255), ".jpg")},
      {"MotionPhoto", "video", Video(original), "video/mp4"},
  };
}

inline std::string ItemXml(const std::string& prefix, const Part& part, Lengths lengths,
                           size_t padding) {
  std::string text = "<rdf:li rdf:parseType=\"Resource\"><Item:Item " + prefix + ":Mime=\"" +
                     part.mime + "\" " + prefix + ":Semantic=\"" + part.semantic + "\" " + prefix +
                     ":DataURI=\"" + part.uri + "\"";
  const size_t length = part.bytes.size() + (lengths == Lengths::kWrong ? 3 : 0);
  if (lengths != Lengths::kMissing && part.semantic != "Primary") {
    text += " " + prefix + ":Length=\"" + std::to_string(length) + "\"";
  }
  if (padding > 0) text += " " + prefix + ":Padding=\"" + std::to_string(padding) + "\"";
  return text + "/></rdf:li>";
}

// Returns a portrait: the picture `blurred` and the given parts in the given order, each followed
// by `padding` bytes.
inline std::string Portrait(const std::string& blurred, const std::vector<Part>& parts,
                            Directories directories, Lengths lengths, size_t padding = 0) {
  const Part primary = {"Primary", "primary_image", ""};
  std::string old = ItemXml("Old", primary, lengths, 0),
              later = ItemXml("Item", primary, lengths, 0);
  for (const Part& part : parts) {
    const bool is_old =
        part.semantic == "Original" || part.semantic == "Depth" || part.semantic == "Confidence";
    if (directories != Directories::kBoth || !is_old) {
      later += ItemXml("Item", part, lengths, padding);
    }
    if (directories == Directories::kRepeated || (directories == Directories::kBoth && is_old)) {
      old += ItemXml("Old", part, lengths, padding);
    }
  }
  const std::string map =
      "<Camera:DepthMap DepthMap:ItemSemantic=\"Depth\" DepthMap:Format=\"RangeInverse\" "
      "DepthMap:Near=\"0.5\" DepthMap:Far=\"4\" DepthMap:DepthURI=\"android/depthmap\"/>";
  std::string inside = later + map;
  if (directories != Directories::kLater) inside = old + later + map;
  std::string file = Insert(
      blurred, XmpSegment(Packet(kPortraitNames, "GCamera:SpecialTypeID=\"PORTRAIT\"", inside)));
  for (const Part& part : parts) file += part.bytes + std::string(padding, 'x');
  return file;
}

}  // namespace starfocus::photos

#endif  // STARFOCUS_TESTS_SUPPORT_PORTRAIT_FILES_H_
