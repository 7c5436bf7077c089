// SPDX-License-Identifier: Apache-2.0
// Opens photos with the mattes that segmentation programs write: alpha channels, grey levels and
// arrays of floats, in every orientation.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "platform/readers/matte.h"
#include "platform/readers/orientation.h"
#include "tests/readers/depth_scene.h"

namespace starfocus::photo_matte_test {
namespace {

using namespace depth_scene;

// Alpha of a subject that is opaque in the box of the scene. Its left border is half covered.
FloatMap MatteMap() {
  FloatMap matte = MapOf({0, 0, 1});
  for (int y = 8; y < 26; ++y) matte.values[Index(16, y)] = 0.4F;
  return matte;
}

FloatMap Times(FloatMap map, float factor) {
  for (float& value : map.values) value *= factor;
  return map;
}

// Returns an NPY file of 32-bit integers.
std::string IntegersOf(const FloatMap& map) {
  FloatMap bits = map;
  for (float& value : bits.values) {
    const auto integer = static_cast<int32_t>(std::lround(value));
    std::memcpy(&value, &integer, sizeof value);
  }
  const std::string npy = NpyOf(bits);
  return std::string(npy).replace(npy.find("<f4"), 3, "<i4");
}

// Returns a PNG file whose alpha channel, or whose grey channel if `channels` is 1, is the matte.
// The colours are random.
std::string PngOf(const FloatMap& matte, int channels) {
  const int colour = channels == 4 ? 6 : 0;
  const Image noise = Noise(matte.width, matte.height);
  std::string samples;
  for (size_t k = 0; k < matte.values.size(); ++k) {
    if (channels == 4)
      samples.append(noise.pixels.begin() + int(3 * k), noise.pixels.begin() + int(3 * k + 3));
    samples += static_cast<char>(std::lround(255 * double(matte.values[k])));
  }
  return Png(uint32_t(matte.width), uint32_t(matte.height), {8, colour}, samples,
             size_t(matte.width) * size_t(channels));
}

// Opens a photo with the orientation and a matte of the given content.
Result<Capture> Open(int orientation, const Image& picture, const std::string& matte,
                     const DepthOptions& options = {}) {
  TempFolder folder;
  Write(folder.file("photo.jpg"), Insert(Encode(picture, ".jpg"), ExifSegment(orientation, 0)));
  Write(folder.file("matte"), matte);
  CaptureOptions wanted;
  wanted.map = options;
  wanted.matte = folder.file("matte");
  return OpenCapture(folder.file("photo.jpg"), wanted);
}

std::string ErrorOf(const std::string& matte) {
  return Open(1, Plain(kColumns, kRows, 90), matte).error().line();
}

TEST_CASE("mattes: a photo without depth becomes two surfaces with the matte as coverage") {
  const Capture capture = ValueOf(Open(1, Plain(kColumns, kRows, 90), PngOf(MatteMap(), 1)));
  const LightField& field = capture.light_field;
  REQUIRE(field.coverage.size() == size_t(kColumns) * kRows);
  for (size_t k = 0; k < field.coverage.size(); ++k) {
    const float alpha = MatteMap().values[k];
    CHECK(int(field.coverage[k]) == std::lround(255 * double(alpha)));
    // The engine rounds disparities to 1/64 pixel.
    CHECK(double(field.disparity.values[k]) ==
          doctest::Approx(alpha > 0.5F ? kNearest : 0).epsilon(0.5 / 64 / kNearest));
  }
  CHECK(capture.care == MapCare::kNone);
  CHECK(capture.format == "photo and matte");
}

TEST_CASE("mattes: every format of one matte gives the same light field") {
  const Image photo = Plain(kColumns, kRows, 90);
  // Values of 102/255 are exact in all formats.
  const FloatMap matte = MatteMap();
  const LightField field = ValueOf(Open(1, photo, PngOf(matte, 1))).light_field;
  for (const std::string& file :
       {PngOf(matte, 4), PfmOf(matte), PfmOf(Times(matte, 255)), NpyOf(matte),
        NpyOf(Times(matte, 255)), NpyOf(Times(matte, 1.005F)), IntegersOf(Times(matte, 255))}) {
    const LightField other = ValueOf(Open(1, photo, file)).light_field;
    CHECK(other.disparity.values == field.disparity.values);
    CHECK(std::equal(field.coverage.begin(), field.coverage.end(), other.coverage.begin(),
                     [](int a, int b) { return std::abs(a - b) <= 1; }));
  }
  // Masks of labels contain 0 and 1 only.
  FloatMap labels = MapOf({0, 0, 1.0 / 255});
  for (const std::string& file : {PngOf(labels, 1), IntegersOf(MapOf({0, 0, 1}))}) {
    const LightField mask = ValueOf(Open(1, photo, file)).light_field;
    CHECK(mask.coverage[Index(kBox[0], kBox[1])] == 255);
  }
}

TEST_CASE("mattes: an alpha channel that is opaque everywhere does not replace the grey levels") {
  std::string samples;
  for (const float alpha : MatteMap().values) {
    samples += static_cast<char>(std::lround(255 * double(alpha)));
    samples += '\xff';
  }
  const std::string file = Png(kColumns, kRows, {8, 4}, samples, 2 * size_t(kColumns));
  const Image photo = Plain(kColumns, kRows, 90);
  CHECK(ValueOf(Open(1, photo, file)).light_field.coverage ==
        ValueOf(Open(1, photo, PngOf(MatteMap(), 1))).light_field.coverage);
}

#ifdef STARFOCUS_HAS_EXIF
TEST_CASE("mattes: a matte is rotated with its photo, unless it is upright already") {
  const FloatMap matte = MatteMap();
  Image picture = Plain(kColumns, kRows, 60);
  for (int y = 8; y < 26; ++y) std::fill_n(picture.row(y) + 3 * 16, 3 * 12, uint8_t{200});
  for (int orientation = 1; orientation <= 8; ++orientation) {
    CAPTURE(orientation);
    FloatMap upright = matte;
    TurnMap(orientation, &upright);
    const Capture by_file = ValueOf(Open(orientation, picture, PngOf(matte, 4)));
    const Capture by_upright = ValueOf(Open(orientation, picture, PngOf(upright, 1)));
    CHECK(by_file.light_field.disparity.width == upright.width);
    CHECK(by_file.light_field.disparity.values == by_upright.light_field.disparity.values);
    CHECK(by_file.light_field.coverage == by_upright.light_field.coverage);
    CHECK(by_file.light_field.coverage == Matte(upright).alpha);
    const bool judged = orientation > 1 && orientation < 5;
    CHECK(HasNote(by_upright, "the matte is taken to be upright already") == judged);
    DepthOptions options;
    options.orientation = DepthOrientation::kUpright;
    const Capture told = ValueOf(Open(orientation, picture, PngOf(upright, 1), options));
    CHECK(told.light_field.coverage == by_file.light_field.coverage);
    CHECK(told.notes.empty());
  }
}

TEST_CASE("mattes: depth picture and matte are rotated independently") {
  // The map and the matte show the same box, which is not symmetric in any orientation.
  Image picture = Plain(kColumns, kRows, 60);
  for (int y = 8; y < 26; ++y) std::fill_n(picture.row(y) + 3 * 16, 3 * 12, uint8_t{200});
  for (int orientation = 1; orientation <= 8; ++orientation) {
    for (const int upright : {0, 1, 2, 3}) {
      CAPTURE(orientation);
      CAPTURE(upright);
      FloatMap depth = MatteMap(), matte = MatteMap(), expected = MatteMap();
      TurnMap(orientation, &expected);
      if ((upright & 1) != 0) depth = expected;
      if ((upright & 2) != 0) matte = expected;
      TempFolder folder;
      Write(folder.file("photo.jpg"), Insert(Encode(picture, ".jpg"), ExifSegment(orientation, 0)));
      Write(folder.file("depth.pfm"), PfmOf(depth));
      Write(folder.file("matte.png"), PngOf(matte, 1));
      CaptureOptions options;
      options.depth = folder.file("depth.pfm");
      options.matte = folder.file("matte.png");
      const Capture capture = ValueOf(OpenCapture(folder.file("photo.jpg"), options));
      CHECK(capture.matte.alpha == Matte(expected).alpha);
      CHECK(capture.light_field.disparity.width == expected.width);
      for (size_t k = 0; k < expected.values.size(); ++k) {
        REQUIRE((capture.light_field.disparity.values[k] > 0.5 * kNearest) ==
                (expected.values[k] > 0.5F));
      }
      // The picture that a command receives is upright, and so is its map.
      options.depth.clear();
      options.map.near = Near::kWhite;
      options.map.estimate = [&](const Image&) -> Result<Samples> { return Samples{expected}; };
      const Capture computed = ValueOf(OpenCapture(folder.file("photo.jpg"), options));
      CHECK(computed.matte.alpha == Matte(expected).alpha);
      CHECK(computed.light_field.disparity.values == capture.light_field.disparity.values);
    }
  }
}
#endif

TEST_CASE("mattes: a square matte is stretched over the picture, with a note") {
  const FloatMap matte = MatteMap();
  Image picture = Plain(kColumns, kRows, 60);
  for (int y = 8; y < 26; ++y) std::fill_n(picture.row(y) + 3 * 16, 3 * 12, uint8_t{200});
  for (const int orientation : {1, 6}) {
    const Capture capture =
        ValueOf(Open(orientation, picture, PngOf(Resize(matte, 2 * kColumns, 2 * kColumns), 1)));
    FloatMap upright = matte;
    TurnMap(orientation, &upright);
    CHECK(HasNote(capture, "is stretched over the picture"));
    const std::vector<uint8_t>&given = capture.light_field.coverage,
          expected = Matte(upright).alpha;
    REQUIRE(given.size() == expected.size());
    int differing = 0;  // pixels beside outlines, which resampling softens
    for (size_t k = 0; k < given.size(); ++k) differing += std::abs(given[k] - expected[k]) > 60;
    CHECK(differing < 20);
  }
}

TEST_CASE("mattes: the floor reaches the subject at its feet") {
  DepthOptions options;
  options.floor = true;
  const FloatMap map = ValueOf(Open(1, Plain(kColumns, kRows, 90), PngOf(MatteMap(), 1), options))
                           .light_field.disparity;
  // The subject is in rows 8 to 25 of 36, so that the horizon is at row 17 and the feet at row 26.
  CHECK(map.at(0, 16) == 0);
  CHECK(map.at(0, 17) > 0);
  CHECK(map.at(0, 21) == doctest::Approx(kNearest * 4.5 / 9).epsilon(0.05));
  for (const int y : {26, 35})
    CHECK(double(map.at(0, y)) == doctest::Approx(kNearest).epsilon(0.05));
}

TEST_CASE("mattes: with a map, the matte is the coverage of the outline that both share") {
  LightField field;
  field.views = {Plain(kColumns, kRows, 90)};
  // The map has a second surface at the right, which the matte does not contain.
  field.disparity = MapOf({0, 0, 20});
  for (int y = 0; y < kRows; ++y) {
    for (int x = 40; x < kColumns; ++x) field.disparity.values[Index(x, y)] = 20;
  }
  ThreadRunner runner(2);
  REQUIRE(CoverByMatte("photo", Matte(MatteMap()), &runner, &field) == "");
  CHECK(field.coverage[Index(20, 15)] == 255);
  CHECK(std::abs(field.coverage[Index(16, 15)] - 102) <= 10);
  CHECK(field.coverage[Index(34, 15)] == 0);
  CHECK(field.coverage[Index(45, 15)] == 255);
}

TEST_CASE("mattes: unsuitable mattes are rejected with their cause") {
  const std::string size = std::to_string(kColumns) + "x" + std::to_string(kRows);
  FloatMap nan = MatteMap();
  nan.values[5] = kNan;
  const std::vector<std::pair<std::string, std::string>> cases = {
      {Encode(Plain(kColumns, kRows, 0), ".png"), "an empty matte, alpha up to 0"},
      {Encode(Plain(kColumns, kRows, 100), ".png"), "an empty matte, alpha up to 0.392157"},
      {Encode(Plain(kColumns, kRows, 255), ".png"), "a full matte"},
      {Encode(Noise(kColumns, kRows), ".png"), "found an opaque colour picture"},
      {Encode(Ramp(40, 36), ".png"),
       "a matte with the proportions of the picture, or a square matte of a network, found "
       "40x36 for " +
           size},
      {PngOf(MapOf({0, 0, 1.0 / 255}), 4), "an empty matte, alpha up to 0.00392157"},
      {NpyOf(MapOf({0, 0, 1.03})),
       "expected alpha from 0 to 1 or from 0 to 255, found values from 0 to 1.03"},
      {IntegersOf(MapOf({0, 0, 2})), "found values from 0 to 2"},
      {IntegersOf(MapOf({0, 0, 65535})), "found values from 0 to 65535"},
      {NpyOf(MapOf({-12, -12, 9})), "found values from -12 to 9"},
      {NpyOf(MapOf({0, 0, 3000})), "found values from 0 to 3000"},
      {NpyOf(nan), "found NaN or infinity"},
      {"no picture", "(convert the matte to PNG)"},
      {"v/1\x01 and more", "(oiiotool FILE --ch A -o matte.png writes its alpha channel)"}};
  for (const auto& wrong : cases) {
    CAPTURE(wrong.second);
    CHECK(Contains(ErrorOf(wrong.first), wrong.second));
  }
}

}  // namespace
}  // namespace starfocus::photo_matte_test
