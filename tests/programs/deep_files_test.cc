// SPDX-License-Identifier: Apache-2.0
// Tests files of pictures with more than 8 bits or alpha. The tests write PNG and OpenEXR files
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
#include "platform/readers/depth_photo_file.h"
#include "platform/readers/orientation.h"
#include "platform/writers/deep_picture.h"
#include "platform/writers/exr.h"
#include "platform/writers/heif.h"
#include "platform/writers/tiff.h"
#include "tests/support/error_line.h"
#include "tests/support/photo_files.h"
#include "tests/support/temp_folder.h"

namespace starfocus::deep_files_test {
namespace {

using namespace photos;

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

std::string Little(uint64_t value, int bytes) {
  std::string text;
  for (int k = 0; k < bytes; ++k) text += static_cast<char>(value >> 8 * k);
  return text;
}

std::string LittleFloat(float value) {
  uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof(bits));
  return Little(bits, 4);
}

// A channel of an OpenEXR file. `values` are its samples in rows.
struct Channel {
  std::string name;
  bool is_half;
  std::vector<float> values;
};

struct Box {
  int left, top, right, bottom;
};

std::string Attribute(const std::string& name, const std::string& type, const std::string& value) {
  return name + '\0' + type + '\0' + Little(value.size(), 4) + value;
}

std::string BoxText(const Box& box) {
  std::string text;
  for (const int side : {box.left, box.top, box.right, box.bottom}) {
    text += Little(static_cast<uint32_t>(side), 4);
  }
  return text;
}

struct Part {
  std::vector<Channel> channels;  // sorted by name
  Box data, display;
  std::string more = {};
};

std::string HeaderOf(const Part& part) {
  std::string list;
  for (const Channel& channel : part.channels) {
    list += channel.name + '\0' + Little(channel.is_half ? 1 : 2, 4) + std::string(4, '\0') +
            Little(1, 4) + Little(1, 4);
  }
  const std::string zero = std::string(1, '\0'), one = LittleFloat(1);
  return Attribute("channels", "chlist", list + zero) +
         Attribute("compression", "compression", zero) +
         Attribute("dataWindow", "box2i", BoxText(part.data)) +
         Attribute("displayWindow", "box2i", BoxText(part.display)) +
         Attribute("lineOrder", "lineOrder", zero) + Attribute("pixelAspectRatio", "float", one) +
         Attribute("screenWindowCenter", "v2f", std::string(8, '\0')) +
         Attribute("screenWindowWidth", "float", one) + part.more + zero;
}

// Returns an OpenEXR file without compression ("OpenEXR File Layout").
std::string Exr(const std::vector<Part>& parts) {
  const bool multi = parts.size() > 1;
  std::string file = "v/1\1" + Little(multi ? 0x1002 : 2, 4);
  size_t rows = 0;
  for (const Part& part : parts) {
    file += HeaderOf(part);
    rows += size_t(part.data.bottom - part.data.top + 1);
  }
  if (multi) file += '\0';
  const size_t first = file.size() + 8 * rows;
  std::string table, chunks;
  for (size_t number = 0; number < parts.size(); ++number) {
    const Part& part = parts[number];
    const auto width = size_t(part.data.right - part.data.left + 1);
    for (int y = part.data.top; y <= part.data.bottom; ++y) {
      std::string samples;
      for (const Channel& channel : part.channels) {
        for (size_t x = 0; x < width; ++x) {
          const float value = channel.values.at(size_t(y - part.data.top) * width + x);
          samples += channel.is_half ? Little(HalfOfFloat(value), 2) : LittleFloat(value);
        }
      }
      table += Little(first + chunks.size(), 8);
      if (multi) chunks += Little(number, 4);
      chunks += Little(uint32_t(y), 4) + Little(samples.size(), 4) + samples;
    }
  }
  return file + table + chunks;
}

// Attributes that a part of a file of several parts has.
std::string Named(const std::string& name, int rows) {
  return Attribute("chunkCount", "int", Little(uint32_t(rows), 4)) +
         Attribute("name", "string", name) + Attribute("type", "string", "scanlineimage");
}

const Box kTwo = {0, 0, 1, 0};  // two pixels in a row

Part Colours(float red, const std::string& more = {}) {
  return {
      {{"B", true, {3, 0.5F}}, {"G", true, {-1, 0.25F}}, {"R", false, {red, 0}}}, kTwo, kTwo, more};
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

TEST_CASE("OpenEXR: colours of the display window are read as half floats") {
  if (!HasExr()) return;
  const Result<DecodedPicture> plain = Decode(Exr({Colours(2)}));
  CHECK(LightsOf(plain) == std::vector<float>{2, -1, 3, 0, 0.25F, 0.5F});
  // Codes of sRGB for 0.25 and 0.5.
  CHECK(std::vector<int>(plain->image.pixels.begin(), plain->image.pixels.end()) ==
        std::vector<int>{255, 0, 255, 0, 137, 188});
  CHECK_FALSE(plain->is_transparent);
  // Premultiplied colours; the display window is larger than the data window on three sides, and
  // smaller on one side.
  const Part windowed = {{{"A", true, {0.5F, 1, 1, 1}},
                          {"B", true, {1, 2, 3, 4}},
                          {"G", true, {5, 6, 7, 8}},
                          {"R", true, {9, 10, 11, 12}}},
                         {-1, 7, 0, 8},
                         {0, 6, 1, 9}};
  const Result<DecodedPicture> part = Decode(Exr({windowed}));
  CHECK(LightsOf(part) == std::vector<float>{0,  0, 0, 0, 0, 0, 0, 0, 10, 6, 2, 1, 0, 0, 0, 0,
                                             12, 8, 4, 1, 0, 0, 0, 0, 0,  0, 0, 0, 0, 0, 0, 0});
  CHECK(part->is_transparent);
  const Part grey = {{{"A", true, {1, 0.5F}}, {"Y", true, {2, 0.25F}}}, kTwo, kTwo};
  CHECK(LightsOf(Decode(Exr({grey}))) == std::vector<float>{2, 2, 2, 1, 0.25F, 0.25F, 0.25F, 0.5F});
}

TEST_CASE("OpenEXR: the first picture that is no right view is read, and a note names it") {
  if (!HasExr()) return;
  const Part distances = {{{"Z", false, {4, 5}}}, kTwo, kTwo, Named("depth_left", 1)};
  Part layer = Colours(7, Named("beauty", 1));
  for (Channel& channel : layer.channels) channel.name = "beauty." + channel.name;
  const std::vector<std::tuple<std::vector<Part>, float, std::string>> rows = {
      {{Colours(5, Named("rgba_right", 1)), distances, Colours(6, Named("rgba_left", 1))},
       6,
       "the file has 2 pictures, of which the program reads rgba_left"},
      {{Colours(5, Named("a", 1) + Attribute("view", "string", "right")),
        Colours(6, Named("b", 1) + Attribute("view", "string", "left"))},
       6,
       "reads b"},
      {{distances, layer}, 7, ""},
      {{layer, Colours(8, Named("c", 1))}, 7, "reads beauty"},
  };
  for (const auto& [parts, red, note] : rows) {
    CAPTURE(note);
    const Bytes file = BytesOf(Exr(parts));
    const Result<DepthPhoto> photo =
        DecodeDepthPhoto("a.exr", {file.data(), file.size()}, false, Near::kUnknown);
    REQUIRE(photo == "");
    REQUIRE(photo->deep);
    CHECK(FloatOfHalf(photo->deep->samples[0]) == red);
    std::string notes;
    for (const std::string& text : photo->notes) notes += text + "\n";
    CHECK(Contains(notes, note));
    CHECK(Contains(notes, "pictures") == !note.empty());
    CHECK(Contains(notes, "light brighter than white"));
  }
}

using FactList = std::vector<std::pair<std::string, std::string>>;

Result<DepthPhoto> ReadPhoto(const std::string& file) {
  const Bytes bytes = BytesOf(file);
  return DecodeDepthPhoto("photo", {bytes.data(), bytes.size()}, true, Near::kUnknown);
}

TEST_CASE("OpenEXR: the channel Z is the depth of the picture in the same file") {
  if (!HasExr()) return;
  const float infinity = std::numeric_limits<float>::infinity();
  Part part = Colours(1);
  part.channels.push_back({"Z", false, {4, -1}});
  part.display = {0, 0, 2, 0};
  const Result<DepthPhoto> photo = ReadPhoto(Exr({part}));
  REQUIRE(photo == "");
  CHECK(photo->format == "OpenEXR picture with depth");
  CHECK(photo->meaning == MapMeaning::kInverse);
  REQUIRE(photo->map.values.size() == 3);
  CHECK(photo->map.values[0] == 1 / 4.0F);
  CHECK(std::isnan(photo->map.values[1]));
  CHECK(photo->map.values[2] == 1 / infinity);
  CHECK(ReadPhoto(Exr({Colours(1)}))->map.values.empty());
}

TEST_CASE("facts: bits, transfer, primaries, alpha and headroom describe pictures of 16 bits") {
  const auto facts = [](const std::string& file) {
    const Result<DepthPhoto> photo = ReadPhoto(file);
    REQUIRE(photo == "");
    return photo->facts;
  };
  constexpr int kRgb = 2, kRgba = 6;
  if (HasLibpng()) {
    CHECK(facts(Png(1, 1, {8, kRgb}, "\1\2\3", 3)).empty());
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
  Part part = Colours(6.5F);
  part.channels.insert(part.channels.begin(), {"A", true, {0.5F, 1}});
  CHECK(facts(Exr({part})) == FactList{{"samples", "16 bits, floats"},
                                       {"transfer", "linear light"},
                                       {"primaries", "BT.709"},
                                       {"alpha", "premultiplied"},
                                       {"headroom", "6.5 times white"}});
}

TEST_CASE("orientation: the picture of 16 bits turns with the picture of 8 bits") {
  if (!HasExr()) return;
  for (int orientation = 2; orientation <= 8; ++orientation) {
    CAPTURE(orientation);
    Part part = {{}, {0, 0, 2, 1}, {0, 0, 2, 1}};
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

TEST_CASE("OpenEXR: samples that are not finite are replaced, and a note counts them") {
  if (!HasExr()) return;
  const float infinity = std::numeric_limits<float>::infinity();
  const Part part = {{{"B", true, {infinity, -infinity}},
                      {"G", false, {1e6F, std::nanf("")}},
                      {"R", true, {65504, 1}}},
                     kTwo,
                     kTwo};
  const Bytes file = BytesOf(Exr({part}));
  const Result<DepthPhoto> photo =
      DecodeDepthPhoto("a.exr", {file.data(), file.size()}, false, Near::kUnknown);
  REQUIRE(photo == "");
  CHECK(LightsOf(*photo->deep) == std::vector<float>{65504, 65504, 65504, 1, 0, -65504});
  REQUIRE(!photo->notes.empty());
  CHECK(Contains(photo->notes[0], "4 samples that are infinite, not a number or beyond 65504"));
}

TEST_CASE("OpenEXR: depth, disparities and mattes are read from their channels") {
  if (!HasExr()) return;
  const float infinity = std::numeric_limits<float>::infinity();
  const Box wide = {0, 0, 2, 0};
  const auto one = [&](const std::string& name) {
    return Part{{{name, false, {0.1F, 5}}}, kTwo, wide, Named(name, 1)};
  };
  const auto read = [](const std::vector<Part>& parts, Alpha alpha) {
    return DecodeDepthFile("map", alpha, BytesOf(Exr(parts)));
  };
  const auto values = [&](const std::vector<Part>& parts, Alpha alpha) {
    const Result<Samples> samples = read(parts, alpha);
    REQUIRE(samples == "");
    CHECK(std::tuple(samples->map.width, samples->map.height) == std::tuple(3, 1));
    CHECK(samples->largest == 0);
    return samples->map.values;
  };
  const std::vector<float> far = {0.1F, 5, infinity}, dark = {0.1F, 5, 0};
  CHECK(values({one("Z")}, Alpha::kTransparent) == far);
  CHECK(values({one("disparity.x"), one("left.Z")}, Alpha::kTransparent) == far);
  for (const char* name : {"disparity.x", "depth", "Depth.V", "Y"}) {
    CAPTURE(name);
    const std::vector<float> found = values({one(name)}, Alpha::kTransparent);
    CHECK(std::vector<float>(found.begin(), found.begin() + 2) == std::vector<float>{0.1F, 5});
    CHECK(std::isnan(found[2]));
    CHECK(read({one(name)}, Alpha::kTransparent)->larger_is_nearer ==
          (name == std::string("disparity.x")));
  }
  Part colours = Colours(1, Named("c", 1));
  colours.display = wide;
  CHECK(values({colours, one("A")}, Alpha::kTaken) == dark);
  CHECK(values({one("Y")}, Alpha::kTaken) == dark);
  CHECK(Contains(read({Colours(1)}, Alpha::kTransparent),
                 "expected an OpenEXR file with the channel Z or with one channel, found the "
                 "channels B, G, R"));
  CHECK(Contains(read({Colours(1)}, Alpha::kTaken), "with the channel A or with one channel"));
}

TEST_CASE("OpenEXR: damaged and excessive files are rejected before memory is allocated") {
  if (!HasExr()) return;
  const std::string whole = Exr({Colours(1)});
  for (size_t size = 4; size < whole.size(); ++size) {
    const Result<DecodedPicture> picture = Decode(whole.substr(0, size));
    if (!Contains(picture, "a: expected an undamaged OpenEXR file")) FAIL_CHECK(size);
  }
  const auto with = [](const Box& data, const Box& display) {
    Part part = Colours(1);
    const std::string file = Exr({part});
    std::string changed = file;
    changed.replace(file.find("dataWindow") + 21, 16, BoxText(data));
    changed.replace(file.find("displayWindow") + 24, 16, BoxText(display));
    return changed;
  };
  CHECK(Decode(with(kTwo, kTwo)) == "");
  CHECK(Contains(Decode(with(kTwo, {0, 0, 65535, 9})), "width and height from 1 to 65535"));
  CHECK(Contains(Decode(with(kTwo, {0, 0, 20000, 20000})), "at most 2^28 pixels"));
  CHECK(Contains(Decode(with(kTwo, {0, 0, 9999, 9999})), "too small for its pixels"));
  CHECK(Contains(Decode(with({0, 0, 9999, 9999}, kTwo)), "an undamaged OpenEXR file"));
  CHECK(Contains(Decode(with({900000, 0, 900001, 0}, kTwo)), "far away"));
  CHECK(Contains(Decode(with({0, 0, -2147483647, 0}, kTwo)), "OpenEXR"));
  CHECK(Contains(Decode(Exr({{{{"Z", false, {1, 2}}}, kTwo, kTwo}})),
                 "with the channels R, G and B, or Y, found the channels Z"));
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
  const std::string lights = LittleFloat(2) + LittleFloat(-0.5F) + LittleFloat(1e9F);
  CHECK(LightsOf(Decode(Tiff(1, 3, 32, {{kFormat, kFloat}}, lights))) ==
        std::vector<float>{2, -0.5F, 65504});
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
  const std::vector<std::tuple<Tags, std::string>> rows = {
      {{{254, 1}}, "found a raw file"},
      {{{262, 6}}, "found 3 samples of photometric interpretation 6"},
      {{{284, 2}}, "a TIFF picture of interleaved RGB or grey"},
      {{{339, 2}}, "found 16-bit signed integers"},
      {{{274, 6}}, "a TIFF of orientation 1, found 6"},
      {{{259, 7}}, "found compression 7 (convert it to PNG"},
      {{{256, 65536}}, "width and height from 1 to 65535"},
      {{{256, 16384}, {257, 16384}}, "too small for its pixels"}};
  for (const auto& [tags, error] : rows) {
    CAPTURE(error);
    CHECK(Contains(Decode(Tiff(1, 3, 16, tags, strip)), error));
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

TEST_CASE("writers: refused names and transfers leave no file") {
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
  DeepImage pq = image;
  pq.transfer = kPq;
  CHECK(Contains(WriteDeepImage(folder.file("a.tif"), pq, {}, &notes),
                 "expected the extension .png, .exr, .avif or .heic for a picture of PQ or HLG"));
  CHECK(!ReadFile(folder.file("a.tif")));
}

}  // namespace
}  // namespace starfocus::deep_files_test
