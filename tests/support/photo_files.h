// SPDX-License-Identifier: Apache-2.0
// Writes depth photos byte by byte, as defined in the public specifications of the formats, and
// portraits of phones: JPEG files with an original, a depth map, a confidence map, a gain map and a
// video behind the picture. Tests use these files, and fuzz targets use them as seeds.
#ifndef STARFOCUS_TESTS_SUPPORT_PHOTO_FILES_H_
#define STARFOCUS_TESTS_SUPPORT_PHOTO_FILES_H_

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "platform/base64.h"
#include "platform/image_io.h"
#include "tests/support/error_line.h"
#include "tests/support/temp_folder.h"

namespace starfocus::photos {

inline void Require(const Error& error) {
  if (error) throw std::runtime_error(error.line());
}

// Returns the bytes of a file that holds the picture in the format of `extension`.
inline std::string Encode(const Image& image, const std::string& extension) {
  TempFolder folder;
  Require(WriteImage(folder.file("picture" + extension), image));
  const Bytes bytes = ValueOf(ReadFile(folder.file("picture" + extension)));
  return {bytes.begin(), bytes.end()};
}

inline Image Plain(int width, int height, int level) {
  Image image(width, height);
  std::fill(image.pixels.begin(), image.pixels.end(), static_cast<uint8_t>(level));
  return image;
}

// Returns a grey picture with levels from 0 on the left to 255 on the right.
inline Image Ramp(int width, int height) {
  Image image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int k = 0; k < 3 * width; ++k) {
      image.row(y)[k] = static_cast<uint8_t>(k / 3 * 255 / std::max(1, width - 1));
    }
  }
  return image;
}

// Returns random pixels.
inline Image Noise(int width, int height) {
  Image image(width, height);
  uint32_t seed = 1;
  for (uint8_t& value : image.pixels) {
    seed = seed * 1664525 + 1013904223;
    value = static_cast<uint8_t>(seed >> 24);
  }
  return image;
}

inline std::string Big(uint32_t value, int bytes) {
  std::string text;
  for (int k = bytes - 1; k >= 0; --k) text += static_cast<char>(value >> 8 * k);
  return text;
}

inline uint32_t Crc(const std::string& bytes) {
  uint32_t crc = 0xffffffffu;
  for (const char byte : bytes) {
    crc ^= static_cast<uint8_t>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc % 2 == 0 ? 0 : 0xedb88320u);
  }
  return ~crc;
}

// Returns a chunk of a PNG file.
inline std::string Chunk(const std::string& type, const std::string& content) {
  return Big(static_cast<uint32_t>(content.size()), 4) + type + content +
         Big(Crc(type + content), 4);
}

// Sample format of a PNG file, and additional chunks before the samples.
struct PngKind {
  int depth = 8, colour = 0;
  std::string more = {};
};

// Returns a PNG file with uncompressed rows of samples (PNG specification; RFC 1950 and 1951).
inline std::string Png(uint32_t width, uint32_t height, const PngKind& kind,
                       const std::string& samples, size_t row) {
  std::string data;
  for (size_t at = 0; at < samples.size(); at += row) data += '\0' + samples.substr(at, row);
  uint32_t low = 1, high = 0;
  for (const char byte : data) {
    low = (low + static_cast<uint8_t>(byte)) % 65521;
    high = (high + low) % 65521;
  }
  const auto size = static_cast<uint32_t>(data.size());
  std::string packed = "\x78\x01\x01";
  for (const uint32_t length : {size, ~size}) {
    packed += static_cast<char>(length);
    packed += static_cast<char>(length >> 8);
  }
  packed += data + Big(high << 16 | low, 4);
  const std::string header = Big(width, 4) + Big(height, 4) + static_cast<char>(kind.depth) +
                             static_cast<char>(kind.colour) + std::string(3, '\0');
  return "\x89PNG\r\n\x1a\n" + Chunk("IHDR", header) + kind.more + Chunk("IDAT", packed) +
         Chunk("IEND", "");
}

// Returns a grey PNG file with 16 bits per sample.
inline std::string Png16(int width, int height, const std::vector<uint16_t>& levels) {
  std::string samples;
  for (const uint16_t level : levels) samples += Big(level, 2);
  return Png(uint32_t(width), uint32_t(height), {16}, samples, 2 * size_t(width));
}

