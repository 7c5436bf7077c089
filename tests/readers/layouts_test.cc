// SPDX-License-Identifier: Apache-2.0
// Reads folders of views in the layouts of published data sets. Tests the selection of views, the
// positions of views, and the disparity map.
#include <doctest/doctest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>

#include "platform/readers/capture.h"
#include "platform/readers/orientation.h"
#include "platform/readers/photo_scale.h"
#include "starfocus/starfocus.h"
#include "tests/support/error_line.h"
#include "tests/support/opened_photo.h"

namespace starfocus::layouts_test {
namespace {

using namespace photos;

std::string Number(int value, int digits) {
  char text[16];
  std::snprintf(text, sizeof(text), "%0*d", digits, value);
  return text;
}

// Writes a picture of one level, which identifies the view.
void WriteView(const TempFolder& folder, const std::string& name, int level) {
  Require(WriteImage(folder.file(name), Plain(4, 3, level)));
}

int LevelAt(const Capture& capture, double u, double v) {
  const LightField& field = capture.light_field;
  for (size_t k = 0; k < field.views.size(); ++k) {
    if (SamePosition(field.positions[k], {u, v})) return field.views[k].pixels[0];
  }
  return -1;
}

Error OpenAndLoad(const TempFolder& folder, Capture* capture) {
  Result<Capture> opened = OpenCapture(folder.path(), {});
  if (!opened) return opened.error();
  *capture = std::move(*opened);
  return LoadCapture({}, capture);
}

// Writes 5 rows of 7 views. `place` returns the part of a name after the row and the column.
template <class Place>
void WriteStanford(const TempFolder& folder, const Place& place) {
  for (int row = 0; row < 5; ++row) {
    for (int column = 0; column < 7; ++column) {
      WriteView(folder,
                "out_" + Number(row, 2) + "_" + Number(column, 2) + place(row, column) + ".png",
                10 * row + column);
    }
  }
}

// Replaces each file of a layout by a pipe without a writer and by a device. Checks that the folder
// is rejected without waiting, unless it is opened without the file.
void CheckSpecialFiles(const TempFolder& folder) {
  namespace fs = std::filesystem;
  TempFolder kept;
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(folder.path())) paths.push_back(entry.path());
  int rejected = 0;
  for (const fs::path& path : paths) {
    fs::rename(path, kept.file("file"));
    for (const bool pipe : {true, false}) {
      CAPTURE(path.string());
      if (pipe) REQUIRE(mkfifo(path.c_str(), 0600) == 0);
      if (!pipe) fs::create_symlink("/dev/zero", path);
      Capture capture;
      const Error error = OpenAndLoad(folder, &capture);
      if (error)
        CHECK(Contains(error, "cannot read " + path.string() + ": it is a device or pipe"));
      rejected += error ? 1 : 0;
      fs::remove(path);
    }
    fs::rename(kept.file("file"), path);
  }
  CHECK(rejected >= 10);
}

TEST_CASE("layouts: a pipe or device instead of any file is rejected without waiting") {
  TempFolder own, grid, hci, stanford;
  for (const char* name : {"+0.0_+0.0", "+1.0_+0.0", "+0.0_+1.0", "-1.0_+0.0", "+0.0_-1.0"}) {
    WriteView(own, "view_" + std::string(name) + ".png", 7);
  }
  Require(WritePfm(own.file("disparity.pfm"), {4, 3, std::vector<float>(12, 1)}));
  WriteView(own, "coverage.png", 255);
  CheckSpecialFiles(own);
  for (int k = 0; k < 9; ++k) {
    WriteView(grid, "v_" + Number(k / 3, 1) + "_" + Number(k % 3, 1) + ".png", k);
  }
  Require(WritePfm(grid.file("disparity.pfm"), {4, 3, std::vector<float>(12, 1)}));
  CheckSpecialFiles(grid);
  for (int k = 0; k < 9; ++k) WriteView(hci, "input_Cam" + Number(k, 3) + ".png", k);
  Require(WritePfm(hci.file("gt_disp_lowres.pfm"), {4, 3, std::vector<float>(12, 1)}));
  Write(hci.file("parameters.cfg"), "[intrinsics]\nfocal_length_mm = 100.0\n");
  CheckSpecialFiles(hci);
  WriteStanford(stanford, [](int, int) { return ""; });
  CheckSpecialFiles(stanford);
}

TEST_CASE(
    "HCI: 17 of 81 views are read, disparities are scaled by 4, and f-stops follow the baseline") {
  TempFolder folder;
  for (int k = 0; k < 81; ++k) WriteView(folder, "input_Cam" + Number(k, 3) + ".png", k);
  Require(WritePfm(folder.file("gt_disp_lowres.pfm"), {4, 3, std::vector<float>(12, 0.75F)}));
  Write(folder.file("parameters.cfg"),
        "[intrinsics]\nfocal_length_mm = 100.0\n[extrinsics]\nbaseline_mm = 5\n");
  Capture capture;
  REQUIRE(OpenAndLoad(folder, &capture) == "");
  CHECK(capture.format == "HCI 4D light field");
  CHECK(AreStar(capture.light_field.positions));
  REQUIRE(capture.light_field.views.size() == 17);
  CHECK(LevelAt(capture, 0, 0) == 40);
  CHECK(LevelAt(capture, 1, 0) == 44);
  CHECK(LevelAt(capture, 0, 1) == 76);
  CHECK(LevelAt(capture, -0.5, -0.5) == 20);
  CHECK(capture.light_field.disparity.values[5] == 3);
  CHECK(capture.widest == 100.0 / (2 * 4 * 5));
  REQUIRE(LoadCapture(StarPositions(5), &capture) == "");
  CHECK(capture.light_field.views.size() == 5);
  std::filesystem::remove(folder.file("gt_disp_lowres.pfm"));
  REQUIRE(OpenAndLoad(folder, &capture) == "");
  CHECK(capture.map_path.empty());
  CHECK(capture.light_field.disparity.values.empty());
  std::filesystem::remove(folder.file("input_Cam080.png"));
  CHECK(Contains(OpenAndLoad(folder, &capture), "a square number of views"));
}

TEST_CASE(
    "Stanford: the star set of the grid is read, in the order of the positions in the names") {
  TempFolder placed, turned, plain;
  WriteStanford(placed, [](int row, int column) {
    return "_-" + std::to_string(381 + row) + ".909271_" + std::to_string(1103 + 7 * column) +
           ".376221_";
  });
  Capture capture;
  REQUIRE(OpenAndLoad(placed, &capture) == "");
  CHECK(capture.format == "Stanford light field");
  CHECK(capture.light_field.views.size() == 17);
  CHECK(LevelAt(capture, 0, 0) == 23);
  CHECK(LevelAt(capture, 1, 0) == 25);
  CHECK(LevelAt(capture, 0, 1) == 3);  // row 0 has the largest Y
  CHECK(LevelAt(capture, 0.5, -0.5) == 34);
  CHECK(capture.widest == 0);
  WriteStanford(turned, [](int row, int column) {
    return "_" + std::to_string(row) + ".5_" + std::to_string(-3 * column) + ".25_";
  });
  REQUIRE(OpenAndLoad(turned, &capture) == "");
  CHECK(LevelAt(capture, 1, 0) == 21);
  CHECK(LevelAt(capture, 0, 1) == 43);
  WriteStanford(plain, [](int, int) { return ""; });
  REQUIRE(OpenAndLoad(plain, &capture) == "");
  CHECK(LevelAt(capture, 1, 0) == 25);
  CHECK(LevelAt(capture, 0, 1) == 3);
}

TEST_CASE("grids by name: squares and single rows are read, and missing views are reported") {
  const auto grid = [](const TempFolder& folder, int rows, int columns) {
    for (int k = 0; k < rows * columns; ++k) {
      WriteView(
          folder,
          "scene r" + std::to_string(k / columns) + "c" + std::to_string(k % columns) + " 8bit.png",
          k);
    }
  };
  Capture capture;
  TempFolder three, sixteen, row;
  grid(three, 3, 3);
  REQUIRE(OpenAndLoad(three, &capture) == "");
  CHECK(capture.light_field.views.size() == 9);
  CHECK(LevelAt(capture, 1, 1) == 8);
  std::filesystem::remove(three.file("scene r2c2 8bit.png"));
  CHECK(Contains(OpenAndLoad(three, &capture), "a picture for each place in 3 rows of 3, found 8"));
  // The largest part of 8 x 8 views that has a middle is 7 x 7. The edge of 7 x 7 views is 3 views
  // from the middle, so no view is at half the distance.
  grid(sixteen, 8, 8);
  REQUIRE(OpenAndLoad(sixteen, &capture) == "");
  CHECK(capture.light_field.views.size() == 9);
  CHECK(LevelAt(capture, 0, 0) == 27);
  CHECK(LevelAt(capture, 1, -1) == 6);
  for (int k = 0; k < 21; ++k) WriteView(row, "IMG_" + Number(100 + k, 4) + ".png", k);
  REQUIRE(OpenAndLoad(row, &capture) == "");
  CHECK(capture.light_field.views.size() == 11);
  CHECK(LevelAt(capture, 0, 0) == 10);
  CHECK(LevelAt(capture, -1, 0) == 0);
  CHECK(LevelAt(capture, 0.2, 0) == 12);
  CHECK(capture.map_path.empty());
  Require(WritePfm(row.file("disparity.pfm"), {4, 3, std::vector<float>(12, 2)}));
  REQUIRE(OpenAndLoad(row, &capture) == "");
  CHECK(capture.light_field.disparity.values[0] == 2);
  TempFolder two, none;
  grid(two, 2, 2);
  CHECK(Contains(OpenAndLoad(two, &capture), "at least 3 views"));
  WriteView(none, "holiday.png", 1);
  WriteView(none, "portrait.png", 1);
  CHECK(Contains(OpenAndLoad(none, &capture), "2 pictures, the first holiday.png"));
}

TEST_CASE("Middlebury: the unknown disparities of a pair are filled") {
  TempFolder folder;
  WriteView(folder, "im0.png", 1);
  WriteView(folder, "im1.png", 2);
  Require(WritePfm(folder.file("disp0.pfm"), {4, 3, std::vector<float>(12, HUGE_VALF)}));
  Write(folder.file("calib.txt"), "cam0=[1 0 0]\r\ndoffs=124.3\r\nbaseline=193.001\r\n");
  Capture capture;
  REQUIRE(OpenAndLoad(folder, &capture) == "");
  CHECK(capture.format == "Middlebury stereo pair");
  CHECK(capture.care == MapCare::kFill);
  CHECK(LevelAt(capture, 1, 0) == 2);
  CHECK(FactOf(capture, "cameras") == "193.001 mm apart");
  CHECK(FactOf(capture, "infinity") == "at disparity -124.3");
}

TEST_CASE("stereo pairs: disp0GT.pfm, the name in ETH3D, is the map") {
  TempFolder folder;
  WriteView(folder, "im0.png", 1);
  WriteView(folder, "im1.png", 2);
  Require(WritePfm(folder.file("disp0GT.pfm"), {4, 3, std::vector<float>(12, 7)}));
  Write(folder.file("calib.txt"), "doffs=0\nbaseline=60\n");
  Capture capture;
  REQUIRE(OpenAndLoad(folder, &capture) == "");
  CHECK(capture.light_field.disparity.values[5] == 7);
  CHECK(capture.map_path == folder.file("disp0GT.pfm"));
  CHECK(IsLightFieldFile("disp0GT.pfm"));
  // Without a calibration, the map may also have infinite values, which are filled.
  std::filesystem::remove(folder.file("calib.txt"));
  Capture plain = ValueOf(OpenCapture(folder.file("."), {}));
  CHECK(plain.map_path == folder.file("./disp0GT.pfm"));
  CHECK(plain.care == MapCare::kFill);
}

// Writes a pair of random pictures of a wall at disparity 9. The levels of the map are `multiple`
// times the disparity, except in the first row, where the level is 0.
void WriteGreyMapPair(const TempFolder& folder, const std::vector<std::string>& names, int height,
                      int multiple) {
  constexpr int kWidth = 160, kDisparity = 9;
  Image left = Noise(kWidth, height), right(kWidth, height), map = Plain(kWidth, height, 0);
  for (int y = 0; y < height; ++y) {
    for (int k = 0; k < 3 * kWidth; ++k) {
      const int from = k + 3 * kDisparity;
      right.row(y)[k] = from < 3 * kWidth ? left.row(y)[from] : uint8_t{0};
      if (y > 0) map.row(y)[k] = static_cast<uint8_t>(multiple * kDisparity);
    }
  }
  Require(WriteImage(folder.file(names[0]), left));
  Require(WriteImage(folder.file(names[1]), right));
  if (names[2].substr(names[2].size() - 4) == ".pgm") {
    std::string pgm = "P5 " + std::to_string(kWidth) + " " + std::to_string(height) + " 255\n";
    for (size_t k = 0; k < map.pixels.size(); k += 3) pgm += static_cast<char>(map.pixels[k]);
    Write(folder.file(names[2]), pgm);
  } else {
    Require(WriteImage(folder.file(names[2]), map));
  }
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
    WriteView(folder, "im0.png", 1);  // another view of the scene
    WriteView(folder, "im1.png", 1);
    Write(folder.file("dmin.txt"), "70\n");
    Capture capture;
    REQUIRE(OpenAndLoad(folder, &capture) == "");
    CHECK(Contains(capture.format, one.names == views ? "2005 or 2006" : "2003"));
    REQUIRE(capture.light_field.views.size() == 2);
    CHECK(SamePosition(capture.light_field.positions[1], {1, 0}));
    CHECK(capture.light_field.disparity.at(20, 20) == 9);
    CHECK(std::isnan(capture.light_field.disparity.at(20, 0)));
    CHECK(capture.care == MapCare::kFill);
  }
  TempFolder folder;  // without a second picture, the size determines the multiple
  WriteGreyMapPair(folder, ppm, 375, 4);
  Capture capture = ValueOf(OpenCapture(folder.path(), {}));
  REQUIRE(LoadCapture(StarPositions(1), &capture) == "");
  CHECK(capture.light_field.disparity.at(20, 20) == 9);
  Require(WriteImage(folder.file("disp2.png"), Plain(4, 3, 40)));
  capture = ValueOf(OpenCapture(folder.path(), {}));
  CHECK(Contains(LoadCapture({}, &capture), "the size of the centre view"));
}

