// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/gain_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>

#include "platform/container.h"
#include "platform/decoders/jpeg.h"
#include "platform/readers/apple_gain_map.h"
#include "platform/text.h"

namespace starfocus {
namespace {

constexpr char kWhere[] = "the gain map";
const std::string kHdrgm = "http://ns.adobe.com/hdr-gain-map/1.0/|";

using Colours = std::array<double, 3>;

Error IsBrighter() {
  return Expected(kWhere, "a base picture that is darker than the other picture", "a brighter one");
}

// Returns a number, or NaN if the text is not a number.
double NumberOf(const std::string& text) { return ParseNumber(text).value_or(NAN); }

// Appends the numbers of a list: an element without children is a number.
void ListNumbers(const XmpNode& node, std::vector<double>* numbers) {
  if (node.children.empty()) numbers->push_back(NumberOf(node.text));
  for (const XmpNode& child : node.children) ListNumbers(child, numbers);
}

// Returns the numbers of the first property `name`: one, or the elements of its list. The result is
// empty if the property is absent.
std::vector<double> NumbersOf(const XmpNode& node, const std::string& name) {
  std::vector<double> numbers;
  const auto attribute = node.attributes.find(name);
  if (attribute != node.attributes.end()) return {NumberOf(attribute->second)};
  for (size_t k = 0; k < node.children.size() && numbers.empty(); ++k) {
    const XmpNode& child = node.children[k];
    if (child.name == name) {
      ListNumbers(child, &numbers);
    } else {
      numbers = NumbersOf(child, name);
    }
  }
  return numbers;
}

// Sets `colours` to a property of one or three numbers. Keeps the default if the property is
// absent, and sets NaN if it has another number of numbers.
void ReadColours(const XmpNode& xmp, const char* name, Colours* colours) {
  const std::vector<double> numbers = NumbersOf(xmp, kHdrgm + name);
  if (numbers.empty()) return;
  for (size_t c = 0; c < colours->size(); ++c) {
    (*colours)[c] = numbers.size() == 1   ? numbers[0]
                    : numbers.size() == 3 ? numbers[c]
                                          : static_cast<double>(NAN);
  }
}

// Reads big-endian fractions. After the end of the bytes, fractions are NaN.
struct Fractions {
  Span bytes;
  size_t at = 0;
  uint32_t common = 0;  // Denominator of all fractions; 0: each fraction has its own.

  uint32_t Take(size_t size) {
    if (size > bytes.size - at) {
      is_cut = true;
      return 0;
    }
    uint32_t value = 0;
    for (size_t k = 0; k < size; ++k) value = value << 8 | bytes.data[at++];
    return value;
  }
  double Fraction(bool is_signed) {
    const uint32_t whole = Take(4);
    const uint32_t divisor = common != 0 ? common : Take(4);
    if (is_cut || divisor == 0) return static_cast<double>(NAN);
    // The conversion to a signed integer is that of the two's complement.
    const double value = is_signed && whole >> 31 != 0 ? double(whole) - 0x1p32 : double(whole);
    return value / double(divisor);
  }

