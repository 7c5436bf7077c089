// SPDX-License-Identifier: Apache-2.0
#include "platform/light_field.h"

#include <doctest/doctest.h>
#include <sys/stat.h>

#include <filesystem>
#include <string>

#include "platform/image_io.h"
#include "tests/support/temp_folder.h"

namespace starfocus {
namespace {

namespace fs = std::filesystem;

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

std::string Save(const TempFolder& folder, const LightField& light_field) {
  ThreadRunner runner(2);
  return SaveLightField(folder.path(), light_field, &runner);
}

void Remove(const TempFolder& folder, int view) {
  REQUIRE(fs::remove(folder.file(ViewName(view) + ".png")));
}

bool Contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_CASE("light_field: names follow sf_view_position") {
  CHECK(ViewName(0) == "view_+0.0_+0.0");
  CHECK(ViewName(1) == "view_+1.0_+0.0");
  CHECK(ViewName(4) == "view_+0.0_-1.0");
  CHECK(ViewName(6) == "view_-1.0_+1.0");
  CHECK(ViewName(16) == "view_-0.5_-0.5");
}

TEST_CASE("light_field: every star set comes back in order, whole or in part") {
  for (int saved : kStarSets) {
    TempFolder folder;
    REQUIRE(Save(folder, Make(saved, 7, 5)) == "");
    int counted = 0;
    CHECK(CountViews(folder.path(), &counted) == "");
    CHECK(counted == saved);
    for (int asked : {0, 1, 5, 9, 17}) {
      CAPTURE(saved);
      CAPTURE(asked);
      LightField back;
      const std::string error = LoadLightField(folder.path(), asked, &back);
      if (asked > saved) {
        CHECK(Contains(error, "expected " + std::to_string(asked) + " views"));
        continue;
      }
      REQUIRE(error == "");
      REQUIRE(back.views.size() == size_t(asked == 0 ? saved : asked));
      for (size_t i = 0; i < back.views.size(); ++i) CHECK(back.views[i].pixels[0] == 10 * i + 3);
      CHECK(back.disparity.at(6, 4) == 1.5f);
    }
  }
}

TEST_CASE("light_field: formats mix") {
  TempFolder folder;
  const LightField light_field = Make(5, 8, 8);
  REQUIRE(Save(folder, light_field) == "");
  Remove(folder, 1);
  Remove(folder, 2);
  REQUIRE(WriteImage(folder.file(ViewName(1) + ".ppm"), light_field.views[1]) == "");
  REQUIRE(WriteImage(folder.file(ViewName(2) + ".jpg"), light_field.views[2]) == "");
  LightField back;
  CHECK(LoadLightField(folder.path(), 0, &back) == "");
  CHECK(back.views.size() == 5);
}

TEST_CASE("light_field: a partial set names the missing view, unless fewer are asked for") {
  TempFolder folder;
  REQUIRE(Save(folder, Make(9, 4, 4)) == "");
  Remove(folder, 6);
  LightField back;
  CHECK(Contains(LoadLightField(folder.path(), 0, &back), ViewName(6)));
  CHECK(Contains(LoadLightField(folder.path(), 9, &back), ViewName(6)));
  CHECK(LoadLightField(folder.path(), 5, &back) == "");
  Remove(folder, 0);
  CHECK(Contains(LoadLightField(folder.path(), 0, &back), ViewName(0)));
  CHECK(Contains(LoadLightField(folder.path(), 5, &back), ViewName(0)));
}

TEST_CASE("light_field: inner views without the outer ones are a partial set") {
  TempFolder folder;
  REQUIRE(Save(folder, Make(17, 4, 4)) == "");
  for (int view : {5, 6, 7, 8}) Remove(folder, view);
  LightField back;
  CHECK(Contains(LoadLightField(folder.path(), 0, &back), ViewName(5)));
}

TEST_CASE("light_field: sizes must agree") {
  TempFolder folder;
  REQUIRE(Save(folder, Make(5, 6, 4)) == "");
  REQUIRE(WriteImage(folder.file(ViewName(3) + ".png"), Image(6, 5)) == "");
  LightField back;
  const std::string error = LoadLightField(folder.path(), 0, &back);
  CHECK(Contains(error, ViewName(3)));
  CHECK(Contains(error, "6x4"));
  CHECK(Contains(error, "6x5"));
  REQUIRE(WriteImage(folder.file(ViewName(3) + ".png"), Image(6, 4)) == "");
  REQUIRE(WritePfm(folder.file("disparity.pfm"), Make(1, 4, 6).disparity) == "");
  CHECK(Contains(LoadLightField(folder.path(), 0, &back), "found 4x6"));
  fs::remove(folder.file("disparity.pfm"));
  CHECK(Contains(LoadLightField(folder.path(), 0, &back), "disparity.pfm"));
  CHECK(back.views.empty());
}

TEST_CASE("light_field: a pipe in place of a view or the map keeps nobody waiting") {
  for (const std::string& name : {ViewName(2) + ".png", std::string("disparity.pfm")}) {
    TempFolder folder;
    REQUIRE(Save(folder, Make(5, 4, 4)) == "");
    REQUIRE(fs::remove(folder.file(name)));
    REQUIRE(mkfifo(folder.file(name).c_str(), 0600) == 0);
    LightField back;
    const std::string error = LoadLightField(folder.path(), 0, &back);
    CHECK(Contains(error, name));
    CHECK(Contains(error, "pipe"));
  }
}

TEST_CASE("light_field: no folder, a file, an empty folder") {
  TempFolder folder;
  LightField back;
  CHECK(Contains(LoadLightField(folder.file("none"), 0, &back), "found nothing"));
  REQUIRE(WriteFile(folder.file("file"), {}) == "");
  CHECK(Contains(LoadLightField(folder.file("file"), 0, &back), "found a file"));
  CHECK(Contains(LoadLightField(folder.path(), 0, &back), ViewName(0)));
  CHECK(Contains(LoadLightField(folder.path(), 3, &back), "1, 5, 9 or 17"));
}

}  // namespace
}  // namespace starfocus
