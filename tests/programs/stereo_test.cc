// SPDX-License-Identifier: Apache-2.0
// Opens stereo pairs in one file, in two files, and in the folders of Middlebury whose maps are
// grey pictures, and aligns pairs whose points differ in height. photo_formats_test.cc has the
// pairs in HEIF, and layouts.txt the other folders.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "platform/readers/capture.h"
#include "platform/readers/pair_alignment.h"
#include "platform/readers/stereo_pair.h"
#include "tests/support/error_line.h"
#include "tests/support/opened_photo.h"
#include "tests/support/photo_files.h"

namespace starfocus::stereo_test {
namespace {

using namespace photos;

constexpr int kSide = 160;

// Returns a pseudorandom level, 0 to 255, for a point of a grid.
double LevelOf(int x, int y, int seed) {
  uint32_t hash = uint32_t(x) * 374761393u + uint32_t(y) * 668265263u + uint32_t(seed) * 974634749u;
  hash = (hash ^ (hash >> 13)) * 1274126177u;
  return (hash ^ (hash >> 16)) & 255;
}

// Returns a grey picture whose pixels have the levels `level_at(x, y)`.
template <class Level>
Image Drawn(const Level& level_at) {
  Image image(kSide, kSide);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      std::fill_n(image.row(y) + 3 * x, 3, static_cast<uint8_t>(level_at(x, y)));
    }
  }
  return image;
}

// Returns a picture of a random texture. Pixel (x, y) shows point (x + dx, y + dy), after a
// rotation of the picture around its centre. `seed` selects the texture.
Image Texture(double dx, double dy, double rotation, int seed = 0) {
  constexpr double kGrid = 4;  // distance between the random levels in pixels
  return Drawn([&](int x, int y) {
    const double u = x - kSide / 2, v = y - kSide / 2;
    const double a = (x + dx - rotation * v + kSide) / kGrid;
    const double b = (y + dy + rotation * u + kSide) / kGrid;
    const int i = int(a), j = int(b);
    const auto between = [&](int row) {
      return LevelOf(i, row, seed) + (a - i) * (LevelOf(i + 1, row, seed) - LevelOf(i, row, seed));
    };
    return between(j) + (b - j) * (between(j + 1) - between(j));
  });
}

// Returns the mean difference between the middle parts of two pictures.
double MeanApart(const Image& a, const Image& b) {
  constexpr int kEdge = 20;
  double sum = 0;
  for (int y = kEdge; y < kSide - kEdge; ++y) {
    for (int k = 3 * kEdge; k < 3 * (kSide - kEdge); ++k)
      sum += std::abs(a.row(y)[k] - b.row(y)[k]);
  }
  return sum / (3 * (kSide - 2 * kEdge) * (kSide - 2 * kEdge));
}

DepthPhoto Aligned(const Image& left, const Image& right) {
  DepthPhoto photo;
  photo.picture = left;
  photo.right = right;
  Require(AlignPair("x", &photo));
  return photo;
}

TEST_CASE("stereo pair: points of the right picture are moved to the heights of the left picture") {
  const Image left = Texture(0, 0, 0);
  for (const double rotation : {0.0, 0.02}) {
    for (const double rise : {3.0, -2.5}) {
      CAPTURE(rotation);
      CAPTURE(rise);
      const DepthPhoto photo = Aligned(left, Texture(4, rise, rotation));
      REQUIRE(photo.notes.size() == 1);
      CHECK(Contains(photo.notes[0], "moved up or down by up to"));
      CHECK(MeanApart(photo.right, Texture(4, 0, 0)) < 6);
    }
  }
}

TEST_CASE("stereo pair: an aligned pair and a pair without corners keep their bytes") {
  const Image left = Texture(0, 0, 0), right = Texture(4, 0, 0);
  const DepthPhoto photo = Aligned(left, right);
  CHECK(photo.notes.empty());
  CHECK(photo.right.pixels == right.pixels);
  CHECK(Aligned(Plain(9, 7, 90), Ramp(9, 7)).right.pixels == Ramp(9, 7).pixels);
}