TEST_CASE("ApplyOrientation: each corner moves to the place that EXIF defines") {
  // EXIF 2.32, tag 274: the sides of the picture at which row 0 and column 0 of the file are.
  constexpr const char* kRows[] = {"top",  "top",   "bottom", "bottom",
                                   "left", "right", "right",  "left"};
  constexpr const char* kColumns[] = {"left", "right", "right",  "left",
                                      "top",  "top",   "bottom", "bottom"};
  for (int orientation = 1; orientation <= 8; ++orientation) {
    DepthPhoto photo;
    photo.orientation = orientation;
    photo.picture = Plain(3, 2, 0);
    photo.map = {3, 2, {1, 2, 3, 4, 5, 6}};
    photo.picture.row(0)[0] = 200;  // pixel in row 0 and column 0 of the file
    photo.focus_x = photo.focus_y = 0.1;
    ApplyOrientation(&photo);
    const std::string row = kRows[orientation - 1], column = kColumns[orientation - 1];
    const Image& picture = photo.picture;
    CHECK(picture.width == (orientation < 5 ? 3 : 2));
    const bool right = row == "right" || column == "right",
               below = row == "bottom" || column == "bottom";
    const int x = right ? picture.width - 1 : 0, y = below ? picture.height - 1 : 0;
    CHECK(picture.row(y)[3 * x] == 200);
    CHECK(photo.map.at(x, y) == 1);
    CHECK(photo.focus_x == doctest::Approx(right ? 0.9 : 0.1));
    CHECK(photo.focus_y == doctest::Approx(below ? 0.9 : 0.1));
  }
}

