// SPDX-License-Identifier: Apache-2.0
// Tests folders of light fields, their maps in PFM files, and the order of file names by their
// numbers.
#include "platform/light_field.h"

#include <doctest/doctest.h>

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
    REQUIRE(fs::remove(folder.file(StarName(0) + ".png")));
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

TEST_CASE("light_field: views with a linear profile are linear light") {
  for (const int transfer : {8, 13}) {
    TempFolder folder;
    REQUIRE(Save(folder, Make(1, 7, 5)) == "");
    const std::string path = folder.file(StarName(0) + ".png");
    PictureOptions how;
    how.metadata.icc = ProfileOf({"test", 1, transfer});
    REQUIRE(WriteImage(path, photos::Plain(7, 5, 3), how) == "");
    if (ValueOf(ReadPicture(path)).metadata.icc.empty()) return;  // a build without libpng
    CHECK(ValueOf(Load(folder)).is_linear == (transfer == 8));
  }
}

TEST_CASE("light_field: an engine gets the positions of the views") {
  LightField field = Make(3, 7, 5);
  test::Config config;
  field.positions = {{0, 0}, {0.7, -0.25}, {0, 1}};
  ConfigureViews(field, &config);
  CHECK(std::tie(config.views, config.positions[1].u, config.positions[1].v) ==
        std::tuple(3, 0.7, -0.25));
  CHECK(std::tie(config.positions[2].u, config.positions[2].v) == std::tuple(0.0, 1.0));
}

TEST_CASE("light_field: folders without views or a map are rejected") {
  TempFolder folder;
  CHECK(Contains(LoadLightField(folder.file("none"), {}), "found nothing"));
  REQUIRE(WriteFile(folder.file("file"), {}) == "");
  CHECK(Contains(LoadLightField(folder.file("file"), {}), "found a file"));
  CHECK(Contains(Load(folder), StarName(0)));
  REQUIRE(Save(folder, Make(5, 6, 4)) == "");
  fs::remove(folder.file("disparity.pfm"));
  CHECK(Contains(Load(folder), "disparity.pfm"));
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
