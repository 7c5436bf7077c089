// SPDX-License-Identifier: Apache-2.0
// Tests the metadata of gain maps, the light that they give, and the gain maps of new pictures.
#include "platform/gain_map.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "platform/deep_image.h"
#include "platform/helper/helper.h"
#include "platform/readers/apple_gain_map.h"
#include "platform/readers/confined_photo.h"
#include "platform/readers/depth_photo_file.h"
#include "platform/readers/gain_map.h"
#include "platform/readers/orientation.h"
#include "tests/support/opened_photo.h"
#include "tests/support/photo_files.h"

namespace starfocus::gain_map_test {
namespace {

using namespace photos;

const std::string kNames = "xmlns:hdrgm=\"http://ns.adobe.com/hdr-gain-map/1.0/\"";

Span SpanOf(const std::string& text) {
  return {reinterpret_cast<const uint8_t*>(text.data()), text.size()};
}

XmpNode Xmp(const std::string& attributes, const std::string& inside = "") {
  const std::string packet = Packet(kNames, attributes, inside);
  return ValueOf(ParseXmp("xmp", packet.data(), packet.size()));
}

std::string List(const std::string& name, const std::string& numbers) {
  std::string text = "<hdrgm:" + name + "><rdf:Seq>", number;
  for (const char c : numbers + " ") {
    if (c != ' ') {
      number += c;
      continue;
    }
    text += "<rdf:li>" + number + "</rdf:li>";
    number.clear();
  }
  return text + "</rdf:Seq></hdrgm:" + name + ">";
}

// Returns metadata of ISO 21496-1. `fractions` are numerators of the denominator `divisor`, or of a
// common one.
std::string Iso(int flags, const std::vector<int32_t>& fractions, uint32_t divisor,
                uint32_t version = 0) {
  const bool common = (flags & 8) != 0;
  std::string text = Big(version, 2) + Big(0, 2) + static_cast<char>(flags);
  if (common) text += Big(divisor, 4);
  for (const int32_t fraction : fractions) {
    text += Big(static_cast<uint32_t>(fraction), 4);
    if (!common) text += Big(divisor, 4);
  }
  return text;
}

// A gain map of one channel with a parameter of each kind.
GainMap Map(int width, int height, double min, double max) {
  GainMap map;
  map.width = width;
  map.height = height;
  map.levels.resize(size_t(width) * size_t(height));
  map.min.fill(min);
  map.max.fill(max);
  return map;
}

TEST_CASE("gain maps: XMP states parameters as numbers or lists, or their defaults apply") {
  if (!CanReadXmp()) return;
  GainMap map;
  REQUIRE(ReadGainMapXmp(Xmp("hdrgm:Version=\"1.0\" hdrgm:GainMapMax=\"2.5\""), &map) == "");
  CHECK(map.min == std::array<double, 3>{0, 0, 0});
  CHECK(map.max == std::array<double, 3>{2.5, 2.5, 2.5});
  CHECK(map.gamma == std::array<double, 3>{1, 1, 1});
  CHECK(map.offset_sdr == std::array<double, 3>{0.015625, 0.015625, 0.015625});
  CHECK(map.offset_hdr == map.offset_sdr);
  CHECK(map.capacity_max == 2.5);
  map = {};
  REQUIRE(ReadGainMapXmp(Xmp("hdrgm:OffsetSDR=\"0\" hdrgm:HDRCapacityMin=\"0.5\" "
                             "hdrgm:HDRCapacityMax=\"3\" hdrgm:BaseRenditionIsHDR=\"False\"",
                             List("GainMapMin", "-1 -2 -3") + List("GainMapMax", "1 2 3") +
                                 List("Gamma", "0.5 1 2") + List("OffsetHDR", "0.25")),
                         &map) == "");
  CHECK(map.min == std::array<double, 3>{-1, -2, -3});
  CHECK(map.max == std::array<double, 3>{1, 2, 3});
  CHECK(map.gamma == std::array<double, 3>{0.5, 1, 2});
  CHECK(map.offset_sdr == std::array<double, 3>{0, 0, 0});
  CHECK(map.offset_hdr == std::array<double, 3>{0.25, 0.25, 0.25});
  CHECK(map.capacity_min == 0.5);
  CHECK(map.capacity_max == 3);
}

TEST_CASE("gain maps: invalid XMP is rejected with the name of the property") {
  if (!CanReadXmp()) return;
  const std::pair<std::string, std::string> kCases[] = {
      {"hdrgm:Version=\"1.0\"", "hdrgm:GainMapMax, found none"},
      {"hdrgm:GainMapMax=\"x\"", "GainMapMax from -64 to 64, found nan"},
      {"hdrgm:GainMapMax=\"65\"", "GainMapMax from -64 to 64, found 65"},
      {"hdrgm:GainMapMax=\"1\" hdrgm:GainMapMin=\"2\"", "GainMapMin up to GainMapMax"},
      {"hdrgm:GainMapMax=\"1\" hdrgm:Gamma=\"0\"", "Gamma from"},
      {"hdrgm:GainMapMax=\"1\" hdrgm:OffsetSDR=\"2\"", "OffsetSDR from -1 to 1"},
      {"hdrgm:GainMapMax=\"1\" hdrgm:OffsetHDR=\"-2\"", "OffsetHDR from -1 to 1"},
      {"hdrgm:GainMapMax=\"1\" hdrgm:BaseRenditionIsHDR=\"True\"", "found a brighter one"},
  };
  for (const auto& [attributes, text] : kCases) {
    const std::string shown(attributes);
    CAPTURE(shown);
    GainMap map;
    CHECK(Contains(ReadGainMapXmp(Xmp(attributes), &map), text));
  }
  GainMap map;
  CHECK(Contains(ReadGainMapXmp(Xmp("", List("GainMapMax", "1 2")), &map), "found nan"));
}

TEST_CASE("gain maps: ISO 21496-1 states the same parameters as fractions") {
  GainMap map;
  // Headrooms of the base and of the light; then min, max, gamma and offsets of each channel.
  const std::vector<int32_t> one = {0, 300, -50, 250, 100, 1, 2};
  for (const int flags : {0x40, 0x48}) {
    REQUIRE(ReadGainMapIso(SpanOf(Iso(flags, one, 100)), &map) == "");
    CHECK(map.capacity_min == 0);
    CHECK(map.capacity_max == 3);
    CHECK(map.min == std::array<double, 3>{-0.5, -0.5, -0.5});
    CHECK(map.max == std::array<double, 3>{2.5, 2.5, 2.5});
    CHECK(map.gamma == std::array<double, 3>{1, 1, 1});
    CHECK(map.offset_sdr == std::array<double, 3>{0.01, 0.01, 0.01});
    CHECK(map.offset_hdr == std::array<double, 3>{0.02, 0.02, 0.02});
  }
  const std::vector<int32_t> three = {0, 3, -1, 1, 1, 0, 0, -2, 2, 2, 0, 1, -3, 3, 3, 1, 0};
  REQUIRE(ReadGainMapIso(SpanOf(Iso(0xc0, three, 1)), &map) == "");
  CHECK(map.min == std::array<double, 3>{-1, -2, -3});
  CHECK(map.max == std::array<double, 3>{1, 2, 3});
  CHECK(map.gamma == std::array<double, 3>{1, 2, 3});
  CHECK(map.offset_sdr == std::array<double, 3>{0, 0, 1});
  CHECK(map.offset_hdr == std::array<double, 3>{0, 1, 0});
}

TEST_CASE("gain maps: invalid metadata of ISO 21496-1 are rejected") {
  const std::vector<int32_t> one = {0, 3, 0, 2, 1, 0, 0};
  GainMap map;
  const std::string whole = Iso(0x40, one, 1);
  for (size_t size = 0; size < whole.size(); ++size) {
    CHECK(ReadGainMapIso(SpanOf(whole.substr(0, size)), &map));
  }
  CHECK(Contains(ReadGainMapIso(SpanOf(Iso(0xc0, one, 1)), &map), "whole metadata"));
  CHECK(Contains(ReadGainMapIso(SpanOf(Iso(0x40, one, 0)), &map), "found nan"));
  CHECK(Contains(ReadGainMapIso(SpanOf(Iso(0x40, one, 1, 1)), &map), "version 0"));
  CHECK(Contains(ReadGainMapIso(SpanOf(Iso(0x44, one, 1)), &map), "brighter"));
  CHECK(Contains(ReadGainMapIso(SpanOf(Iso(0x40, {3, 0, 0, 2, 1, 0, 0}, 1)), &map), "brighter"));
  CHECK(Contains(ReadGainMapIso(SpanOf(Iso(0, one, 1)), &map), "other primaries"));
}

TEST_CASE("gain maps: the light of each place follows the equation of the format") {
  GainMap map = Map(1, 1, -1, 3);
  map.gamma = {1, 2, 0.5};
  map.offset_sdr = {0.01, 0.02, 0.03};
  map.offset_hdr = {0.001, 0.002, 0.5};
  for (const int level : {0, 51, 128, 255}) {
    map.levels[0] = static_cast<uint16_t>(257 * level);
    for (const int code : {0, 5, 100, 255}) {
      const DeepImage light = ApplyGainMap(Plain(3, 2, code), map);
      REQUIRE(light.is_half);
      REQUIRE(light.samples.size() == 18);
      for (size_t c = 0; c < 3; ++c) {
        const double value = code / 255.0;
        const double base =
            value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
        const double stops = -1 + 4 * std::pow(level / 255.0, 1 / map.gamma[c]);
        const double right =
            std::max((base + map.offset_sdr[c]) * std::exp2(stops) - map.offset_hdr[c], 0.0);
        CHECK(double{FloatOfHalf(light.samples[15 + c])} ==
              doctest::Approx(right).epsilon(1.0 / 2048).scale(1e-4));
      }
    }
  }
}

TEST_CASE("gain maps: light is not negative and ends at the largest half float") {
  GainMap map = Map(1, 1, 20, 20);
  CHECK(ApplyGainMap(Plain(1, 1, 255), map).samples[0] == 0x7bff);
  map = Map(1, 1, -20, -20);
  CHECK(ApplyGainMap(Plain(1, 1, 0), map).samples[0] == 0);
}

// Returns the gain of a pixel in stops.
double GainAt(const DeepImage& light, int x, int y, const GainMap& map) {
  const double value = double{FloatOfHalf(light.row(y)[3 * x])};
  return std::log2((value + map.offset_hdr[0]) / (1 + map.offset_sdr[0]));
}

TEST_CASE("gain maps: levels lie at the centres of the pixels that they cover") {
  // The gain is linear in the position, so that bilinear enlargement keeps it between the centres
  // of the outermost levels.
  for (const int step : {1, 2, 4}) {
    CAPTURE(step);
    GainMap map = Map(24 / step, 16 / step, 0, 2);
    const auto stops_at = [](double x, double y) { return 2 * (x / 24 * 0.75 + y / 16 * 0.25); };
    for (int y = 0; y < map.height; ++y) {
      for (int x = 0; x < map.width; ++x) {
        map.levels[size_t(y) * size_t(map.width) + size_t(x)] = static_cast<uint16_t>(
            std::lround(65535 * stops_at((x + 0.5) * step, (y + 0.5) * step) / 2));
      }
    }
    const DeepImage light = ApplyGainMap(Plain(24, 16, 255), map);
    for (int y = step / 2; y < 16 - step / 2; ++y) {
      for (int x = step / 2; x < 24 - step / 2; ++x) {
        CHECK(GainAt(light, x, y, map) ==
              doctest::Approx(stops_at(x + 0.5, y + 0.5)).epsilon(2e-3));
      }
    }
  }
}

// Returns a photo with a gain map of half the size, whose metadata are `segments`.
std::string WithMap(const std::string& segments, int width = kWidth / 2, int height = kHeight / 2) {
  return Photo() + Insert(Encode(Ramp(width, height), ".jpg"), segments);
}

Result<DepthPhoto> Read(const std::string& file) {
  return DecodeDepthPhoto("photo.jpg", SpanOf(file), true, Near::kUnknown);
}

std::string FactOf(const DepthPhoto& photo) {
  for (const auto& [name, value] : photo.facts) {
    if (name == "gain map") return value;
  }
  return "";
}

std::string IsoSegment(const std::string& metadata) {
  return Segment(0xe2, std::string("urn:iso:std:iso:ts:21496:-1") + '\0' + metadata);
}

TEST_CASE("gain maps: JPEG files with each kind of metadata give their map") {
  if (!CanReadXmp()) return;
  const std::string iso = IsoSegment(Iso(0x40, {0, 3, 0, 2, 1, 0, 0}, 1));
  const std::string broken = IsoSegment(Iso(0x40, {0, 3, 0, 2, 1, 0, 0}, 0));
  const std::string apple = XmpSegment(Packet(
      kApple, "",
      std::string("<apdi:AuxiliaryImageType>") + kAppleGainMap + "</apdi:AuxiliaryImageType>"));
  const struct {
    std::string segments, format;
    double most;
  } kCases[] = {{GainMapXmp(), "XMP", 2.5},
                {iso, "ISO 21496-1", 2},
                {GainMapXmp() + iso, "ISO 21496-1", 2},
                {GainMapXmp() + broken, "XMP", 2.5},
                {apple, "Apple", 1.8}};
  for (const auto& [segments, format, most] : kCases) {
    const std::string shown(format);
    CAPTURE(shown);
    const DepthPhoto photo = ValueOf(Read(WithMap(segments)));
    CHECK(photo.gain_map.format == format);
    CHECK(photo.gain_map.max[2] == doctest::Approx(most));
    CHECK(photo.gain_map.width == kWidth / 2);
    CHECK(photo.gain_map.channels == 1);
    CHECK(photo.gain_map.levels.front() < photo.gain_map.levels.back());
    CHECK(Contains(FactOf(photo), std::string(format) + ", 20x12, at most "));
  }
  for (const auto& [file, text] : std::vector<std::pair<std::string, std::string>>{
           {WithMap(broken), "found nan"},
           {WithMap(GainMapXmp(), kWidth / 2, kHeight), "the shape of a picture of 40x24"},
           {WithMap(GainMapXmp(), kWidth * 2, kHeight * 2), "the shape of a picture of 40x24"}}) {
    const DepthPhoto photo = ValueOf(Read(file));
    CHECK(photo.gain_map.levels.empty());
    CHECK(Contains(FactOf(photo), "ignored: the gain map: expected"));
    CHECK(Contains(FactOf(photo), text));
  }
}

TEST_CASE("gain maps: colours of the map give three channels, and the orientation turns them") {
  if (!CanReadXmp()) return;
  Image colours(kWidth / 2, kHeight / 2);
  for (size_t k = 0; k < colours.pixels.size(); ++k) {
    colours.pixels[k] = static_cast<uint8_t>(60 * (k % 3) + 2 * (k / 3 % (kWidth / 2)));
  }
  DepthPhoto photo = ValueOf(Read(Photo() + Insert(Encode(colours, ".jpg"), GainMapXmp())));
  REQUIRE(photo.gain_map.channels == 3);
  const std::vector<uint16_t> stored = photo.gain_map.levels;
  photo.orientation = 6;  // the stored rows are columns from the right
  ApplyOrientation(&photo);
  const GainMap& map = photo.gain_map;
  REQUIRE(map.width == kHeight / 2);
  REQUIRE(map.height == kWidth / 2);
  for (size_t c = 0; c < 3; ++c) {
    CHECK(map.levels[3 * size_t(map.width - 1) + c] == stored[c]);
    CHECK(map.levels[stored.size() - 3 * size_t(map.width) + c] == stored[stored.size() - 3 + c]);
  }
}

TEST_CASE("gain maps: maps arrive unchanged from the helper process") {
  if (!CanReadXmp()) return;
  ConfineDecoders();
  Image colours(kWidth / 2, kHeight / 2);
  for (size_t k = 0; k < colours.pixels.size(); ++k) colours.pixels[k] = uint8_t(k % 251);
  const std::string file = Photo() + Insert(Encode(colours, ".jpg"), GainMapXmp());
  const DepthPhoto direct = ValueOf(Read(file));
  const DepthPhoto passed =
      ValueOf(ConfinedPhoto("photo.jpg", SpanOf(file), [&] { return Read(file); }));
  const GainMap &a = direct.gain_map, &b = passed.gain_map;
  REQUIRE(a.channels == 3);
  CHECK(std::tie(a.width, a.height, a.channels, a.levels, a.format, a.min, a.max, a.gamma,
                 a.offset_sdr, a.offset_hdr, a.capacity_min, a.capacity_max) ==
        std::tie(b.width, b.height, b.channels, b.levels, b.format, b.min, b.max, b.gamma,
                 b.offset_sdr, b.offset_hdr, b.capacity_min, b.capacity_max));
  // The program does not trust the helper process: it checks the parameters again.
  GainMap wrong = Map(2, 2, 1, 0);
  if (!DecodersAreConfined()) return;
  const Error error = RunHelper(
      "photo.jpg", kDecoderLimits, [] {}, [&](Channel* channel) { Pass(channel, &wrong); });
  CHECK(error);
}

// Returns EXIF whose maker note has the given tags of Apple, each a fraction of 1000.
Bytes AppleExif(const std::vector<std::pair<uint32_t, int32_t>>& tags) {
  std::string entries, values;
  for (const auto& [tag, value] : tags) {
    const size_t at = 14 + 2 + 12 * tags.size() + 4 + values.size();
    entries += Big(tag, 2) + Big(10, 2) + Big(1, 4) + Big(uint32_t(at), 4);
    values += Big(static_cast<uint32_t>(value), 4) + Big(1000, 4);
  }
  const std::string note = std::string("Apple iOS\0\0\1MM", 14) + Big(uint32_t(tags.size()), 2) +
                           entries + Big(0, 4) + values;
  const auto size = static_cast<uint32_t>(note.size());
  const std::string exif = std::string("MM\0\x2a\0\0\0\x08", 8) + Big(1, 2) + Big(0x8769, 2) +
                           Big(4, 2) + Big(1, 4) + Big(26, 4) + Big(0, 4) + Big(1, 2) +
                           Big(0x927c, 2) + Big(7, 2) + Big(size, 4) + Big(44, 4) + Big(0, 4) +
                           note;
  return {exif.begin(), exif.end()};
}

TEST_CASE("gain maps: the maker note of Apple states the headroom") {
  const struct {
    std::vector<std::pair<uint32_t, int32_t>> tags;
    double stops;
  } kCases[] = {
      {{{33, 879}}, 1.8},
      {{{33, 879}, {48, 5}}, 1.7},
      {{{33, 0}, {48, 1000}}, 1.5},
      {{{33, 1010}, {48, 0}}, 3},
      {{{33, 1010}, {48, 10}}, 2.3},
      {{{33, 1010}, {48, 1000}}, 2},
      {{{33, 1010}, {48, 8000}}, 0},
      {{}, 1.8},
  };
  for (const auto& [tags, stops] : kCases) {
    CHECK(AppleHeadroom({}, AppleExif(tags)) == doctest::Approx(stops));
  }
  CHECK(AppleHeadroom({}, {}) == doctest::Approx(1.8));
  // Truncated notes and EXIF are safe.
  const Bytes exif = AppleExif({{33, 879}, {48, 5}});
  for (size_t size = 0; size < exif.size(); ++size) {
    AppleHeadroom({}, Bytes(exif.begin(), exif.begin() + static_cast<ptrdiff_t>(size)));
  }
  if (!CanReadXmp()) return;
  const std::string packet = Packet("xmlns:HDRGainMap=\"http://ns.apple.com/HDRGainMap/1.0/\"",
                                    "HDRGainMap:HDRGainMapHeadroom=\"4\"");
  const XmpNode xmp = ValueOf(ParseXmp("xmp", packet.data(), packet.size()));
  CHECK(AppleHeadroom(xmp, exif) == doctest::Approx(2));
}

TEST_CASE("gain maps: Apple's levels give the light of Apple's equation") {
  for (const int level : {0, 10, 100, 200, 255}) {
    GainMap map = Map(1, 1, 0, 0);
    map.levels[0] = static_cast<uint16_t>(257 * level);
    ToStops(2.3, &map);
    REQUIRE(CheckGainMap("map", map) == "");
    const double value = level / 255.0;
    const double gain = value < 0.081 ? value / 4.5 : std::pow((value + 0.099) / 1.099, 1 / 0.45);
    const DeepImage light = ApplyGainMap(Plain(1, 1, 255), map);
    CHECK(double{FloatOfHalf(light.samples[1])} ==
          doctest::Approx(1 + (std::exp2(2.3) - 1) * gain).epsilon(1e-3));
  }
  GainMap map = Map(1, 1, 0, 0);
  map.levels[0] = 65535;
  ToStops(0, &map);
  CHECK(ApplyGainMap(Plain(1, 1, 255), map).samples[0] == HalfOfFloat(1));
}

}  // namespace
}  // namespace starfocus::gain_map_test
