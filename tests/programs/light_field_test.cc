// SPDX-License-Identifier: Apache-2.0
#include "platform/light_field.h"

#include <doctest/doctest.h>
#include <sys/stat.h>

#include <filesystem>
#include <string>

#include "platform/image_io.h"
#include "platform/writers/png.h"
#include "tests/support/config.h"
#include "tests/support/error_line.h"
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
    Image view(width, height);
    for (uint8_t& sample : view.pixels) sample = static_cast<uint8_t>(10 * i + 3);
    light_field.views.push_back(view);
  }
  light_field.disparity.width = width;
  light_field.disparity.height = height;
  light_field.disparity.values.assign(size_t(width) * size_t(height), 1.5f);
  return light_field;
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
    REQUIRE(Save(folder, Make(saved, 7, 5)) == "");
    for (int asked : {0, 1, 5, 9, 17}) {
      CAPTURE(saved);
      CAPTURE(asked);
      const Result<LightField> read = LoadLightField(folder.path(), StarPositions(asked));
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

TEST_CASE("light_field: views may have different formats") {
  TempFolder folder;
  const LightField light_field = Make(5, 8, 8);
  REQUIRE(Save(folder, light_field) == "");
  Remove(folder, 1);
  Remove(folder, 2);
  REQUIRE(WriteImage(folder.file(StarName(1) + ".ppm"), light_field.views[1]) == "");
  REQUIRE(WriteImage(folder.file(StarName(2) + ".jpg"), light_field.views[2]) == "");
  LightField back = ValueOf(LoadLightField(folder.path(), {}));
  CHECK(back.views.size() == 5);
}

TEST_CASE("light_field: views at any positions are read back, with the centre first") {
  LightField light_field = Make(4, 7, 5);
  light_field.positions = {{0, 0}, {0.7, -0.25}, {-1, 0.3333}, {0, 1}};
  TempFolder folder;
  REQUIRE(Save(folder, light_field) == "");
  CHECK(fs::exists(folder.file("view_+0.7_-0.25.png")));
  LightField back = ValueOf(LoadLightField(folder.path(), {}));
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
  back = ValueOf(LoadLightField(folder.path(), {{0, 0}, {0.7, -0.25}}));
  CHECK(back.views.size() == 2);
  CHECK(back.views[1].pixels[0] == 13);
  CHECK(Contains(LoadLightField(folder.path(), {{0, 0}, {0.7, 0.25}}), "+0.7_+0.25"));
}

TEST_CASE(
    "light_field: coverage is read from grey levels or alpha and has the size of the centre view") {
  LightField light_field = Make(1, 3, 2);
  TempFolder folder;
  REQUIRE(Save(folder, light_field) == "");
  LightField back = ValueOf(LoadLightField(folder.path(), {}));
  CHECK(back.coverage.empty());
  GreyImage grey;
  grey.width = 3;
  grey.height = 2;
  grey.levels = {0, 1, 127, 128, 254, 255};
  Bytes png = ValueOf(EncodeGreyPng("coverage.png", grey));
  const std::string path = folder.file("coverage.png");
  REQUIRE(WriteFile(path, png) == "");
  back = ValueOf(LoadLightField(folder.path(), {}));
  CHECK((back.coverage == std::vector<uint8_t>{0, 1, 127, 128, 254, 255}));
  CHECK(IsLightFieldFile("coverage.png"));
  TempFolder other;
  REQUIRE(Save(other, back) == "");
  CHECK(LightFieldFiles(other.path()).size() == 3);
  back = ValueOf(LoadLightField(other.path(), {}));
  CHECK((back.coverage == std::vector<uint8_t>{0, 1, 127, 128, 254, 255}));
  grey.width = 2;
  grey.height = 3;
  png = ValueOf(EncodeGreyPng("coverage.png", grey));
  REQUIRE(WriteFile(path, png) == "");
  CHECK(Contains(LoadLightField(folder.path(), {}),
                 "expected 3x2 pixels, the size of the centre view"));
}

TEST_CASE("light_field: a star set with missing views is read, but not without its centre view") {
  TempFolder folder;
  REQUIRE(Save(folder, Make(9, 4, 4)) == "");
  Remove(folder, 6);
  LightField back = ValueOf(LoadLightField(folder.path(), {}));
  CHECK(back.views.size() == 8);
  CHECK_FALSE(AreStar(back.positions));
  CHECK(Contains(LoadLightField(folder.path(), StarPositions(9)), StarName(6)));
  back = ValueOf(LoadLightField(folder.path(), StarPositions(5)));
  CHECK(AreStar(back.positions));
  Remove(folder, 0);
  CHECK(Contains(LoadLightField(folder.path(), {}), StarName(0)));
  CHECK(Contains(LoadLightField(folder.path(), StarPositions(5)), StarName(0)));
}

TEST_CASE("light_field: views out of range, at equal positions, or above 17 are rejected") {
  TempFolder folder;
  REQUIRE(Save(folder, Make(17, 4, 4)) == "");
  const std::string far = folder.file("view_+1.1_+0.0.png");
  REQUIRE(WriteImage(far, Image(4, 4)) == "");
  CHECK(Contains(LoadLightField(folder.path(), {}), far));
  fs::remove(far);
  const std::string twice = folder.file("view_+1.00_+0.0.png");
  REQUIRE(WriteImage(twice, Image(4, 4)) == "");
  CHECK(Contains(LoadLightField(folder.path(), {}), "view_+1.00_+0.0"));
  fs::remove(twice);
  // The two equal positions agree to four decimals, but are not neighbours when positions are
  // sorted by u and v.
  const std::string close[] = {"view_+0.30001_+0.4.png", "view_+0.30002_+0.1.png",
                               "view_+0.30003_+0.4.png"};
  for (const std::string& name : close) {
    REQUIRE(WriteImage(folder.file(name), Image(4, 4)) == "");
  }
  CHECK(Contains(LoadLightField(folder.path(), {}), "a different position for each view"));
  for (const std::string& name : close) fs::remove(folder.file(name));
  REQUIRE(WriteImage(folder.file("view_+0.2_+0.0.png"), Image(4, 4)) == "");
  CHECK(Contains(LoadLightField(folder.path(), {}), "at most 17 views"));
  CHECK(LoadLightField(folder.path(), StarPositions(17)) != "");
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
  LightField back = ValueOf(LoadLightField(folder.path(), {}));
  CHECK(back.views.size() == 1);
}

TEST_CASE("light_field: a stereo pair in the Middlebury layout has its second view at (1, 0)") {
  TempFolder folder;
  const LightField light_field = Make(2, 6, 4);
  REQUIRE(WriteImage(folder.file("im0.png"), light_field.views[0]) == "");
  // A single picture is not a pair.
  CHECK(Contains(LoadLightField(folder.path(), {}), StarName(0)));
  REQUIRE(WriteImage(folder.file("im1.png"), light_field.views[1]) == "");
  REQUIRE(WritePfm(folder.file("disp0.pfm"), light_field.disparity) == "");
  LightField back = ValueOf(LoadLightField(folder.path(), {}));
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
  back = ValueOf(LoadLightField(folder.path(), {}));
  CHECK(back.disparity.at(0, 0) == 2);
}

TEST_CASE("light_field: pictures and maps of different sizes are rejected") {
  TempFolder folder;
  REQUIRE(Save(folder, Make(5, 6, 4)) == "");
  REQUIRE(WriteImage(folder.file(StarName(3) + ".png"), Image(6, 5)) == "");
  const std::string error = LoadLightField(folder.path(), {}).error().line();
  CHECK(Contains(error, StarName(3)));
  CHECK(Contains(error, "6x4"));
  CHECK(Contains(error, "6x5"));
  REQUIRE(WriteImage(folder.file(StarName(3) + ".png"), Image(6, 4)) == "");
  REQUIRE(WritePfm(folder.file("disparity.pfm"), Make(1, 4, 6).disparity) == "");
  CHECK(Contains(LoadLightField(folder.path(), {}), "found 4x6"));
  fs::remove(folder.file("disparity.pfm"));
  CHECK(Contains(LoadLightField(folder.path(), {}), "disparity.pfm"));
}

TEST_CASE("light_field: a pipe instead of a view or a map is rejected without waiting") {
  for (const std::string& name : {StarName(2) + ".png", std::string("disparity.pfm")}) {
    TempFolder folder;
    REQUIRE(Save(folder, Make(5, 4, 4)) == "");
    REQUIRE(fs::remove(folder.file(name)));
    REQUIRE(mkfifo(folder.file(name).c_str(), 0600) == 0);
    const std::string error = LoadLightField(folder.path(), {}).error().line();
    CHECK(Contains(error, name));
    CHECK(Contains(error, "pipe"));
  }
}

TEST_CASE("light_field: a missing folder, a file and an empty folder are rejected") {
  TempFolder folder;
  CHECK(Contains(LoadLightField(folder.file("none"), {}), "found nothing"));
  REQUIRE(WriteFile(folder.file("file"), {}) == "");
  CHECK(Contains(LoadLightField(folder.file("file"), {}), "found a file"));
  CHECK(Contains(LoadLightField(folder.path(), {}), StarName(0)));
}

}  // namespace
}  // namespace starfocus::light_field_test