  bool is_cut = false;  // True if a read extended past the end.
};

// Parses the XMP packets of a gain map. Skips packets that are not well-formed.
XmpNode PacketsOf(const std::vector<Span>& packets) {
  XmpNode root;
  if (!CanReadXmp()) return root;
  for (const Span& packet : packets) {
    Result<XmpNode> node =
        ParseXmp(kWhere, reinterpret_cast<const char*>(packet.data), packet.size);
    if (node) root.children.push_back(std::move(*node));
  }
  return root;
}

// Stores the samples of a decoded picture as levels. A picture without colours is stored as one
// channel.
void StorePicture(const Image& picture, GainMap* map) {
  const std::vector<uint8_t>& pixels = picture.pixels;
  bool is_grey = true;
  for (size_t k = 0; k < pixels.size() && is_grey; k += 3) {
    is_grey = pixels[k] == pixels[k + 1] && pixels[k] == pixels[k + 2];
  }
  map->width = picture.width;
  map->height = picture.height;
  map->channels = is_grey ? 1 : 3;
  map->levels.clear();
  map->levels.reserve(pixels.size() / (is_grey ? 3 : 1));
  for (size_t k = 0; k < pixels.size(); k += is_grey ? 3 : 1) {
    map->levels.push_back(static_cast<uint16_t>(257 * pixels[k]));
  }
}

// Reads the metadata of a gain map that is not Apple's.
Error ReadMetadata(const JpegParts& parts, const XmpNode& xmp, GainMap* map) {
  const bool has_xmp = !NumbersOf(xmp, kHdrgm + "GainMapMax").empty();
  Error error = Expected(kWhere, "metadata by ISO 21496-1 or XMP", "neither");
  if (!parts.iso_gain_map.empty()) error = ReadGainMapIso(parts.iso_gain_map, map);
  if (!error || !has_xmp) return error;
  *map = {};
  return ReadGainMapXmp(xmp, map);
}

Result<GainMap> Read(const AppendedPicture& picture, const Bytes& exif) {
  const XmpNode xmp = PacketsOf(picture.parts.xmp);
  GainMap map;
  const Error error = ReadMetadata(picture.parts, xmp, &map);
  const bool is_apple = error && IsAppleGainMap(xmp);
  if (error && !is_apple) return error;
  const Span file = picture.file;
  const Result<Image> decoded = DecodeJpeg(kWhere, Bytes(file.data, file.data + file.size));
  if (!decoded) return decoded.error();
  StorePicture(*decoded, &map);
  if (is_apple) ToStops(AppleHeadroom(xmp, exif), &map);
  return map;
}

// Sets photo->gain_map to a map with parameters, unless it is invalid, larger than photo->picture
// or of another shape.
Error Take(GainMap map, DepthPhoto* photo) {
  const Image& picture = photo->picture;
  if (Error error = CheckGainMap(kWhere, map)) return error;
  // Sizes of maps are rounded: the sides may differ by two levels from those of the picture's
  // shape.
  const int64_t skew =
      std::llabs(int64_t{map.width} * picture.height - int64_t{map.height} * picture.width);
  const bool has_shape = skew <= int64_t{2} * std::max(picture.width, picture.height);
  if (!has_shape || map.width > picture.width || map.height > picture.height) {
    return Expected(kWhere, "the shape of a picture of " + SizeText(picture.width, picture.height),
                    SizeText(map.width, map.height));
  }
  photo->gain_map = std::move(map);
  return {};
}

}  // namespace

Error ReadGainMapXmp(const XmpNode& xmp, GainMap* map) {
  const std::string* brighter = FindProperty(xmp, kHdrgm + "BaseRenditionIsHDR");
  if (brighter != nullptr && Lower(*brighter) == "true") return IsBrighter();
  if (NumbersOf(xmp, kHdrgm + "GainMapMax").empty()) {
    return Expected(kWhere, "the property hdrgm:GainMapMax", "none");
  }
  ReadColours(xmp, "GainMapMin", &map->min);
  ReadColours(xmp, "GainMapMax", &map->max);
  ReadColours(xmp, "Gamma", &map->gamma);
  ReadColours(xmp, "OffsetSDR", &map->offset_sdr);
  ReadColours(xmp, "OffsetHDR", &map->offset_hdr);
  const double most = *std::max_element(map->max.begin(), map->max.end());
  map->capacity_min = XmpNumber(FindProperty(xmp, kHdrgm + "HDRCapacityMin")).value_or(0);
  map->capacity_max = XmpNumber(FindProperty(xmp, kHdrgm + "HDRCapacityMax")).value_or(most);
  map->format = "XMP";
  return CheckGainMap(kWhere, *map);
}

Error ReadGainMapIso(Span metadata, GainMap* map) {
  constexpr uint32_t kThreeChannels = 0x80, kBasePrimaries = 0x40, kIsBrighter = 0x04,
                     kCommonDivisor = 0x08;  // bits of the flags; libultrahdr writes the last two
  Fractions fractions = {metadata};
  const uint32_t version = fractions.Take(2);  // smallest version that a reader must support
  fractions.Take(2);                           // version of the writer
  const uint32_t flags = fractions.Take(1);
  if (version != 0) return Expected(kWhere, "version 0 of ISO 21496-1", std::to_string(version));
  if ((flags & kCommonDivisor) != 0) fractions.common = fractions.Take(4);
  map->capacity_min = fractions.Fraction(false);
  map->capacity_max = fractions.Fraction(false);
  for (size_t c = 0; c < ((flags & kThreeChannels) != 0 ? 3 : 1); ++c) {
    map->min[c] = fractions.Fraction(true);
    map->max[c] = fractions.Fraction(true);
    map->gamma[c] = fractions.Fraction(false);
    map->offset_sdr[c] = fractions.Fraction(true);
    map->offset_hdr[c] = fractions.Fraction(true);
  }
  if (fractions.is_cut) {
    return Expected(kWhere, "whole metadata by ISO 21496-1",
                    std::to_string(metadata.size) + " bytes");
  }
  if ((flags & kThreeChannels) == 0) {
    for (Colours* colours :
         {&map->min, &map->max, &map->gamma, &map->offset_sdr, &map->offset_hdr}) {
      colours->fill((*colours)[0]);
    }
  }
  if ((flags & kIsBrighter) != 0 || map->capacity_min > map->capacity_max) return IsBrighter();
  if ((flags & kBasePrimaries) == 0) {
    return Expected(kWhere, "gains in the primaries of the base picture", "other primaries");
  }
  map->format = "ISO 21496-1";
  return CheckGainMap(kWhere, *map);
}

Error ReadGainMap(const std::vector<AppendedPicture>& appended, DepthPhoto* photo) {
  Error first;
  for (const AppendedPicture& picture : appended) {
    if (!picture.is_gain_map || picture.is_png) continue;
    Result<GainMap> map = Read(picture, photo->metadata.exif);
    const Error error = map ? Take(std::move(*map), photo) : map.error();
    if (!error) return {};
    if (!first) first = error;
  }
  return first;
}

std::string GainMapFact(const GainMap& map, const Error& problem) {
  if (problem) return "ignored: " + problem.line();
  const double stops = *std::max_element(map.max.begin(), map.max.end());
  char text[40];
  std::snprintf(text, sizeof(text), ", at most %.3g stops", stops);
  return map.format + ", " + SizeText(map.width, map.height) + text;
}

Error ReadAppleGainMap(const AuxiliaryPicture& picture, DepthPhoto* photo) {
  if (picture.type != kAppleGainMap) return Expected(kWhere, kAppleGainMap, picture.type);
  FloatMap decoded;
  if (Error error = picture.decode(kWhere).MoveTo(&decoded)) return error;
  GainMap map;
  map.width = decoded.width;
  map.height = decoded.height;
  for (const float level : decoded.values) {
    map.levels.push_back(static_cast<uint16_t>(std::lround(65535 * level)));
  }
  const XmpNode xmp = PacketsOf({{picture.xmp.data(), picture.xmp.size()}});
  ToStops(AppleHeadroom(xmp, photo->metadata.exif), &map);
  return Take(std::move(map), photo);
}

}  // namespace starfocus