TEST_CASE("stereo pair: pictures of different scenes and large rotations are rejected") {
  const Image left = Texture(0, 0, 0);
  for (const Image& right : {Texture(0, 0, 0, 1), Texture(2, 0, 0.12), Noise(kSide, kSide)}) {
    CHECK_THROWS_WITH(Aligned(left, right),
                      doctest::Contains("x: expected two pictures of one scene"));
  }
}

TEST_CASE("stereo pair: a repeated pattern is not rejected, and a note states the uncertainty") {
  // Returns a chessboard whose columns are moved by `dx`.
  const auto board = [](int dx) {
    return Drawn([dx](int x, int y) { return ((x + dx) / 8 + y / 8) % 2 == 0 ? 200 : 50; });
  };
  const DepthPhoto photo = Aligned(board(0), board(3));
  CHECK(photo.right.pixels == board(3).pixels);
  REQUIRE(photo.notes.size() == 1);
  CHECK(Contains(photo.notes[0], "resemble several points of the right one"));
}

TEST_CASE("stereo pair: the time does not depend on the height") {
  const Image tall = Noise(300, 3000);
  CHECK(MeasureAlignment(tall, tall).corners < 2000);
}

TEST_CASE("stereo pair: a file with a sign of a pair has two views and no map") {
  const std::string second = Encode(Ramp(kWidth, kHeight), ".jpg");
  const std::string gain = "xmlns:hdrgm=\"http://ns.adobe.com/hdr-gain-map/1.0/\"";
  struct Row {
    std::string name, file;
    bool pair, noted;
  };
  std::vector<Row> rows = {
      {"a.mpo", Photo() + second, true, true},
      // This index has an entry whose offset is wrong and whose type does not exist.
      {"a.mpo", MultiPicture(Photo(), second, {false, 32, 5, 0x123456}), true, true},
      {"a.jpg", MultiPicture(Photo(), second), true, false},
      // A file without any sign of a pair, pictures of different sizes, a large preview, and a gain
      // map.
      {"a.jpg", Photo() + second, false, false},
      {"a.mpo", MultiPicture(Photo(), Encode(Ramp(kWidth / 2, kHeight / 2), ".jpg")), false, false},
      {"a.mpo", MultiPicture(Photo(), second, {false, 32, 0, 0x010002}), false, false},
      {"a.jpg", MultiPicture(Photo(), Insert(second, XmpSegment(Packet(gain, "")))), false, false}};
  for (const bool little : {false, true}) {
    for (const uint32_t type : {0u, 0x020002u, 0x20020002u}) {
      rows.push_back({"a.mpo", MultiPicture(Photo(), second, {little, 32, 0, type}), true, false});
      rows.push_back({"a.mpo", MultiPicture(Photo(), second, {little, 2, 0, type}), true, true});
    }
  }
  for (const Row& row : rows) {
    CAPTURE(&row - rows.data());
    TempFolder folder;
    Write(folder.file(row.name), row.file);
    Result<Capture> opened = OpenCapture(folder.file(row.name), {});
    const bool loaded = opened && !LoadCapture({}, &*opened);
    CHECK((loaded && opened->light_field.views.size() == 2) == row.pair);
    if (!row.pair || !loaded) continue;
    CHECK(opened->notes.empty() == !row.noted);
    CHECK(opened->map_path.empty());
    CHECK(!opened->photo);
    const LightField& field = opened->light_field;
    CHECK(SamePosition(field.positions[0], {0, 0}));
    CHECK(SamePosition(field.positions[1], {1, 0}));
    CHECK(std::abs(field.views[1].row(5)[3 * (kWidth - 1)] - 255) < 8);
    CHECK(field.views[1].row(5)[0] < 8);
    REQUIRE(LoadCapture({{0, 0}}, &*opened) == "");
    CHECK(field.views.size() == 1);
  }
}