inline std::string Base64(const std::string& bytes) {
  return EncodeBase64({bytes.begin(), bytes.end()});
}

// Returns a segment of a JPEG file.
inline std::string Segment(int marker, const std::string& content) {
  return std::string("\xff") + static_cast<char>(marker) +
         Big(static_cast<uint32_t>(content.size() + 2), 2) + content;
}

// Inserts segments after the first two bytes of a JPEG file.
inline std::string Insert(const std::string& jpeg, const std::string& segments) {
  return jpeg.substr(0, 2) + segments + jpeg.substr(2);
}

inline std::string Packet(const std::string& namespaces, const std::string& attributes,
                          const std::string& inside = "") {
  return "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\"><rdf:RDF "
         "xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\"><rdf:Description " +
         namespaces + " " + attributes + ">" + inside + "</rdf:Description></rdf:RDF></x:xmpmeta>";
}

inline std::string XmpSegment(const std::string& packet) {
  return Segment(0xe1, std::string("http://ns.adobe.com/xap/1.0/") + '\0' + packet);
}

constexpr char kGuid[] = "0123456789ABCDEF0123456789ABCDEF";

// Returns extended XMP, divided into JPEG segments of `part` bytes of text.
inline std::vector<std::string> ExtensionSegments(const std::string& text, size_t part) {
  std::vector<std::string> segments;
  for (size_t at = 0; at < text.size(); at += part) {
    segments.push_back(Segment(0xe1, std::string("http://ns.adobe.com/xmp/extension/") + '\0' +
                                         kGuid + Big(static_cast<uint32_t>(text.size()), 4) +
                                         Big(static_cast<uint32_t>(at), 4) +
                                         text.substr(at, part)));
  }
  return segments;
}

inline std::string Joined(const std::vector<std::string>& parts) {
  std::string all;
  for (const std::string& part : parts) all += part;
  return all;
}

constexpr char kGoogle[] =
    "xmlns:GDepth=\"http://ns.google.com/photos/1.0/depthmap/\" "
    "xmlns:GFocus=\"http://ns.google.com/photos/1.0/focus/\" "
    "xmlns:GImage=\"http://ns.google.com/photos/1.0/image/\" "
    "xmlns:xmpNote=\"http://ns.adobe.com/xmp/note/\"";

// Returns a photo with Google's GDepth metadata: `attributes` are in the XMP packet, and the data
// are in extended XMP.
inline std::string Gdepth(const std::string& jpeg, const std::string& attributes,
                          const std::string& extended, size_t part = 60000) {
  const std::string main =
      Packet(kGoogle, std::string("xmpNote:HasExtendedXMP=\"") + kGuid + "\" " + attributes);
  const std::string text = Packet(kGoogle, extended);
  return Insert(jpeg, XmpSegment(main) + Joined(ExtensionSegments(text, part)));
}

// Returns a segment of big-endian EXIF with an orientation, a focal length and the value of
// CustomRendered (EXIF 2.32, 4.6).
inline std::string ExifSegment(int orientation, int focal_35mm, int rendered = 0) {
  const auto entry = [](int tag, int type, uint32_t value) {
    return Big(static_cast<uint32_t>(tag), 2) + Big(static_cast<uint32_t>(type), 2) + Big(1, 4) +
           (type == 3 ? Big(value, 2) + Big(0, 2) : Big(value, 4));
  };
  const std::string first = Big(2, 2) + entry(0x0112, 3, static_cast<uint32_t>(orientation)) +
                            entry(0x8769, 4, 8 + 2 + 24 + 4) + Big(0, 4);
  const std::string second = Big(2, 2) + entry(0xa401, 3, static_cast<uint32_t>(rendered)) +
                             entry(0xa405, 3, static_cast<uint32_t>(focal_35mm)) + Big(0, 4);
  return Segment(0xe1, std::string("Exif\0\0MM\0\x2a\0\0\0\x08", 14) + first + second);
}

