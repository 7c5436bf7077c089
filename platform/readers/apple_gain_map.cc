// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/apple_gain_map.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>

#include "platform/readers/tiff_numbers.h"

namespace starfocus {
namespace {

constexpr double kMostHeadroom = 16;  // stops: the light of half floats ends there

// Returns the maker note of EXIF, or an empty span.
Span MakerNote(const Bytes& exif) {
  constexpr uint32_t kExifDirectory = 0x8769, kMakerNote = 0x927c;
  const TiffNumbers tiff(Span{exif.data(), exif.size()});
  const std::optional<size_t> directory = tiff.Entry(tiff.Whole(4, 4), kExifDirectory);
  if (!directory) return {};
  const std::optional<size_t> note = tiff.Entry(tiff.Whole(*directory + 8, 4), kMakerNote);
  if (!note) return {};
  const size_t size = tiff.Whole(*note + 4, 4), begin = tiff.Whole(*note + 8, 4);
  if (begin > exif.size() || size > exif.size() - begin) return {};
  return {exif.data() + begin, size};
}

// Returns the fraction `tag` of Apple's maker note, or 0 if the note does not have it. The note is
// a directory of TIFF after a name and a byte order; positions count from the start of the note.
double AppleTag(Span note, uint32_t tag) {
  constexpr char kName[] = "Apple iOS";
  constexpr size_t kOrder = 12, kDirectory = 14;
  constexpr uint32_t kSignedFraction = 10;
  if (note.size < kDirectory || std::memcmp(note.data, kName, sizeof(kName)) != 0) return 0;
  const TiffNumbers numbers(note, note.data[kOrder] == 'I');
  const std::optional<size_t> entry = numbers.Entry(kDirectory, tag);
  if (!entry || numbers.Whole(*entry + 2, 2) != kSignedFraction) return 0;
  const size_t at = numbers.Whole(*entry + 8, 4);
  const auto signed_at = [&](size_t place) {
    const uint32_t whole = numbers.Whole(place, 4);
    return whole >> 31 != 0 ? double(whole) - 0x1p32 : double(whole);
  };
  const double divisor = signed_at(at + 4);
  return divisor == 0 ? 0 : signed_at(at) / divisor;
}

// Apple's equation of the headroom.
double StopsOf(double tag33, double tag48) {
  if (tag33 < 1) return tag48 <= 0.01 ? -20 * tag48 + 1.8 : -0.101 * tag48 + 1.601;
  return tag48 <= 0.01 ? -70 * tag48 + 3.0 : -0.303 * tag48 + 2.303;
}

// Decodes the curve of ITU-R BT.709.
double LightOf709(double level) {
  return level < 0.081 ? level / 4.5 : std::pow((level + 0.099) / 1.099, 1 / 0.45);
}

bool Mentions(const XmpNode& node, const std::string& text) {
  return node.text == text ||
         std::any_of(node.attributes.begin(), node.attributes.end(),
                     [&](const auto& attribute) { return attribute.second == text; }) ||
         std::any_of(node.children.begin(), node.children.end(),
                     [&](const XmpNode& child) { return Mentions(child, text); });
}

}  // namespace

bool IsAppleGainMap(const XmpNode& xmp) { return Mentions(xmp, kAppleGainMap); }

double AppleHeadroom(const XmpNode& xmp, const Bytes& exif) {
  const std::string* text =
      FindProperty(xmp, "http://ns.apple.com/HDRGainMap/1.0/|HDRGainMapHeadroom");
  const std::optional<double> ratio = XmpNumber(text);
  double stops = 0;
  if (ratio && *ratio >= 1) {
    stops = std::log2(*ratio);
  } else {
    constexpr uint32_t kHeadroom = 33, kGain = 48;
    const Span note = MakerNote(exif);
    stops = StopsOf(AppleTag(note, kHeadroom), AppleTag(note, kGain));
  }
  return std::clamp(stops, 0.0, kMostHeadroom);
}

void ToStops(double headroom, GainMap* map) {
  constexpr double kMost = 65535;
  const double brightest = std::exp2(headroom);
  std::vector<uint16_t> levels(65536);
  for (size_t k = 0; k < levels.size() && headroom > 0; ++k) {
    const double gain = 1 + (brightest - 1) * LightOf709(static_cast<double>(k) / kMost);
    levels[k] = static_cast<uint16_t>(std::lround(kMost * std::log2(gain) / headroom));
  }
  for (uint16_t& level : map->levels) level = levels[level];
  map->min.fill(0);
  map->max.fill(headroom);
  map->gamma.fill(1);
  map->offset_sdr.fill(0);
  map->offset_hdr.fill(0);
  map->capacity_min = 0;
  map->capacity_max = headroom;
  map->format = "Apple";
}

}  // namespace starfocus
