// SPDX-License-Identifier: Apache-2.0
// Tests folders of light fields, their maps in PFM files, and the order of file names by their
// numbers.
#include "platform/light_field.h"

#include <doctest/doctest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include "platform/image_io.h"
#include "platform/natural_order.h"
#include "platform/pfm.h"
#include "platform/writers/png.h"
#include "tests/support/config.h"
#include "tests/support/error_line.h"
#include "tests/support/photo_files.h"
#include "tests/support/temp_folder.h"

namespace starfocus::light_field_test {
namespace {

namespace fs = std::filesystem;

std::string StarName(int index) {
  return ViewName(StarPositions(STARFOCUS_MAX_VIEWS)[size_t(index)]);
}

LightField Make(int views, int width, int height) {
  LightField light_field;
  for (int i = 0; i < views; ++i) {
    light_field.views.push_back(photos::Plain(width, height, 10 * i + 3));
  }
  light_field.disparity = {width, height, std::vector<float>(size_t(width * height), 1.5f)};
  return light_field;
}

Result<LightField> Load(const TempFolder& folder, const Positions& positions = {}) {
  return LoadLightField(folder.path(), positions);
}

Error Save(const TempFolder& folder, const LightField& light_field) {
  ThreadRunner runner(2);
  return SaveLightField(folder.path(), light_field, &runner);
}

void Remove(const TempFolder& folder, int view) {
  REQUIRE(fs::remove(folder.file(StarName(view) + ".png")));
}

TEST_CASE("light_field: names of views state the position with up to four decimals") {
  CHECK(StarName(0) == "view_+0.0_+0.0");
  CHECK(StarName(1) == "view_+1.0_+0.0");
  CHECK(StarName(4) == "view_+0.0_-1.0");
  CHECK(StarName(6) == "view_-1.0_+1.0");
  CHECK(StarName(16) == "view_-0.5_-0.5");
  CHECK(ViewName({0.25, -1.0 / 3}) == "view_+0.25_-0.3333");
  CHECK(ViewName({-0.00001, 0.125}) == "view_+0.0_+0.125");
}

TEST_CASE("light_field: every star set is read back in order, as a whole or in part") {
  for (int saved : {1, 5, 9, 17}) {
    TempFolder folder;
    const LightField made = Make(saved, 7, 5);
    REQUIRE(Save(folder, made) == "");
    // Views may have different formats.
    Remove(folder, 0);
    REQUIRE(WriteImage(folder.file(StarName(0) + (saved == 5 ? ".jpg" : ".ppm")), made.views[0]) ==
            "");
    for (int asked : {0, 1, 5, 9, 17}) {
      CAPTURE(saved);
      CAPTURE(asked);
      const Result<LightField> read = Load(folder, StarPositions(asked));
      if (asked > saved) {
        CHECK(Contains(read, "expected " + std::to_string(asked) + " views"));
        continue;
      }
      const LightField back = ValueOf(read);
      REQUIRE(back.views.size() == size_t(asked == 0 ? saved : asked));
      CHECK(AreStar(back.positions));
      for (size_t i = 0; i < back.views.size(); ++i) CHECK(back.views[i].pixels[0] == 10 * i + 3);
      CHECK(back.disparity.at(6, 4) == 1.5f);
    }
  }
}

TEST_CASE("light_field: views at any positions are read back, with the centre first") {
  LightField light_field = Make(4, 7, 5);
  light_field.positions = {{0, 0}, {0.7, -0.25}, {-1, 0.3333}, {0, 1}};
  TempFolder folder;
  REQUIRE(Save(folder, light_field) == "");
  CHECK(fs::exists(folder.file("view_+0.7_-0.25.png")));
  LightField back = ValueOf(Load(folder));
  REQUIRE(back.views.size() == 4);
  CHECK_FALSE(AreStar(back.positions));
  // The loader returns the views of the star set first. Views outside the star set follow in the
  // order of u.
  const int order[] = {0, 3, 2, 1};
  for (size_t i = 0; i < 4; ++i) {
    CHECK(back.views[i].pixels[0] == 10 * order[i] + 3);
    CHECK(SamePosition(back.positions[i], light_field.positions[size_t(order[i])]));
  }
  test::Config config;
  ConfigureViews(back, &config);
  CHECK(config.views == 4);
  CHECK(config.positions[3].v == -0.25);
  back = ValueOf(Load(folder, {{0, 0}, {0.7, -0.25}}));
  CHECK(back.views.size() == 2);
  CHECK(back.views[1].pixels[0] == 13);
  CHECK(Contains(Load(folder, {{0, 0}, {0.7, 0.25}}), "+0.7_+0.25"));
}

TEST_CASE(
    "light_field: coverage is read from grey levels or alpha and has the size of the centre view") {
  const std::vector<uint8_t> levels = {0, 1, 127, 128, 254, 255};
  TempFolder folder, other;
  REQUIRE(Save(folder, Make(1, 3, 2)) == "");
  CHECK(ValueOf(Load(folder)).coverage.empty());
  const auto write = [&](int width, int height) {
    const GreyImage grey = {width, height, {levels.begin(), levels.end()}};
    return WriteFile(folder.file("coverage.png"), ValueOf(EncodeGreyPng("coverage.png", grey)));
  };
  REQUIRE(write(3, 2) == "");
  CHECK(ValueOf(Load(folder)).coverage == levels);
  CHECK(IsLightFieldFile("coverage.png"));
  REQUIRE(Save(other, ValueOf(Load(folder))) == "");
  CHECK(LightFieldFiles(other.path()).size() == 3);
  CHECK(ValueOf(Load(other)).coverage == levels);
  REQUIRE(write(2, 3) == "");
  CHECK(Contains(Load(folder), "expected 3x2 pixels, the size of the centre view"));
}

TEST_CASE("light_field: a star set with missing views is read, but not without its centre view") {
  TempFolder folder;
  REQUIRE(Save(folder, Make(9, 4, 4)) == "");
  Remove(folder, 6);
  LightField back = ValueOf(Load(folder));
  CHECK(back.views.size() == 8);
  CHECK_FALSE(AreStar(back.positions));
  CHECK(Contains(Load(folder, StarPositions(9)), StarName(6)));
  back = ValueOf(Load(folder, StarPositions(5)));
  CHECK(AreStar(back.positions));
  Remove(folder, 0);
  CHECK(Contains(Load(folder), StarName(0)));
  CHECK(Contains(Load(folder, StarPositions(5)), StarName(0)));
}

TEST_CASE("light_field: views out of range, at equal positions, or above 17 are rejected") {
  const struct {
    std::vector<std::string> views;
    const char* error;
  } rows[] = {{{"view_+1.1_+0.0.png"}, "view_+1.1_+0.0.png"},
              {{"view_+1.00_+0.0.png"}, "view_+1.00_+0.0"},
              // The two equal positions agree to four decimals, but are not neighbours when
              // positions are sorted by u and v.
              {{"view_+0.30001_+0.4.png", "view_+0.30002_+0.1.png", "view_+0.30003_+0.4.png"},
               "a different position for each view"},
              {{"view_+0.2_+0.0.png"}, "at most 17 views"}};
  TempFolder folder;
  REQUIRE(Save(folder, Make(17, 4, 4)) == "");
  for (const auto& row : rows) {
    for (const std::string& name : row.views) {
      REQUIRE(WriteImage(folder.file(name), Image(4, 4)) == "");
    }
    CHECK(Contains(Load(folder), row.error));
    CHECK(Load(folder, StarPositions(17)) != "");
    for (const std::string& name : row.views) fs::remove(folder.file(name));
  }
}

TEST_CASE("light_field: files whose names only resemble views are ignored") {
  TempFolder folder;
  REQUIRE(Save(folder, Make(1, 4, 4)) == "");
  for (const char* name : {"view_1.0_+0.0.png", "view_+1.0.png", "view_+_+0.0.png", "view_.png",
                           "view_+1e0_+0.0.png", "view_+1.0_+0.0.gif", "view_+1.0_+0.0_a.png",
                           "view_+1.0.0_+0.0.png", "view_++1.0_+0.0.png"}) {
    REQUIRE(WriteFile(folder.file(name), {}) == "");
    CHECK_FALSE(IsLightFieldFile(name));
  }
  CHECK(ValueOf(Load(folder)).views.size() == 1);
}

TEST_CASE("light_field: a stereo pair in the Middlebury layout has its second view at (1, 0)") {
  TempFolder folder;
  const LightField light_field = Make(2, 6, 4);
  REQUIRE(WriteImage(folder.file("im0.png"), light_field.views[0]) == "");
  // A single picture is not a pair.
  CHECK(Contains(Load(folder), StarName(0)));
  REQUIRE(WriteImage(folder.file("im1.png"), light_field.views[1]) == "");
  REQUIRE(WritePfm(folder.file("disp0.pfm"), light_field.disparity) == "");
  LightField back = ValueOf(Load(folder));
  REQUIRE(back.views.size() == 2);
  CHECK(back.views[1].pixels[0] == 13);
  CHECK(SamePosition(back.positions[1], {1, 0}));
  CHECK(back.disparity.at(5, 3) == 1.5f);
  for (const char* name : {"im0.png", "im1.png", "disp0.pfm"}) CHECK(IsLightFieldFile(name));
  CHECK(LightFieldFiles(folder.path()).size() == 3);
  // disparity.pfm takes precedence.
  FloatMap map = light_field.disparity;
  map.values[0] = 2;
  REQUIRE(WritePfm(folder.file("disparity.pfm"), map) == "");
  CHECK(ValueOf(Load(folder)).disparity.at(0, 0) == 2);
}

TEST_CASE(
    "light_field: pictures and maps of different sizes, and folders without a set, are rejected") {
  TempFolder folder;
  CHECK(Contains(LoadLightField(folder.file("none"), {}), "found nothing"));
  REQUIRE(WriteFile(folder.file("file"), {}) == "");
  CHECK(Contains(LoadLightField(folder.file("file"), {}), "found a file"));
  CHECK(Contains(Load(folder), StarName(0)));
  REQUIRE(Save(folder, Make(5, 6, 4)) == "");
  REQUIRE(WriteImage(folder.file(StarName(3) + ".png"), Image(6, 5)) == "");
  for (const std::string& part : {StarName(3), std::string("6x4"), std::string("6x5")}) {
    CHECK(Contains(Load(folder), part));
  }
  REQUIRE(WriteImage(folder.file(StarName(3) + ".png"), Image(6, 4)) == "");
  REQUIRE(WritePfm(folder.file("disparity.pfm"), Make(1, 4, 6).disparity) == "");
  CHECK(Contains(Load(folder), "found 4x6"));
  fs::remove(folder.file("disparity.pfm"));
  CHECK(Contains(Load(folder), "disparity.pfm"));
  // A pipe is rejected without waiting.
  for (const std::string& name : {std::string("disparity.pfm"), StarName(2) + ".png"}) {
    fs::remove(folder.file(name));
    REQUIRE(mkfifo(folder.file(name).c_str(), 0600) == 0);
    CHECK(Contains(Load(folder), name + ": it is a device or pipe"));
  }
}

Result<FloatMap> ReadText(const std::string& text) {
  TempFolder folder;
  const std::string path = folder.file("map.pfm");
  REQUIRE(WriteFile(path, Bytes(text.begin(), text.end())) == "");
  return ReadPfm(path);
}

TEST_CASE("pfm: maps of either byte order are read back exactly") {
  TempFolder folder;
  const FloatMap map = {3, 2, {1.5f, -2.25f, 1e-30f, HUGE_VALF, -HUGE_VALF, 7}};
  for (ByteOrder order : {ByteOrder::kLittle, ByteOrder::kBig}) {
    REQUIRE(WritePfm(folder.file("a.pfm"), map, order) == "");
    const FloatMap back = ValueOf(ReadPfm(folder.file("a.pfm")));
    CHECK(std::tie(back.width, back.height, back.values) ==
          std::tie(map.width, map.height, map.values));
  }
  CHECK(folder.count() == 1);
}

TEST_CASE("pfm: rows are stored from bottom to top, and the sign of the scale is the byte order") {
  // 1.0f is 3f800000, 2.0f is 40000000.
  for (const std::string& file : {"Pf\n1 2\n-1.0\n" + std::string("\0\0\x80\x3f\0\0\0\x40", 8),
                                  "Pf\n1 2\n0.5\n" + std::string("\x3f\x80\0\0\x40\0\0\0", 8)}) {
    CHECK(ValueOf(ReadText(file)).values == std::vector<float>{2, 1});
  }
  const FloatMap map = ValueOf(ReadText("Pf 1 1 -1\n" + std::string("\0\0\xc0\x7f", 4)));
  CHECK(std::isnan(map.at(0, 0)));
  // Bytes of white space and # after the header are data.
  CHECK(ReadText("Pf\n1 1\n-1\n\n \t#") == "");
  CHECK(ReadText("Pf\n1 1\n-1\n####") == "");
}

TEST_CASE("pfm: malformed files cause one-line errors") {
  for (const char* text : {"",
                           "Pf",
                           "PF\n1 1\n-1\n0123456789ab",
                           "P6\n1 1\n255\nabc",
                           "Pf\n0 1\n-1\n",
                           "Pf\n1 0\n-1\n",
                           "Pf\n-1 1\n-1\nabcd",
                           "Pf\n1 -1\n-1\nabcd",
                           "Pf\n65536 1\n-1\nabcd",
                           "Pf\n99999999999999999999 1\n-1\nabcd",
                           "Pf\n65535 65535\n-1\nabcd",
                           "Pf\n1.5 1\n-1\nabcd",
                           "Pf\n1 1\n0\nabcd",
                           "Pf\n1 1\nnan\nabcd",
                           "Pf\n1 1\ninf\nabcd",
                           "Pf\n1 1\nx\nabcd",
                           "Pf\n1 1\n-1",
                           "Pf\n1 1\n-1\nabc",
                           "Pf\n1 1\n-1\nabcde",
                           "Pf\n1 1\n-1\r\nabcd"}) {
    CAPTURE(text);
    const std::string error = ReadText(text).error().line();
    CHECK(Contains(error, ": expected "));
    CHECK(!Contains(error, "\n"));
  }
}

using Names = std::vector<std::string>;

TEST_CASE("natural order: names are sorted by their numbers, whatever order they come in") {
  std::istringstream words(
      "-1 0 00 1.5 1.10 2 F_1 a a01 a1 a1b2 a1b10 a2b1 a10 a10-x a010_1 frame frame_9.png "
      "frame_10.png frame_18446744073709551616 frame_18446744073709551617");
  const Names sorted{std::istream_iterator<std::string>(words), {}};
  for (const std::string& a : sorted) {
    for (const std::string& b : sorted) {
      CAPTURE(a);
      CAPTURE(b);
      CHECK(NaturalLess(a, b) == (&a < &b));
    }
  }
  Names names = sorted;
  for (int turn = 0; turn < 50; ++turn) {
    std::next_permutation(names.begin(), names.end());
    std::reverse(names.begin() + turn % 10, names.end());
    Names again = names;
    std::sort(again.begin(), again.end(), NaturalLess);
    CHECK(again == sorted);
  }
}

TEST_CASE("natural order: a name has a shape and numbers without leading zeros") {
  const NumberedName name = ParseNumberedName("Shot_02_depth_0104");
  CHECK(name.shape == "shot_#_depth_#");
  CHECK(name.numbers == Names{"2", "104"});
  CHECK(ParseNumberedName("000").numbers == ParseNumberedName("0").numbers);
  CHECK(ParseNumberedName("depth").numbers.empty());
}

}  // namespace
}  // namespace starfocus::light_field_test
