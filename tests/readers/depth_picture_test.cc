// SPDX-License-Identifier: Apache-2.0
// Reads depth pictures in separate files. Tests unknown values and their filling, units, near ends,
// orientations, and the names of files that are found next to a photo.
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

#include "platform/levels.h"
#include "platform/readers/capture.h"
#include "platform/readers/orientation.h"
#include "platform/readers/unknown_depth.h"
#include "tests/readers/depth_scene.h"
#include "tests/support/error_line.h"

namespace starfocus::depth_picture_test {
namespace {

using namespace depth_scene;
using namespace photos;

TEST_CASE(
    "unknown depth: 0 and 65535 in 16 bits are unknown, and are filled with the surface behind") {
  for (const uint16_t unknown : {uint16_t{0}, uint16_t{65535}}) {
    CAPTURE(unknown);
    std::vector<uint16_t> levels = LevelsOf(kMillimetres);
    for (int y = 0; y < kRows; ++y) {
      for (int x = 0; x < 5; ++x) levels[Index(x, y)] = unknown;    // The left border.
      for (int x = 28; x < 31; ++x) levels[Index(x, y)] = unknown;  // A gap next to the box.
    }
    const Opened opened("map.png", GreyPng(levels), NearIs(Near::kBlack));
    CheckScene(opened);
    CHECK(opened.At(0, 4) == doctest::Approx(0));
    // The pixel is filled with the wall, not with the box.
    CHECK(opened.At(28, 15) == doctest::Approx(0));
    CHECK(opened.At(0, 35) == doctest::Approx(opened.At(40, 35)));
    CHECK(opened.HasNote("288 of 1728 pixels of the depth map are unknown"));
    CHECK(opened.HasNote("--unknown none"));
    DepthOptions none = NearIs(Near::kBlack);
    none.has_unknown = true;
    none.alpha = Alpha::kIgnored;
    const Opened known("map.png", GreyPng(levels), none);
    REQUIRE(known.error == "");
    CHECK(known.capture.notes.empty());
    CHECK(known.At(0, 4) == doctest::Approx(unknown == 0 ? kNearest : 0));
  }
}

TEST_CASE("unknown depth: 0 and 65535 are depths in a map that uses the whole range") {
  for (const bool inverted : {false, true}) {
    CAPTURE(inverted);
    const Scene scene = inverted ? Scene{65535, 18725, 0} : Scene{0, 46811, 65535};
    const Opened opened("map.png", GreyPng(LevelsOf(scene)),
                        NearIs(inverted ? Near::kBlack : Near::kWhite));
    CheckScene(opened);
    CHECK(opened.HasNote("as a known depth"));
    CHECK(opened.HasNote("--unknown"));
  }
  // In this map of a sensor, both 0 and 65535 are unknown.
  std::vector<uint16_t> both = LevelsOf(kMillimetres);
  both[Index(40, 2)] = 65535;
  both[Index(41, 2)] = 0;
  const Opened sensor("map.png", GreyPng(both), NearIs(Near::kBlack));
  CheckScene(sensor);
  CHECK(sensor.HasNote("0 and 65535 are taken as unknown"));
}

TEST_CASE("unknown depth: in 8 bits, only values that an option names are unknown") {
  Image map = Plain(kColumns, kRows, 100);
  std::fill_n(map.row(0), map.stride(), uint8_t{0});
  std::fill_n(map.row(35), map.stride(), uint8_t{200});
  const Opened own("map.png", Encode(map, ".png"), NearIs(Near::kWhite));
  REQUIRE(own.error == "");
  CHECK(own.capture.notes.empty());
  CHECK(own.At(3, 5) == doctest::Approx(kNearest / 2));
  DepthOptions zero = NearIs(Near::kWhite);
  zero.has_unknown = true;
  zero.unknown = {0};
  const Opened named("map.png", Encode(map, ".png"), zero);
  REQUIRE(named.error == "");
  CHECK(named.At(3, 0) == doctest::Approx(0));
  CHECK(named.At(3, 5) == doctest::Approx(0));
}

TEST_CASE("unknown depth: transparent pixels are unknown, by alpha channel, colour or palette") {
  const Scene scene = {50, 160, 204};
  const auto make = [&](int depth, int colour) {
    std::string samples;
    const int bytes = depth / 8;
    for (int y = 0; y < kRows; ++y) {
      for (int x = 0; x < kColumns; ++x) {
        const bool unknown = x < 6;
        const auto level = static_cast<uint32_t>(unknown ? 7 : std::lround(scene.At(x, y)));
        const int channels = colour == 6 ? 3 : 1;
        for (int c = 0; c < channels; ++c) samples += Big(level * (bytes == 2 ? 257 : 1), bytes);
        if (colour == 4 || colour == 6) samples += Big(unknown ? 0 : 0xffffffff, bytes);
      }
    }
    return samples;
  };
  std::string palette, opacities(8, '\xff');
  for (int level = 0; level < 256; ++level) palette += std::string(3, static_cast<char>(level));
  opacities[7] = 0;
  const std::string files[] = {
      Png(kColumns, kRows, {8, 4}, make(8, 4), 2 * kColumns),
      Png(kColumns, kRows, {16, 4}, make(16, 4), 4 * kColumns),
      Png(kColumns, kRows, {8, 6}, make(8, 6), 4 * kColumns),
      Png(kColumns, kRows, {16, 6}, make(16, 6), 8 * kColumns),
      Png(kColumns, kRows, {8, 0, Chunk("tRNS", Big(7, 2))}, make(8, 0), kColumns),
      Png(kColumns, kRows, {16, 0, Chunk("tRNS", Big(7 * 257, 2))}, make(16, 0), 2 * kColumns),
      Png(kColumns, kRows, {8, 3, Chunk("PLTE", palette) + Chunk("tRNS", opacities)}, make(8, 3),
          kColumns)};
  for (size_t k = 0; k < std::size(files); ++k) {
    CAPTURE(k);
    const Opened opened("map.png", files[k], NearIs(Near::kWhite));
    REQUIRE(opened.error == "");
    CHECK(opened.At(40, 4) == doctest::Approx(0));
    CHECK(opened.At(0, 4) == doctest::Approx(0));
    CHECK(opened.At(20, 15) == doctest::Approx(kNearest));
    CHECK(opened.At(40, 35) == doctest::Approx(kNearest * 110 / 154));
    CHECK(opened.HasNote("216 of 1728 pixels"));
    DepthOptions none = NearIs(Near::kWhite);
    none.has_unknown = true;
    none.alpha = Alpha::kIgnored;
    CHECK(Opened("map.png", files[k], none).At(40, 4) == doctest::Approx(kNearest * 43 / 197));
  }
}

TEST_CASE("unknown depth: in PFM, values that are not finite and single outliers are unknown") {
  for (const ByteOrder order : {ByteOrder::kLittle, ByteOrder::kBig}) {
    FloatMap map = MapOf({5, 5 + 25.0F * 1500 / 2100, 30});
    for (int y = 0; y < kRows; ++y) {
      map.values[Index(0, y)] = HUGE_VALF;
      map.values[Index(1, y)] = -HUGE_VALF;
      map.values[Index(47, y)] = kNan;
    }
    map.values[Index(30, 1)] = 1e6F;  // an outlier: one pixel of 1728
    const Opened opened("map.pfm", PfmOf(map, order), {});
    CheckScene(opened);
    CHECK(opened.At(0, 4) == doctest::Approx(0));
    CHECK(opened.At(30, 1) == doctest::Approx(kNearest));
    CHECK(opened.HasNote("108 of 1728 pixels"));
  }
  const Opened nothing("map.pfm", PfmOf({kColumns, kRows, std::vector<float>(1728, kNan)}), {});
  CHECK(Contains(nothing.error, "a map with known depths"));
}

TEST_CASE("unknown depth: a gap is filled along its shorter direction, from its farther end") {
  FloatMap map = {5, 4, {1, kNan, kNan, 7, 7,     //
                         1, kNan, 4,    7, kNan,  //
                         1, kNan, kNan, 7, kNan,  //
                         1, 2,    2,    7, kNan}};
  CHECK(FillBehind(&map) == 8);
  CHECK(map.values == std::vector<float>{1, 1, 1, 7, 7,  //
                                         1, 1, 4, 7, 7,  //
                                         1, 1, 2, 7, 7,  //
                                         1, 2, 2, 7, 7});
  FloatMap slope = {1, 6, {0, 9.6F, kNan, kNan, 9.9F, 10}};  // one surface
  CHECK(FillBehind(&slope) == 2);
  CHECK(double(slope.values[2]) == doctest::Approx(9.7));
  CHECK(double(slope.values[3]) == doctest::Approx(9.8));
  FloatMap one = {3, 3, std::vector<float>(9, kNan)};
  one.values[4] = 3;
  CHECK(FillBehind(&one) == 8);
  CHECK(one.values == std::vector<float>(9, 3));
}

TEST_CASE("depth pictures: PFM follows --near, and units keep the values unchanged") {
  const Scene metres = {3, 1.5, 0.9};
  CheckScene(Opened("map.pfm", PfmOf(MapOf(metres)), NearIs(Near::kBlack)));
  DepthOptions options = UnitIs(DepthUnit::kDistance);
  const Opened by_metre("map.pfm", PfmOf(MapOf(metres)), options);
  REQUIRE(by_metre.error == "");
  CHECK(by_metre.At(kWall[0], kWall[1]) == doctest::Approx(kNearest * 1.5 / 3));
  CHECK(by_metre.At(kBox[0], kBox[1]) == doctest::Approx(kNearest * 1.5 / 0.9));
  options.metres = 0.001;
  std::vector<uint16_t> levels = LevelsOf(kMillimetres);
  levels[0] = 0;
  const Opened by_millimetre("map.png", GreyPng(levels), options);
  REQUIRE(by_millimetre.error == "");
  CHECK(by_millimetre.At(0, 0) == doctest::Approx(kNearest * 1.5 / 3));
  CHECK(by_millimetre.At(kBox[0], kBox[1]) == doctest::Approx(kNearest * 1.5 / 0.9));
  options.unit = DepthUnit::kDisparity;
  const Opened pixels("map.pfm", PfmOf(MapOf({-2, 3, 17.5})), options);
  REQUIRE(pixels.error == "");
  CHECK(pixels.At(kWall[0], kWall[1]) == -2);
  CHECK(pixels.At(kBox[0], kBox[1]) == 17.5);
  CHECK(Contains(Opened("map.pfm", PfmOf(MapOf({2, 3, 501})), options).error,
                 "disparities from -500 to 500"));
}

TEST_CASE("depth pictures: in NPY, the near end is guessed, and units keep the values unchanged") {
  const FloatMap map = MapOf({3, 1.5, 0.9});
  const Opened by_order("map.npy", NpyOf(map), {});
  CHECK(by_order.HasNote("black is taken as near"));
  CheckScene(Opened("map.npy", NpyOf(map), NearIs(Near::kBlack)));
  CHECK(Opened("map.npy", NpyOf(map), UnitIs(DepthUnit::kDisparity)).At(kBox[0], kBox[1]) ==
        doctest::Approx(0.9));
}

TEST_CASE("depth pictures: PGM keeps 16 bits, and colour pictures are rejected") {
  std::string pgm = "P5\n48 36\n4095\n";
  for (const uint16_t level : LevelsOf(kMillimetres)) pgm += Big(level, 2);
  CheckScene(Opened("map.pgm", pgm, NearIs(Near::kBlack)));
  Bytes bytes(pgm.begin(), pgm.end());
  Samples samples = ValueOf(DecodeSamples("x", Alpha::kTransparent, bytes));
  CHECK(samples.largest == 4095);
  CHECK(samples.map.values[Index(kBox[0], kBox[1])] == 900);
  Image colours(kColumns, kRows);
  for (size_t k = 0; k < colours.pixels.size(); k += 3) {
    colours.pixels[k] = static_cast<uint8_t>(k / 21);
    colours.pixels[k + 2] = static_cast<uint8_t>(255 - k / 21);
  }
  for (const std::string extension : {".png", ".jpg", ".ppm"}) {
    CAPTURE(extension);
    CHECK(Contains(Opened("map" + extension, Encode(colours, extension), {}).error,
                   "a colour picture"));
  }
  // Grey pictures stay grey after JPEG compression.
  CHECK(Opened("map.jpg", Encode(Ramp(kColumns, kRows), ".jpg"), {}).error == "");
}

Image GreyOf(const FloatMap& map) {
  Image picture(map.width, map.height);
  for (size_t k = 0; k < picture.pixels.size(); ++k) {
    picture.pixels[k] = static_cast<uint8_t>(map.values[k / 3]);
  }
  return picture;
}

// Returns a photo that has edges at the edges of the map.
Image PictureOf(const FloatMap& map) {
  Image picture(map.width, map.height);
  for (size_t k = 0; k < map.values.size(); ++k) {
    for (size_t c = 0; c < 3; ++c) {
      picture.pixels[3 * k + c] =
          static_cast<uint8_t>(40 + 20 * c + double(map.values[k]) * (c == 1 ? 0.4 : 0.7));
    }
  }
  return picture;
}

#ifdef STARFOCUS_HAS_EXIF
TEST_CASE("depth pictures: by its proportions and edges, a picture is rotated with the photo") {
  for (int orientation = 1; orientation <= 8; ++orientation) {
    for (const bool square : {false, true}) {
      CAPTURE(orientation);
      CAPTURE(square);
      FloatMap map = MapOf({30, 140, 220});
      if (square) {
        map.values.resize(size_t(kRows) * kRows);
        for (int y = 0; y < kRows; ++y) {
          for (int x = 0; x < kRows; ++x) {
            map.values[size_t(y * kRows + x)] = static_cast<float>(Scene{30, 140, 220}.At(x, y));
          }
        }
        map.width = kRows;
      }
      const Image as_file = PictureOf(map);
      FloatMap upright = map;
      TurnMap(orientation, &upright);
      TempFolder folder;
      Write(folder.file("photo.jpg"), Insert(Encode(as_file, ".jpg"), ExifSegment(orientation, 0)));
      Write(folder.file("file.png"), Encode(GreyOf(map), ".png"));
      Write(folder.file("upright.png"), Encode(GreyOf(upright), ".png"));
      DepthOptions options = NearIs(Near::kWhite);
      const std::string path = folder.file("photo.jpg");
      const Capture by_file = ValueOf(OpenCapture(path, {folder.file("file.png"), options}));
      const Capture by_upright = ValueOf(OpenCapture(path, {folder.file("upright.png"), options}));
      CHECK(by_file.light_field.disparity.values == by_upright.light_field.disparity.values);
      CHECK(by_file.light_field.disparity.width == upright.width);
      const bool judged = orientation > 1 && (orientation < 5 || square);
      REQUIRE(by_upright.notes.size() == (judged ? 1 : 0));
      if (!judged) continue;
      CHECK(Contains(by_upright.notes[0], "upright already"));
      CHECK(Contains(by_upright.notes[0], "--depth-orientation photo"));
      CHECK(Contains(by_file.notes[0], "--depth-orientation upright"));
      options.orientation = DepthOrientation::kPhoto;
      Capture wrong = ValueOf(OpenCapture(path, {folder.file("upright.png"), options}));
      CHECK(wrong.notes.empty());
      CHECK(wrong.light_field.disparity.values != by_file.light_field.disparity.values);
      options.orientation = DepthOrientation::kUpright;
      wrong = ValueOf(OpenCapture(path, {folder.file("upright.png"), options}));
      CHECK(wrong.light_field.disparity.values == by_file.light_field.disparity.values);
    }
  }
}
#endif

TEST_CASE(
    "depth pictures: proportions that differ from the photo by more than rounding are rejected") {
  const auto open = [](int width, int height) {
    return Opened("map.png", Encode(Ramp(width, height), ".png"), NearIs(Near::kWhite)).error;
  };
  CHECK(open(24, 18) == "");
  CHECK(open(16, 12) == "");
  CHECK(open(11, 8) == "");
  CHECK(open(518, 392) == "");
  for (const auto& [width, height] : {std::pair<int, int>{48, 32}, {48, 40}, {36, 36}, {36, 48}}) {
    CHECK(Contains(open(width, height), "a depth map with the proportions of the picture"));
  }
}

TEST_CASE("depth pictures: a picture is found by its name next to the photo") {
  for (const char* name :
       {"photo-depth.png", "photo_depth.png", "photo.depth.png", "photo-depth.PNG",
        "PHOTO_Depth.Png", "Photo-DEPTH.png", "photo-depth.npy", "photo-depth.npz",
        "photo-depth.exr", "photo-depth.tif", "photo-depth.tiff"}) {
    CAPTURE(name);
    TempFolder folder;
    Write(folder.file("photo.jpg"), Encode(Plain(kColumns, kRows, 128), ".jpg"));
    Write(folder.file("photodepth.png"), "no picture");
    Write(folder.file("photo2-depth.png"), "no picture");
    Write(folder.file("depth.png"), "no picture");
    Write(folder.file(name), Encode(Ramp(kColumns, kRows), ".png"));
    Capture capture = ValueOf(OpenCapture(folder.file("photo.jpg"), {}));
    CHECK(capture.map_path == folder.file(name));
    CHECK(capture.notes.size() == 1);
    Write(folder.file("photo-depth.jpg"), Encode(Ramp(kColumns, kRows), ".jpg"));
    capture = ValueOf(OpenCapture(folder.file("photo.jpg"), {"", NearIs(Near::kWhite)}));
    REQUIRE(capture.notes.size() == 1);
    CHECK(Contains(capture.notes[0], "2 depth pictures"));
  }
}

}  // namespace
}  // namespace starfocus::depth_picture_test