// Returns a segment of little-endian EXIF with an orientation and a subject of two to four numbers
// (EXIF 2.32, 4.6). If `width` is not 0, the EXIF includes the size of the picture that the subject
// refers to.
inline std::string SubjectSegment(int orientation, int tag, const std::vector<int>& subject,
                                  int width = 0, int height = 0) {
  const auto little = [](int value, int bytes) {
    std::string text;
    for (int k = 0; k < bytes; ++k) text += static_cast<char>(value >> 8 * k);
    return text;
  };
  const auto entry = [&](int its_tag, int type, int count, const std::string& value) {
    return little(its_tag, 2) + little(type, 2) + little(count, 4) + value;
  };
  std::string numbers;
  for (const int number : subject) numbers += little(number, 2);
  const bool inside = numbers.size() <= 4, sized = width > 0;
  const int exif = 8 + 2 + 24 + 4, behind = exif + 2 + (sized ? 36 : 12) + 4;
  const std::string its =
      entry(tag, 3, static_cast<int>(subject.size()), inside ? numbers : little(behind, 4));
  const std::string sizes =
      sized ? entry(0xa002, 4, 1, little(width, 4)) + entry(0xa003, 4, 1, little(height, 4)) : "";
  // EXIF tags must be in ascending order: SubjectArea precedes the picture size, and
  // SubjectLocation follows the picture size.
  std::string text = std::string("Exif\0\0II\x2a\0\x08\0\0\0", 14) + little(2, 2) +
                     entry(0x0112, 3, 1, little(orientation, 4)) +
                     entry(0x8769, 4, 1, little(exif, 4)) + little(0, 4);
  text += little(sized ? 3 : 1, 2) + (tag < 0xa002 ? its + sizes : sizes + its) + little(0, 4);
  return Segment(0xe1, inside ? text : text + numbers);
}

// Options for the index of a multi-picture file; options may make the index invalid.
struct IndexOptions {
  bool little = false;        // True for little-endian numbers.
  uint32_t entry_bytes = 32;  // Declared size of all index entries.
  uint32_t moved = 0;         // Error added to the position of the second picture.
  uint32_t type = 0;          // Type of the second picture.
};

// Returns a multi-picture file of two pictures. The index is in an APP2 segment of the first
// picture (CIPA DC-007, 5.2).
inline std::string MultiPicture(const std::string& first, const std::string& second,
                                const IndexOptions& options = {}) {
  const auto number = [&](uint32_t value, int bytes) {
    std::string text = Big(value, bytes);
    if (options.little) std::reverse(text.begin(), text.end());
    return text;
  };
  const auto index = [&](uint32_t size, uint32_t offset) {
    const std::string entries = number(0x030000, 4) + number(size, 4) + number(0, 4) +
                                number(0, 4) + number(options.type, 4) +
                                number(static_cast<uint32_t>(second.size()), 4) +
                                number(offset, 4) + number(0, 4);
    const std::string directory = number(1, 2) + number(0xb002, 2) + number(7, 2) +
                                  number(options.entry_bytes, 4) + number(8 + 2 + 12 + 4, 4) +
                                  number(0, 4);
    return Segment(0xe2, std::string("MPF\0", 4) + (options.little ? "II" : "MM") + number(42, 2) +
                             number(8, 4) + directory + entries);
  };
  // Offsets count from the TIFF header at byte 10, after 2 bytes of picture, 4 bytes of segment
  // header and 4 bytes of "MPF".
  const auto size = static_cast<uint32_t>(Insert(first, index(0, 0)).size());
  return Insert(first, index(size, size - 10 + options.moved)) + second;
}

// Returns the JPEG segments of an ICC profile that is divided into `parts` parts (ICC.1, annex
// B.4).
inline std::vector<std::string> ProfileSegments(const std::string& icc, size_t parts) {
  std::vector<std::string> segments;
  const size_t size = (icc.size() + parts - 1) / parts;
  for (size_t k = 0; k < parts; ++k) {
    segments.push_back(Segment(0xe2, std::string("ICC_PROFILE\0", 12) + static_cast<char>(k + 1) +
                                         static_cast<char>(parts) + icc.substr(k * size, size)));
  }
  return segments;
}

