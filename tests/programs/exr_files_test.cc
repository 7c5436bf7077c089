// SPDX-License-Identifier: Apache-2.0
// Tests the decoder of OpenEXR with files that the tests write byte by byte.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "platform/decoders/exr.h"
#include "platform/deep_image.h"
#include "platform/depth_file.h"
#include "platform/image_io.h"
#include "platform/readers/depth_photo_file.h"
#include "platform/writers/exr.h"
#include "tests/support/error_line.h"
#include "tests/support/exr_file.h"
#include "tests/support/temp_folder.h"

namespace starfocus::exr_files_test {
namespace {

using namespace exr_file;

Bytes BytesOf(const std::string& text) { return {text.begin(), text.end()}; }

Result<DecodedPicture> Decode(const std::string& file) { return DecodeImage("a", BytesOf(file)); }

bool HasExr() { return !CheckExrEncoder("a.exr"); }

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

Result<DepthPhoto> ReadPhoto(const std::string& file) {
  const Bytes bytes = BytesOf(file);
  return DecodeDepthPhoto("photo", {bytes.data(), bytes.size()}, true, Near::kUnknown);
}

TEST_CASE("OpenEXR: colours of the display window are read as half floats") {
  if (!HasExr()) return;
  const Result<DecodedPicture> plain = Decode(Exr({Colours(2)}));
  CHECK(LightsOf(plain) == std::vector<float>{2, -1, 3, 0, 0.25F, 0.5F});
  // Codes of sRGB for 0.25 and 0.5.
  CHECK(std::vector<int>(plain->image.pixels.begin(), plain->image.pixels.end()) ==
        std::vector<int>{255, 0, 255, 0, 137, 188});
  CHECK_FALSE(plain->is_transparent);
  CHECK(plain->deep->bits == 32);  // R
  CHECK(plain->notes.empty());
  // Premultiplied colours; the display window is larger than the data window on three sides, and
  // smaller on one side.
  const ExrPart windowed = {{{"A", true, {0.5F, 1, 1, 1}},
                             {"B", true, {1, 2, 3, 4}},
                             {"G", true, {5, 6, 7, 8}},
                             {"R", true, {9, 10, 11, 12}}},
                            {-1, 7, 0, 8},
                            {0, 6, 1, 9}};
  const Result<DecodedPicture> part = Decode(Exr({windowed}));
  CHECK(LightsOf(part) == std::vector<float>{0,  0, 0, 0, 0, 0, 0, 0, 10, 6, 2, 1, 0, 0, 0, 0,
                                             12, 8, 4, 1, 0, 0, 0, 0, 0,  0, 0, 0, 0, 0, 0, 0});
  CHECK(part->is_transparent);
  CHECK(part->deep->bits == 16);
  REQUIRE(part->notes.size() == 2);
  CHECK(part->notes[0] == "the pixels outside of the display window are left out");
  CHECK(Contains(part->notes[1], "starts at 0,6,"));
  const ExrPart grey = {{{"A", true, {1, 0.5F}}, {"Y", true, {2, 0.25F}}}, kTwo, kTwo};
  CHECK(LightsOf(Decode(Exr({grey}))) == std::vector<float>{2, 2, 2, 1, 0.25F, 0.25F, 0.25F, 0.5F});
}

TEST_CASE("OpenEXR: the first picture that is no right view is read, and a note names it") {
  if (!HasExr()) return;
  const ExrPart distances = {{{"Z", false, {4, 5}}}, kTwo, kTwo, Named("depth_left", 1)};
  ExrPart layer = Colours(7, Named("beauty", 1));
  for (Channel& channel : layer.channels) channel.name = "beauty." + channel.name;
  const struct {
    std::vector<ExrPart> parts;
    float red;
    std::string note;
  } rows[] = {
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
  for (const auto& row : rows) {
    CAPTURE(row.note);
    const Bytes file = BytesOf(Exr(row.parts));
    const Result<DepthPhoto> photo =
        DecodeDepthPhoto("a.exr", {file.data(), file.size()}, false, Near::kUnknown);
    REQUIRE(photo == "");
    REQUIRE(photo->deep);
    CHECK(FloatOfHalf(photo->deep->samples[0]) == row.red);
    std::string notes;
    for (const std::string& text : photo->notes) notes += text + "\n";
    CHECK(Contains(notes, row.note));
    CHECK(Contains(notes, "pictures") == !row.note.empty());
    REQUIRE(photo->lost.size() == 1);
    CHECK(Contains(photo->lost[0], "light brighter than white"));
  }
}

TEST_CASE("OpenEXR: the channel Z is the depth of the picture in the same file") {
  if (!HasExr()) return;
  const float infinity = std::numeric_limits<float>::infinity();
  ExrPart part = Colours(1);
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
  TempFolder folder;
  const Bytes file = BytesOf(Exr({part}));
  REQUIRE(WriteFile(folder.file("z.exr"), file) == "");
  DepthOptions options;
  options.unit = DepthUnit::kDistance;
  options.metres = 2;
  const DepthPhoto metres = ValueOf(ReadDepthPhotoFile(folder.file("z.exr"), options, {}));
  CHECK(metres.meaning == MapMeaning::kInverseMetres);
  CHECK(metres.map.values[0] == 1 / 8.0F);
  CHECK(metres.facts.back().second == "3x1, distances of the channel Z");
}

TEST_CASE("OpenEXR: infinite samples are limited, and unusable light is counted") {
  if (!HasExr()) return;
  const float infinity = std::numeric_limits<float>::infinity();
  const ExrPart part = {{{"B", true, {infinity, -infinity}},
                         {"G", false, {1e6F, std::nanf("")}},
                         {"R", true, {65504, 1}}},
                        kTwo,
                        kTwo};
  const Bytes file = BytesOf(Exr({part}));
  const Result<DepthPhoto> photo =
      DecodeDepthPhoto("a.exr", {file.data(), file.size()}, false, Near::kUnknown);
  REQUIRE(photo == "");
  std::vector<float> lights = LightsOf(*photo->deep);
  CHECK(std::isnan(lights[4]));
  lights[4] = 0;
  CHECK(lights == std::vector<float>{65504, 65504, 65504, 1, 0, -65504});
  CHECK(photo->picture.pixels == Bytes{255, 255, 255, 255, 0, 0});
  UnusableLight counts;
  CountUnusable(*photo->deep, &counts);
  CHECK(std::tuple(counts.not_a_number, counts.negative, counts.too_bright) == std::tuple(1, 1, 1));
  CHECK(counts.alpha == 0);
  const ExrPart covered = {{{"A", true, {-0.5F, 2}}, {"Y", true, {1, 1}}}, kTwo, kTwo};
  CountUnusable(*ValueOf(ReadPhoto(Exr({covered}))).deep, &counts);
  CHECK(counts.alpha == 2);
}

TEST_CASE("OpenEXR: depth, disparities and mattes are read from their channels") {
  if (!HasExr()) return;
  const float infinity = std::numeric_limits<float>::infinity();
  const Box wide = {0, 0, 2, 0};
  const auto one = [&](const std::string& name) {
    return ExrPart{{{name, false, {0.1F, 5}}}, kTwo, wide, Named(name, 1)};
  };
  const auto read = [](const std::vector<ExrPart>& parts, Alpha alpha) {
    return DecodeDepthFile("map", alpha, BytesOf(Exr(parts)));
  };
  const auto values = [&](const std::vector<ExrPart>& parts, Alpha alpha) {
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
  ExrPart colours = Colours(1, Named("c", 1));
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
    ExrPart part = Colours(1);
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
  // OpenEXR would read the value without its size, and then the rest of the value as a name.
  for (const auto& attribute : std::vector<std::pair<std::string, std::string>>{
           {"int", std::string(5, '\1')},
           {"stringvector", Little(1000000000, 4)},
           {"preview", Little(60000, 4) + Little(60000, 4)},
           {"chlist", std::string("R\0", 2)},
           {"floatvector", "abc"},
           {std::string(256, 't'), ""}}) {
    CAPTURE(attribute.first);
    const std::string more = Attribute("own", attribute.first, attribute.second);
    CHECK(Contains(Decode(Exr({Colours(1, more)})), "a damaged one (its header)"));
  }
  CHECK(Decode(Exr({Colours(1, Attribute("own", "owntype", "abc"))})) == "");
  CHECK(Contains(Decode(Exr({{{{"Z", false, {1, 2}}}, kTwo, kTwo}})),
                 "with the channels R, G and B, or Y, found the channels Z"));
}

}  // namespace
}  // namespace starfocus::exr_files_test