TEST_CASE("Resize: maps are interpolated to the size of the picture, without unknown values") {
  const FloatMap map = {2, 2, {0, 4, NAN, 8}};
  const FloatMap large = Resize(map, 4, 2);
  CHECK(large.at(0, 0) == 0);
  CHECK(large.at(1, 0) == 1);
  CHECK(large.at(2, 0) == 3);
  CHECK(large.at(3, 0) == 4);
  CHECK(std::isnan(large.at(0, 1)));
  CHECK(large.at(1, 1) == 8);
}

TEST_CASE("MakePhotoField: interpolated disparities of a photo stay within the limit") {
  DepthPhoto photo;
  photo.picture = Plain(97, 61, 128);
  // All inverse distances are 1e6 per metre, so all points are at a distance of one micrometre.
  photo.map = {5, 3, std::vector<float>(15, 1e6F)};
  photo.meaning = MapMeaning::kInverseMetres;
  Result<LightField> made = MakePhotoField("photo", &photo);
  REQUIRE(made.error() == "");
  LightField& field = *made;
  FitMap(&field);
  REQUIRE(field.disparity.values.size() == 97 * 61);
  const auto [low, high] =
      std::minmax_element(field.disparity.values.begin(), field.disparity.values.end());
  CHECK(*low == float(STARFOCUS_MAX_DISPARITY));
  CHECK(*high == float(STARFOCUS_MAX_DISPARITY));
}

}  // namespace
}  // namespace starfocus::layouts_test