// Returns an ICC profile without tags, for RGB or another colour space (ICC.1, 7.2).
inline std::string Profile(size_t size, const std::string& space = "RGB ") {
  std::string icc(size, '\0');
  icc.replace(0, 4, Big(static_cast<uint32_t>(size), 4));
  icc[8] = 4;
  icc.replace(12, 12, "mntr" + space + "XYZ ");
  icc.replace(36, 4, "acsp");
  icc.replace(68, 12, std::string("\0\0\xf6\xd6\0\1\0\0\0\0\xd3\x2d", 12));
  for (size_t k = 132; k < size; ++k) icc[k] = static_cast<char>(k % 251);
  return icc;
}

// Returns a Photoshop segment with a resource that readers must skip, followed by IPTC records.
inline std::string IptcSegment(const std::string& records) {
  const std::string even = records.size() % 2 == 0 ? records : records + '\0';
  return Segment(0xed, std::string("Photoshop 3.0\0", 14) + "8BIM" + Big(0x03ed, 2) +
                           std::string("\3abc") + Big(3, 4) + "xyz" + '\0' + "8BIM" +
                           Big(0x0404, 2) + std::string(2, '\0') +
                           Big(static_cast<uint32_t>(records.size()), 4) + even);
}

constexpr char kDynamic[] =
    "xmlns:Device=\"http://ns.google.com/photos/dd/1.0/device/\" "
    "xmlns:Camera=\"http://ns.google.com/photos/dd/1.0/camera/\" "
    "xmlns:DepthMap=\"http://ns.google.com/photos/dd/1.0/depthmap/\" "
    "xmlns:Container=\"http://ns.google.com/photos/dd/1.0/container/\" "
    "xmlns:Item=\"http://ns.google.com/photos/dd/1.0/item/\"";

// Returns one item of a Dynamic Depth container.
inline std::string ContainerItem(const std::string& mime, size_t length, const std::string& uri) {
  return "<rdf:li rdf:parseType=\"Resource\"><Container:Item Item:Mime=\"" + mime +
         "\" Item:Length=\"" + std::to_string(length) + "\" Item:DataURI=\"" + uri +
         "\"/></rdf:li>";
}

// Returns a Dynamic Depth 1.0 file: a picture, another item, and the map. `wrong` is added to
// the declared lengths of the items.
inline std::string DynamicDepth(const std::string& jpeg, const std::string& map,
                                const std::string& attributes, size_t wrong = 0) {
  const std::string other = "a confidence map would stand here";
  const std::string inside =
      "<Device:Container rdf:parseType=\"Resource\"><Container:Directory><rdf:Seq>" +
      ContainerItem("image/jpeg", 0, "primary_image") +
      ContainerItem("image/jpeg", other.size() + wrong, "other") +
      ContainerItem("image/png", map.size() + wrong, "android/depthmap") +
      "</rdf:Seq></Container:Directory></Device:Container>"
      "<Device:Cameras><rdf:Seq><rdf:li rdf:parseType=\"Resource\"><Device:Camera "
      "rdf:parseType=\"Resource\"><Camera:DepthMap DepthMap:ItemSemantic=\"Depth\" "
      "DepthMap:DepthURI=\"android/depthmap\" " +
      attributes + "/></Device:Camera></rdf:li></rdf:Seq></Device:Cameras>";
  return Insert(jpeg, XmpSegment(Packet(kDynamic, "", inside))) + other + map;
}

constexpr char kApple[] =
    "xmlns:apdi=\"http://ns.apple.com/pixeldatainfo/1.0/\" "
    "xmlns:depthData=\"http://ns.apple.com/depthData/1.0/\"";

// Returns an auxiliary picture of disparities with the given XMP elements, as Apple's cameras write
// such pictures.
inline std::string AppleMap(const std::string& jpeg, const std::string& elements) {
  return Insert(jpeg, XmpSegment(Packet(kApple, "", elements)));
}

inline void Write(const std::string& path, const std::string& bytes) {
  Require(WriteFile(path, Bytes(bytes.begin(), bytes.end())));
}

}  // namespace starfocus::photos

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

#endif  // STARFOCUS_TESTS_SUPPORT_PHOTO_FILES_H_
