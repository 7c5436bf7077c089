// SPDX-License-Identifier: Apache-2.0
// Tests files of pictures with more than 8 bits or alpha. The tests write PNG and TIFF files
// byte by byte; exrinfo and tiffinfo, if installed, read the files of the writers.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "platform/container.h"
#include "platform/deep_image.h"
#include "platform/depth_file.h"
#include "platform/image_io.h"
#include "platform/readers/deep_photo.h"
#include "platform/readers/depth_photo_file.h"
#include "platform/readers/orientation.h"
#include "platform/readers/sample_bits.h"
#include "platform/writers/deep_picture.h"
#include "platform/writers/exr.h"
#include "platform/writers/heif.h"
#include "platform/writers/tiff.h"
#include "tests/support/error_line.h"
#include "tests/support/exr_file.h"
#include "tests/support/photo_files.h"
#include "tests/support/temp_folder.h"

namespace starfocus::deep_files_test {
namespace {

using namespace photos;
using namespace exr_file;

constexpr int32_t kSrgb = STARFOCUS_TRANSFER_SRGB, kLinear = STARFOCUS_TRANSFER_NONE,
                  kPq = STARFOCUS_TRANSFER_PQ, kHlg = STARFOCUS_TRANSFER_HLG;

using Words = std::vector<uint16_t>;

Bytes BytesOf(const std::string& text) { return {text.begin(), text.end()}; }

Result<DecodedPicture> Decode(const std::string& file) { return DecodeImage("a", BytesOf(file)); }

bool HasLibpng() { return Decode(Png(1, 1, {16, 2}, std::string(6, '\7'), 6))->deep.has_value(); }
bool HasExr() { return !CheckExrEncoder("a.exr"); }

// Returns big-endian 16-bit words.
std::string Samples16(const Words& words) {
  std::string samples;
  for (const uint16_t word : words) samples += Big(word, 2);
  return samples;
}

std::string Cicp(int primaries, int transfer) {
  return Chunk("cICP",
               Big(uint32_t(primaries), 1) + Big(uint32_t(transfer), 1) + std::string("\0\1", 2));
}

std::vector<float> LightsOf(const DeepImage& deep) {
  std::vector<float> lights;
  for (const uint16_t sample : deep.samples) lights.push_back(FloatOfHalf(sample));
  return lights;
}

std::vector<float> LightsOf(const Result<DecodedPicture>& picture) {
  REQUIRE(picture == "");
  REQUIRE(picture->deep);
  CHECK(picture->deep->is_half);
  return LightsOf(*picture->deep);
}

using FactList = std::vector<std::pair<std::string, std::string>>;

Result<DepthPhoto> ReadPhoto(const std::string& file) {
  const Bytes bytes = BytesOf(file);
  return DecodeDepthPhoto("photo", {bytes.data(), bytes.size()}, true, Near::kUnknown);
}

struct DeepRow {
  std::string what;
  std::string file;
  int channels;  // 0: no DeepImage
  int32_t transfer;
  Words samples;
  std::vector<int> bytes;  // of the picture of 8 bits
};

void CheckRows(const std::vector<DeepRow>& rows) {
  for (const DeepRow& row : rows) {
    CAPTURE(row.what);
    const Result<DecodedPicture> picture = Decode(row.file);
    REQUIRE(picture == "");
    CHECK(std::vector<int>(picture->image.pixels.begin(), picture->image.pixels.end()) ==
          row.bytes);
    CHECK(picture->is_transparent == (row.channels == 4));
    CHECK(picture->deep.has_value() == (row.channels > 0));
    if (!picture->deep) continue;
    CHECK(std::tuple(picture->deep->channels, picture->deep->transfer, picture->deep->is_half) ==
          std::tuple(row.channels, row.transfer, false));
    CHECK(picture->deep->samples == row.samples);
  }
}

TEST_CASE("PNG: 16 bits and alpha are read as codes of 16 bits beside the picture of 8 bits") {
  if (!HasLibpng()) return;
  constexpr int kGrey = 0, kRgb = 2, kPalette = 3, kGreyAlpha = 4, kRgba = 6;
  const std::string rgb16 = Samples16({0, 385, 65535, 386, 127, 129});
  const std::string key = Chunk("tRNS", Samples16({386, 127, 129}));
  const std::string palette = Chunk("PLTE", std::string("\1\2\3\4\5\6", 6)) + Chunk("tRNS", "\x80");
  const Words codes = {0, 385, 65535, 386, 127, 129};
  const std::vector<int> bytes = {0, 1, 255, 2, 0, 1};
  CheckRows({
      {"RGB of 16 bits", Png(2, 1, {16, kRgb}, rgb16, 12), 3, kSrgb, codes, bytes},
      {"a transparent colour",
       Png(2, 1, {16, kRgb, key}, rgb16, 12),
       4,
       kSrgb,
       {0, 385, 65535, 65535, 386, 127, 129, 0},
       bytes},
      {"PQ", Png(2, 1, {16, kRgb, Cicp(9, 16)}, rgb16, 12), 3, kPq, codes, {0, 0, 255, 0, 0, 0}},
      {"linear light", Png(2, 1, {16, kRgb, Cicp(9, 8)}, rgb16, 12), 3, kLinear, codes, bytes},
      {"grey of 16 bits",
       Png(2, 1, {16, kGrey}, Samples16({700, 65535}), 4),
       3,
       kSrgb,
       {700, 700, 700, 65535, 65535, 65535},
       {3, 3, 3, 255, 255, 255}},
      {"grey and alpha",
       Png(1, 1, {16, kGreyAlpha}, Samples16({700, 9}), 4),
       4,
       kSrgb,
       {700, 700, 700, 9},
       {3, 3, 3}},
      {"alpha of 8 bits",
       Png(1, 2, {8, kRgba}, std::string("\1\2\3\377\4\5\6\7", 8), 4),
       4,
       kSrgb,
       {257, 514, 771, 65535, 1028, 1285, 1542, 1799},
       {1, 2, 3, 4, 5, 6}},
      {"opaque alpha", Png(1, 1, {8, kRgba}, "\1\2\3\377", 4), 0, kSrgb, {}, {1, 2, 3}},
      {"opaque alpha of 16 bits",
       Png(1, 1, {16, kRgba}, Samples16({700, 1, 2, 65535}), 8),
       3,
       kSrgb,
       {700, 1, 2},
       {3, 0, 0}},
      {"a palette with alpha",
       Png(2, 1, {8, kPalette, palette}, std::string("\0\1", 2), 2),
       4,
       kSrgb,
       {257, 514, 771, 0x8080, 1028, 1285, 1542, 65535},
       {1, 2, 3, 4, 5, 6}},
      {"grey of 4 bits with a key",
       Png(2, 1, {4, kGrey, Chunk("tRNS", Samples16({2}))}, "\x2f", 1),
       4,
       kSrgb,
       {8738, 8738, 8738, 0, 65535, 65535, 65535, 65535},
       {34, 34, 34, 255, 255, 255}},
      {"8 bits", Png(1, 1, {8, kRgb}, "\1\2\3", 3), 0, kSrgb, {}, {1, 2, 3}},
      {"HLG of 8 bits",
       Png(1, 1, {8, kRgb, Cicp(9, 18)}, "\1\2\377", 3),
       3,
       kHlg,
       {257, 514, 65535},
       {0, 0, 255}},
  });
}

TEST_CASE("PPM: a white above 255 gives codes of 16 bits, and the bits of the white") {
  const std::string samples = Samples16({1023, 512, 0, 2000, 1, 2});
  const DecodedPicture picture = ValueOf(Decode("P6 2 1 1023\n" + samples));
  REQUIRE(picture.deep);
  CHECK(picture.bits == 10);
  CHECK(picture.deep->samples == Words{65535, 32800, 0, 65535, 64, 128});
  CHECK(picture.image.pixels == Bytes{255, 128, 0, 255, 0, 0});
  const DecodedPicture grey = ValueOf(Decode("P5 1 1 65535\n" + Samples16({700})));
  REQUIRE(grey.deep);
  CHECK(grey.bits == 16);
  CHECK(grey.deep->samples == Words{700, 700, 700});
  CHECK(!ValueOf(Decode("P6 1 1 255\n\1\2\3")).deep);
}

TEST_CASE("facts: bits, transfer, primaries, alpha and headroom describe pictures") {
  const auto facts = [](const std::string& file) {
    Result<DepthPhoto> photo = ReadPhoto(file);
    REQUIRE(photo == "");
    LightField views;
    views.deep_colours = photo->deep_colours;
    views.is_linear = photo->is_linear;
    if (photo->deep) views.deep.push_back(*photo->deep);
    return FactsOfLight(views, photo->metadata, photo->gain_map);
  };
  constexpr int kRgb = 2, kRgba = 6;
  if (HasLibpng()) {
    CHECK(facts(Png(1, 1, {8, kRgb}, "\1\2\3", 3)) ==
          FactList{{"samples", "8 bits, integers"}, {"transfer", "sRGB"}, {"primaries", "BT.709"}});
    CHECK(facts(Png(1, 1, {8, kRgb, Cicp(12, 8)}, "\1\2\3", 3)) ==
          FactList{{"samples", "8 bits, integers"},
                   {"transfer", "linear light"},
                   {"primaries", "Display P3"}});
    CHECK(facts(Png(1, 1, {8, kRgb, Cicp(9, 1)}, "\1\2\3", 3))[1].second ==
          "gamma 1.95, decoded as sRGB");
    CHECK(facts(Png(1, 1, {8, kRgba}, "\1\2\3\4", 4)) == FactList{{"samples", "8 bits, integers"},
                                                                  {"transfer", "sRGB"},
                                                                  {"primaries", "BT.709"},
                                                                  {"alpha", "not premultiplied"}});
    const FactList pq = facts(Png(1, 1, {16, kRgb, Cicp(9, 16)}, Samples16({47785, 0, 9}), 6));
    CHECK(FactList(pq.begin(), pq.begin() + 4) == FactList{{"samples", "16 bits, integers"},
                                                           {"transfer", "PQ, white at 203 cd/m2"},
                                                           {"primaries", "BT.2020"},
                                                           {"headroom", "4 times white"}});
  }
  if (!HasExr()) return;
  ExrPart part = Colours(6.5F);
  part.channels.insert(part.channels.begin(), {"A", true, {0.5F, 1}});
  CHECK(facts(Exr({part})) == FactList{{"samples", "32 bits, floats"},
                                       {"transfer", "linear light"},
                                       {"primaries", "BT.709"},
                                       {"alpha", "premultiplied"},
                                       {"headroom", "6.5 times white"}});
  CHECK(facts(Exr({Colours(100)})).back().second == "100 times white, limited to 64");
}

TEST_CASE("orientation: the picture of 16 bits turns with the picture of 8 bits") {
  if (!HasExr()) return;
  for (int orientation = 2; orientation <= 8; ++orientation) {
    CAPTURE(orientation);
    ExrPart part = {{}, {0, 0, 2, 1}, {0, 0, 2, 1}};
    for (const char* name : {"A", "B", "G", "R"}) {
      part.channels.push_back({name, true, {0.5F, 0.25F, 0.125F, 1, 0.75F, 0}});
    }
    DepthPhoto photo = *ReadPhoto(Exr({part}));
    photo.orientation = orientation;
    ApplyOrientation(&photo);
    const DeepImage& deep = *photo.deep;
    CHECK(std::tuple(deep.width, deep.height, deep.channels, deep.is_half) ==
          std::tuple(photo.picture.width, photo.picture.height, 4, true));
    CHECK(ToImage(deep).pixels == photo.picture.pixels);
    CHECK(deep.samples[3] == deep.samples[0]);
  }
}

DeepImage DeepPattern(int width, int height, int channels) {
  DeepImage image(width, height, channels);
  for (size_t k = 0; k < image.samples.size(); ++k) {
    image.samples[k] = static_cast<uint16_t>(k * 2657 + k / 5);
  }
  return image;
}

std::string Ask(const TempFolder& folder, const std::string& command) {
  const std::string path = folder.file("answer");
  if (std::system((command + " >'" + path + "' 2>&1").c_str()) != 0) return "";
  const Bytes bytes = ValueOf(ReadFile(path));
  return {bytes.begin(), bytes.end()};
}

bool Has(const char* program) {
  return std::system((std::string("command -v ") + program + " >/dev/null").c_str()) == 0;
}

struct Written {
  DecodedPicture picture;
  Bytes bytes;
  std::vector<std::string> notes;
};

Written WriteAndRead(const TempFolder& folder, const std::string& name, const DeepImage& image,
                     const DeepOptions& options) {
  Written written;
  REQUIRE(WriteDeepImage(folder.file(name), image, options, &written.notes) == "");
  written.bytes = ValueOf(ReadFile(folder.file(name)));
  const Result<DepthPhoto> photo =
      DecodeDepthPhoto(name, {written.bytes.data(), written.bytes.size()}, false, Near::kUnknown);
  REQUIRE(photo == "");
  written.picture = {photo->picture, photo->deep, photo->metadata};
  written.picture.metadata.colours = photo->deep_colours;
  REQUIRE(written.picture.deep);
  return written;
}

TEST_CASE("writers: PNG of 16 bits keeps all codes, alpha, profile and code points") {
  if (!HasLibpng()) return;
  TempFolder folder;
  DeepOptions options;
  const std::string profile = Profile(300);
  options.picture.metadata.icc = BytesOf(profile);
  for (const int channels : {3, 4}) {
    for (const int width : {1, 2, 37}) {
      CAPTURE(width);
      const DeepImage image = DeepPattern(width, 5, channels);
      const Written written = WriteAndRead(folder, "a.png", image, options);
      CHECK(written.notes.empty());
      CHECK(written.picture.deep->samples == image.samples);
      CHECK(written.picture.deep->channels == channels);
      CHECK(written.picture.metadata.icc == options.picture.metadata.icc);
    }
  }
  DeepImage pq = DeepPattern(9, 5, 3);
  pq.transfer = kPq;
  options.picture.metadata.colours = {"chromaticities", ColourDescription::kGiven, 8};
  options.picture.metadata.colours.chromaticities = *ChromaticitiesOf({"", 12, 1});
  const Written written = WriteAndRead(folder, "a.png", pq, options);
  CHECK(written.picture.deep->samples == pq.samples);
  CHECK(written.picture.deep->transfer == kPq);
  CHECK(written.picture.metadata.colours.primaries == 12);
  CHECK(Contains(std::string(written.bytes.begin(), written.bytes.end()), Cicp(12, 16)));
}

TEST_CASE("writers: OpenEXR keeps half floats, alpha and chromaticities, and exrinfo reads them") {
  if (!HasExr()) return;
  const bool asks = Has("exrinfo");
  if (!asks) MESSAGE("SKIPPED: exrinfo is absent");
  TempFolder folder;
  DeepOptions options;
  options.picture.metadata.colours = {"cICP", 9, 16};
  for (const int channels : {3, 4}) {
    CAPTURE(channels);
    DeepImage image = DeepPattern(37, 40, channels);
    image.is_half = true;
    image.transfer = kLinear;
    for (uint16_t& sample : image.samples) sample &= 0xbbff;  // finite
    const Written written = WriteAndRead(folder, "a.exr", image, options);
    CHECK(written.picture.deep->samples == image.samples);
    CHECK(written.picture.metadata.colours.chromaticities == *ChromaticitiesOf({"", 9, 1}));
    if (!asks) continue;
    const std::string text = Ask(folder, "exrinfo -v '" + folder.file("a.exr") + "'");
    CHECK(Contains(text, "37 x 40"));
    CHECK(Contains(text, "zip"));
    CHECK(Contains(text, "'A'") == (channels == 4));
    CHECK(Contains(text, "half"));
  }
  // Codes become light.
  DeepImage codes(1, 1, 3);
  codes.samples = {65535, 38055, 0};
  codes.transfer = kPq;
  const std::vector<float> lights =
      LightsOf(*WriteAndRead(folder, "a.exr", codes, options).picture.deep);
  CHECK(lights[0] == doctest::Approx(10000.0 / 203).epsilon(1e-3));
  CHECK(lights[1] == doctest::Approx(1).epsilon(1e-3));
  CHECK(lights[2] == 0);
}

TEST_CASE("writers: half floats become codes of a transfer, and a note counts clipped samples") {
  if (!HasLibpng()) return;
  TempFolder folder;
  DeepImage half(2, 1, 3);
  half.is_half = true;
  for (size_t k = 0; k < 6; ++k) half.samples[k] = HalfOfFloat(static_cast<float>(k) * 0.5F);
  const Written sdr = WriteAndRead(folder, "a.png", half, {});
  CHECK(sdr.picture.deep->samples[1] == 48192);  // sRGB code of 0.5
  CHECK(sdr.picture.deep->samples[5] == 65535);
  REQUIRE(sdr.notes.size() == 1);
  CHECK(sdr.notes[0] == "clipped: 3 samples brighter than white");
  const Written hdr = WriteAndRead(folder, "a.png", half, {{}, kPq});
  CHECK(hdr.notes.empty());
  CHECK(hdr.picture.deep->transfer == kPq);
  CHECK(std::abs(hdr.picture.deep->samples[2] - 38055) <= 1);
}

// Entries of a TIFF directory, sorted by tag: a tag and its number.
using Tags = std::vector<std::pair<uint32_t, uint32_t>>;

// Returns a TIFF file of `width` x 1 pixels without compression.
std::string Tiff(uint32_t width, uint32_t samples, uint32_t bits, const Tags& more,
                 const std::string& strip) {
  constexpr uint32_t kStripAt = 8, kLong = 4, kRgb = 2, kGrey = 1;
  Tags tags = {{256, width},
               {257, 1},
               {258, bits},
               {259, 1},
               {262, samples < 3 ? kGrey : kRgb},
               {273, kStripAt},
               {277, samples},
               {278, 1},
               {279, uint32_t(strip.size())}};
  for (const auto& [tag, value] : more) {
    const auto same = std::find_if(tags.begin(), tags.end(),
                                   [tag = tag](const auto& own) { return own.first == tag; });
    if (same != tags.end()) tags.erase(same);
    tags.emplace_back(tag, value);
  }
  std::sort(tags.begin(), tags.end());
  std::string file = std::string("II*\0", 4) + Little(kStripAt + strip.size(), 4) + strip;
  file += Little(tags.size(), 2);
  for (const auto& [tag, value] : tags) {
    file += Little(tag, 2) + Little(kLong, 2) + Little(1, 4) + Little(value, 4);
  }
  return file + Little(0, 4);
}

std::string LittleWords(const Words& words) {
  std::string text;
  for (const uint16_t word : words) text += Little(word, 2);
  return text;
}

bool HasTiff() { return !CheckTiffEncoder("a.tif"); }

TEST_CASE("TIFF: pictures of 8 and 16 bits and of floats are read, with alpha") {
  if (!HasTiff()) return;
  constexpr uint32_t kExtra = 338, kFormat = 339, kMultiplied = 1, kStraight = 2, kFloat = 3;
  const Words codes = {0, 385, 65535, 386, 127, 129};
  const std::vector<int> bytes = {0, 1, 255, 2, 0, 1};
  CheckRows({
      {"RGB of 16 bits", Tiff(2, 3, 16, {}, LittleWords(codes)), 3, kSrgb, codes, bytes},
      {"RGB of 8 bits", Tiff(1, 3, 8, {}, "\1\2\3"), 0, kSrgb, {}, {1, 2, 3}},
      {"grey of 16 bits",
       Tiff(1, 1, 16, {}, LittleWords({700})),
       3,
       kSrgb,
       {700, 700, 700},
       {3, 3, 3}},
      {"grey and alpha",
       Tiff(1, 2, 16, {{kExtra, kStraight}}, LittleWords({700, 9})),
       4,
       kSrgb,
       {700, 700, 700, 9},
       {3, 3, 3}},
      {"multiplied alpha",
       Tiff(1, 4, 16, {{kExtra, kMultiplied}}, LittleWords({9, 90, 0, 180})),
       4,
       kSrgb,
       {3277, 32768, 0, 180},
       {13, 128, 0}},
      {"a sample without meaning",
       Tiff(1, 4, 16, {{kExtra, 0}}, LittleWords({9, 90, 0, 180})),
       3,
       kSrgb,
       {9, 90, 0},
       {0, 0, 0}},
      {"alpha of 8 bits",
       Tiff(1, 4, 8, {{kExtra, kStraight}}, "\1\2\3\4"),
       4,
       kSrgb,
       {257, 514, 771, 1028},
       {1, 2, 3}},
  });
  CHECK(StatedSamplesOf(BytesOf(Tiff(1, 3, 32, {{kFormat, kFloat}}, ""))).is_float);
  CHECK(StatedSamplesOf(BytesOf(Tiff(1, 3, 8, {}, ""))).bits == 8);
  const std::string lights = LittleFloat(2) + LittleFloat(-0.5F) + LittleFloat(1e9F);
  CHECK(LightsOf(Decode(Tiff(1, 3, 32, {{kFormat, kFloat}}, lights))) ==
        std::vector<float>{2, -0.5F, 65504});
  CHECK(Decode(Tiff(1, 2, 16, {{kExtra, kStraight}}, LittleWords({700, 9})))->notes.empty());
  CHECK_FALSE(Decode(Tiff(1, 4, 8, {{kExtra, kStraight}}, "\1\2\3\4"))->deep->is_multiplied);
  CHECK(Decode(Tiff(1, 4, 8, {{kExtra, kMultiplied}}, "\1\2\3\4"))->deep->is_multiplied);
  CHECK(Decode(Tiff(1, 4, 8, {{kExtra, 0}}, "\1\2\3\4"))->notes ==
        std::vector<std::string>{
            "a sample of each pixel, which the file does not declare as colour or "
            "alpha, is ignored"});
  CHECK(LightsOf(Decode(Tiff(1, 4, 32, {{kExtra, kStraight}, {kFormat, kFloat}},
                             lights + LittleFloat(0.25F)))) ==
        std::vector<float>{0.5F, -0.125F, 65504, 0.25F});
  CHECK(LightsOf(Decode(Tiff(1, 4, 16, {{kExtra, kMultiplied}, {kFormat, kFloat}},
                             LittleWords({0x4000, 0x3c00, 0, 0x3800})))) ==
        std::vector<float>{2, 1, 0, 0.5F});
}

TEST_CASE("TIFF: raw files, other layouts and small files of many pixels are rejected") {
  if (!HasTiff()) return;
  const std::string strip = LittleWords({1, 2, 3});
  const struct {
    Tags tags;
    std::string error;
  } rows[] = {{{{254, 1}}, "found a raw file"},
              {{{262, 6}}, "found 3 samples of photometric interpretation 6"},
              {{{284, 2}}, "a TIFF picture of interleaved RGB or grey"},
              {{{339, 2}}, "found 16-bit signed integers"},
              {{{274, 6}}, "a TIFF of orientation 1, found 6"},
              {{{259, 7}}, "found compression 7 (convert it to PNG"},
              {{{256, 65536}}, "width and height from 1 to 65535"},
              {{{256, 16384}, {257, 16384}}, "too small for its pixels"}};
  for (const auto& row : rows) {
    CAPTURE(row.error);
    CHECK(Contains(Decode(Tiff(1, 3, 16, row.tags, strip)), row.error));
  }
}

TEST_CASE("writers: TIFF of 16 bits keeps all codes, alpha and profile, and tiffinfo reads it") {
  if (!HasTiff()) return;
  const bool asks = Has("tiffinfo");
  if (!asks) MESSAGE("SKIPPED: tiffinfo is absent");
  TempFolder folder;
  DeepOptions options;
  options.picture.metadata.icc = BytesOf(Profile(300));
  for (const int channels : {3, 4}) {
    const DeepImage image = DeepPattern(37, 90, channels);
    const Written written = WriteAndRead(folder, "a.tif", image, options);
    CHECK(written.picture.deep->samples == image.samples);
    CHECK(written.picture.metadata.icc == options.picture.metadata.icc);
    CHECK(StatedSamplesOf(written.bytes).bits == 16);
    CHECK(!StatedSamplesOf(written.bytes).is_float);
    if (!asks) continue;
    const std::string text = Ask(folder, "tiffinfo '" + folder.file("a.tif") + "'");
    CHECK(Contains(text, "Bits/Sample: 16\n"));
    CHECK(Contains(text, "Compression Scheme: AdobeDeflate\n"));
    CHECK(Contains(text, "unassoc-alpha") == (channels == 4));
  }
}

TEST_CASE("writers: AVIF and HEIC keep codes within their bits, alpha and code points") {
  TempFolder folder;
  for (const char* name : {"a.avif", "a.heic"}) {
    if (CheckHeifEncoder(name, name[2] == 'a')) continue;
    for (const int channels : {3, 4}) {
      CAPTURE(name);
      CAPTURE(channels);
      DeepImage image(67, 34, channels);
      for (size_t k = 0; k < image.samples.size(); ++k) {
        const size_t c = k % size_t(channels), x = k / size_t(channels) % 67,
                     y = k / image.row_samples();
        image.samples[k] =
            static_cast<uint16_t>(c == 3 ? 65535 - 200 * y : 20000 + 300 * x + 150 * y * c);
      }
      image.transfer = kPq;
      DeepOptions options;
      options.picture.metadata.colours = {"cICP", 9, 16};
      const Written written = WriteAndRead(folder, name, image, options);
      const DeepImage& deep = *written.picture.deep;
      CHECK(StatedSamplesOf(written.bytes).bits == deep.bits);
      CHECK(std::tuple(deep.width, deep.height, deep.channels, deep.transfer) ==
            std::tuple(67, 34, channels, kPq));
      CHECK(written.picture.metadata.colours.primaries == 9);
      // 8 codes of 10 bits: the default quality is 95.
      for (size_t k = 0; k < image.samples.size(); ++k) {
        if (std::abs(deep.samples[k] - image.samples[k]) > 8 * 64) FAIL_CHECK(k);
      }
    }
  }
}

TEST_CASE("writers: codes of a linear profile stay linear light in all formats") {
  TempFolder folder;
  DeepImage image = DeepPattern(37, 5, 3);
  image.transfer = kLinear;
  DeepOptions options;
  options.picture.metadata.icc = ProfileOf({"test", 1, 8});
  ColourDescription& colours = options.picture.metadata.colours;
  colours = {"gAMA", ColourDescription::kUnspecified, ColourDescription::kGiven};
  colours.gamma = 100000;
  for (const std::string name : {"a.png", "a.tif", "a.avif", "a.heic"}) {
    if (CheckDeepEncoder(name) || !HasLibpng()) continue;
    CAPTURE(name);
    const Written written = WriteAndRead(folder, name, image, options);
    CHECK(written.picture.deep->transfer == kLinear);
    CHECK(written.picture.metadata.icc == options.picture.metadata.icc);
    CHECK(written.notes.empty());
    const std::string text(written.bytes.begin(), written.bytes.end());
    CHECK(!Contains(text, "cICP"));
    if (Contains(text, "nclx")) CHECK(Contains(text, "nclx" + Big(1, 2) + Big(8, 2)));
  }
}

TEST_CASE("writers: refused names and transfers leave no file, and a note tells of lost EXIF") {
  TempFolder folder;
  std::vector<std::string> notes;
  const DeepImage image = DeepPattern(2, 2, 3);
  for (const char* name : {"a.jpg", "a", "a.webp"}) {
    CHECK(Contains(WriteDeepImage(folder.file(name), image, {}, &notes),
                   "expected a name ending in .png, .tif, .tiff, .exr, .avif or .heic"));
    CHECK(Contains(CheckDeepOutput(folder.file(name)), "expected a name ending in .png"));
    CHECK(!ReadFile(folder.file(name)));
  }
  CHECK(Contains(CheckDeepOutput(folder.file("none/a.png")), "none"));
  if (CheckTiffEncoder("a.tif")) return;
  DeepOptions options;
  options.picture.metadata.exif = {'I', 'I'};
  REQUIRE(WriteDeepImage(folder.file("exif.tif"), image, options, &notes) == "");
  CHECK(notes == std::vector<std::string>{"the file does not keep EXIF"});
  DeepImage pq = image;
  pq.transfer = kPq;
  CHECK(Contains(WriteDeepImage(folder.file("a.tif"), pq, {}, &notes),
                 "expected the extension .png, .exr, .avif or .heic for a picture of PQ or HLG"));
  CHECK(!ReadFile(folder.file("a.tif")));
}

}  // namespace
}  // namespace starfocus::deep_files_test