// Writes a pair of random pictures of a wall at disparity 9. The levels of the map are `multiple`
// times the disparity, except in the first row, where the level is 0.
void WriteGreyMapPair(const TempFolder& folder, const std::vector<std::string>& names, int height,
                      int multiple) {
  constexpr int kColumns = 160, kDisparity = 9;
  const size_t shift = 3 * kDisparity;
  Image left = Noise(kColumns, height), right(kColumns, height);
  Image map = Plain(kColumns, height, multiple * kDisparity);
  std::fill_n(map.row(0), map.stride(), uint8_t{0});
  for (int y = 0; y < height; ++y) {
    std::copy_n(left.row(y) + shift, left.stride() - shift, right.row(y));
  }
  Require(WriteImage(folder.file(names[0]), left));
  Require(WriteImage(folder.file(names[1]), right));
  if (!Contains(names[2], ".pgm")) return Require(WriteImage(folder.file(names[2]), map));
  std::string pgm = "P5 " + std::to_string(kColumns) + " " + std::to_string(height) + " 255\n";
  for (size_t k = 0; k < map.pixels.size(); k += 3) pgm += static_cast<char>(map.pixels[k]);
  Write(folder.file(names[2]), pgm);
}

TEST_CASE(
    "Middlebury of 2003 to 2006: the size of the picture determines the multiple in the grey map") {
  const std::vector<std::string> ppm = {"im2.ppm", "im6.ppm", "disp2.pgm"},
                                 png = {"im2.png", "im6.png", "disp2.png"},
                                 views = {"view1.png", "view5.png", "disp1.png"};
  struct Case {
    const std::vector<std::string>& names;
    int height, multiple;
  };
  // The last three sizes do not occur in the published data, so the reader must find the multiple
  // from the pictures.
  for (const Case& one :
       {Case{ppm, 375, 4}, Case{png, 375, 4}, Case{png, 750, 2}, Case{png, 1500, 1},
        Case{views, 370, 3}, Case{views, 555, 2}, Case{views, 1110, 1}, Case{views, 60, 1},
        Case{png, 60, 2}, Case{ppm, 380, 8}}) {
    CAPTURE(one.names[2]);
    CAPTURE(one.height);
    TempFolder folder;
    WriteGreyMapPair(folder, one.names, one.height, one.multiple);
    for (const char* other : {"im0.png", "im1.png"}) {  // other views of the scene
      Require(WriteImage(folder.file(other), Plain(4, 3, 1)));
    }
    Write(folder.file("dmin.txt"), "70\n");
    Capture capture = ValueOf(OpenCapture(folder.path(), {}));
    REQUIRE(LoadCapture({}, &capture) == "");
    CHECK(Contains(capture.format, one.names == views ? "2005 or 2006" : "2003"));
    REQUIRE(capture.light_field.views.size() == 2);
    CHECK(SamePosition(capture.light_field.positions[1], {1, 0}));
    CHECK(capture.light_field.disparity.at(20, 20) == 9);
    CHECK(std::isnan(capture.light_field.disparity.at(20, 0)));
    CHECK(capture.care == MapCare::kFill);
  }
  CHECK(IsLightFieldFile("disp0GT.pfm"));
  TempFolder folder;  // without a second picture, the size determines the multiple
  WriteGreyMapPair(folder, ppm, 375, 4);
  Capture capture = ValueOf(OpenCapture(folder.path(), {}));
  REQUIRE(LoadCapture(StarPositions(1), &capture) == "");
  CHECK(capture.light_field.disparity.at(20, 20) == 9);
  Require(WriteImage(folder.file("disp2.png"), Plain(4, 3, 40)));
  capture = ValueOf(OpenCapture(folder.path(), {}));
  CHECK(Contains(LoadCapture({}, &capture), "the size of the centre view"));
}

}  // namespace
}  // namespace starfocus::stereo_test
