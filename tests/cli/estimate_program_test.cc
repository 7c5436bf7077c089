// SPDX-License-Identifier: Apache-2.0
// Light fields without a disparity map: `starfocus disparity`, and what else estimates one.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include "platform/image_io.h"
#include "platform/light_field.h"
#include "platform/runner.h"
#include "tests/cli/call_program.h"
#include "tests/support/closed_hair.h"
#include "tests/support/error_line.h"
#include "tests/support/temp_folder.h"
#include "tests/support/test_scene.h"

namespace starfocus::estimate_program_test {
namespace {

namespace fs = std::filesystem;

// A light field `lf` with its map, and `bare` without.
void PrepareScene(const TempFolder& folder, const std::string& name = "wires --size 160x120") {
  REQUIRE(Call(folder, "scene lf --views 5 --name " + name).code == 0);
  fs::copy(folder.file("lf"), folder.file("bare"));
  fs::remove(folder.file("bare/disparity.pfm"));
}

TEST_CASE("disparity: finds the range and most of the map of a traced scene") {
  TempFolder folder;
  PrepareScene(folder);
  const Outcome made = Call(folder, "disparity bare --confidence sure.png");
  CAPTURE(made.err);
  REQUIRE(made.code == 0);
  CHECK(made.err == "");
  CHECK(made.out.find("5 views") != std::string::npos);
  FloatMap exact, found;
  REQUIRE(ReadPfm(folder.file("lf/disparity.pfm"), &exact) == "");
  REQUIRE(ReadPfm(folder.file("bare/disparity.pfm"), &found) == "");
  REQUIRE(found.values.size() == exact.values.size());
  int off = 0;
  for (size_t i = 0; i < exact.values.size(); ++i) {
    off += std::fabs(found.values[i] - exact.values[i]) > 0.5;
  }
  CHECK(off < int(exact.values.size()) / 8);
  Image picture, sure;
  REQUIRE(ReadImage(folder.file("bare/disparity.png"), &picture) == "");
  REQUIRE(ReadImage(folder.file("sure.png"), &sure) == "");
  CHECK(picture.width == 160);
  CHECK(sure.height == 120);
}

TEST_CASE("disparity: what is written there already stays") {
  TempFolder folder;
  PrepareScene(folder);
  const std::string before = Text(folder.file("lf/disparity.pfm"));
  const Outcome refused = Call(folder, "disparity lf");
  CHECK(refused.code == 1);
  CHECK(refused.err.find("--output") != std::string::npos);
  CHECK(Text(folder.file("lf/disparity.pfm")) == before);
  CHECK(Call(folder, "disparity lf -o new.pfm --range -3:9 --threads 2").code == 0);
  CHECK(Call(folder, "disparity lf -o again.pfm --range -3:9").code == 0);
  CHECK(Text(folder.file("new.pfm")) == Text(folder.file("again.pfm")));
  CHECK(Text(folder.file("new.png")) == Text(folder.file("again.png")));
}

// The map of `lf` with its near objects 3 pixels wider, in `worse`.
void MakeWorse(const TempFolder& folder) {
  fs::copy(folder.file("lf"), folder.file("worse"));
  FloatMap exact;
  REQUIRE(ReadPfm(folder.file("lf/disparity.pfm"), &exact) == "");
  FloatMap worse = exact;
  for (int y = 0; y < exact.height; ++y) {
    for (int x = 3; x + 3 < exact.width; ++x) {
      const float* row = exact.values.data() + y * exact.width + x;
      worse.values[size_t(y * exact.width + x)] = *std::max_element(row - 3, row + 4);
    }
  }
  worse.values[5] = NAN;
  REQUIRE(WritePfm(folder.file("worse/disparity.pfm"), worse) == "");
}

double Psnr(const TempFolder& folder, const std::string& names) {
  const std::string out = Call(folder, "compare " + names).out;
  return std::stod(out.substr(out.find(' ')));
}

TEST_CASE("disparity --repair, refocus --repair: nearer to the exact map's picture") {
  TempFolder folder;
  PrepareScene(folder, "portrait --size 256x192");
  MakeWorse(folder);
  REQUIRE(Call(folder, "refocus lf -o exact.png --focus 0").code == 0);
  REQUIRE(Call(folder, "refocus worse -o worse.png --focus 0 --fill-invalid").code == 0);
  CHECK(Call(folder, "refocus worse -o x.png --focus 0").code == 1);  // NaN
  const Outcome direct = Call(folder, "refocus worse -o direct.png --focus 0 --repair");
  CAPTURE(direct.err);
  REQUIRE(direct.code == 0);
  CHECK(Psnr(folder, "exact.png direct.png") > Psnr(folder, "exact.png worse.png") + 4);
  const Outcome made = Call(folder, "disparity worse --repair -o map.pfm --confidence sure.png");
  CAPTURE(made.err);
  REQUIRE(made.code == 0);
  CHECK(made.out.find("repaired by 5 views") != std::string::npos);
  fs::copy_file(folder.file("map.pfm"), folder.file("worse/disparity.pfm"),
                fs::copy_options::overwrite_existing);
  REQUIRE(Call(folder, "refocus worse -o after.png --focus 0").code == 0);
  CHECK(Text(folder.file("direct.png")) == Text(folder.file("after.png")));
}

TEST_CASE("disparity --repair, refocus --repair: one view is repaired by its colours") {
  TempFolder folder;
  PrepareScene(folder, "portrait --size 256x192");
  fs::copy(folder.file("lf"), folder.file("noisy"));
  FloatMap map;
  REQUIRE(ReadPfm(folder.file("lf/disparity.pfm"), &map) == "");
  test::Random random(3);
  for (float& value : map.values) value += float(random.Int(-150, 150)) * 0.01F;
  REQUIRE(WritePfm(folder.file("noisy/disparity.pfm"), map) == "");
  REQUIRE(Call(folder, "refocus lf -o exact.png --focus 0 --views 1").code == 0);
  REQUIRE(Call(folder, "refocus noisy -o noisy.png --focus 0 --views 1").code == 0);
  REQUIRE(Call(folder, "refocus noisy -o repaired.png --focus 0 --views 1 --repair").code == 0);
  CHECK(Psnr(folder, "exact.png repaired.png") > Psnr(folder, "exact.png noisy.png") + 3);
  const Outcome made = Call(folder, "disparity noisy --repair --views 1 -o map.pfm");
  CHECK(made.code == 0);
  CHECK(made.out.find("repaired by 1 view,") != std::string::npos);
}

// Writes the folder `truth`, a portrait with the coverage of its hair, and `closed`, the same
// without.
void PrepareHair(const TempFolder& folder) {
  const test::ClosedHair portrait = test::MakeClosedHair();
  LightField field;
  field.views.emplace_back(test::ClosedHair::kWidth, test::ClosedHair::kHeight);
  field.views[0].pixels = portrait.rgb;
  field.disparity.width = test::ClosedHair::kWidth;
  field.disparity.height = test::ClosedHair::kHeight;
  field.disparity.values = portrait.map;
  ThreadRunner runner(1);
  REQUIRE(SaveLightField(folder.file("closed"), field, &runner) == "");
  field.coverage = portrait.coverage;
  REQUIRE(SaveLightField(folder.file("truth"), field, &runner) == "");
}

TEST_CASE("refocus --repair, import: hair with a closed outline gets its coverage") {
  TempFolder folder;
  PrepareHair(folder);
  REQUIRE(Call(folder, "refocus truth -o truth.png --focus -4").code == 0);
  REQUIRE(Call(folder, "refocus closed -o closed.png --focus -4").code == 0);
  REQUIRE(Call(folder, "refocus closed -o repaired.png --focus -4 --repair").code == 0);
  CHECK(Psnr(folder, "truth.png repaired.png") > Psnr(folder, "truth.png closed.png") + 3);
  REQUIRE(Call(folder, "import closed imported --repair").code == 0);
  REQUIRE(fs::exists(folder.file("imported/coverage.png")));
  REQUIRE(Call(folder, "refocus imported -o imported.png --focus -4").code == 0);
  CHECK(Text(folder.file("imported.png")) == Text(folder.file("repaired.png")));
  // Coverage that was given stays.
  REQUIRE(Call(folder, "refocus truth -o given.png --focus -4 --repair").code == 0);
  CHECK(Psnr(folder, "truth.png given.png") > Psnr(folder, "truth.png repaired.png"));
}

TEST_CASE("disparity --repair --coverage: writes what is found, and nothing if nothing is") {
  TempFolder folder;
  PrepareHair(folder);
  const Outcome made =
      Call(folder, "disparity closed --repair -o map.pfm --coverage cover.png --confidence c.png");
  CHECK(made.err == "");
  REQUIRE(made.code == 0);
  REQUIRE(Call(folder, "refocus closed -o repaired.png --focus -4 --repair").code == 0);
  fs::copy_file(folder.file("cover.png"), folder.file("closed/coverage.png"));
  fs::copy_file(folder.file("map.pfm"), folder.file("closed/disparity.pfm"),
                fs::copy_options::overwrite_existing);
  REQUIRE(Call(folder, "refocus closed -o after.png --focus -4").code == 0);
  CHECK(Text(folder.file("after.png")) == Text(folder.file("repaired.png")));
  PrepareScene(folder);
  const Outcome none = Call(folder, "disparity lf --repair -o wires.pfm --coverage none.png");
  CHECK(none.code == 0);
  CHECK(none.err.find("no coverage") != std::string::npos);
  CHECK_FALSE(fs::exists(folder.file("none.png")));
}

TEST_CASE("disparity: bad input is refused") {
  TempFolder folder;
  PrepareScene(folder);
  REQUIRE(Call(folder, "scene single --size 40x30 --views 1").code == 0);
  const struct {
    const char *arguments, *mention;
  } bad[] = {{"disparity", "DIR"},
             {"disparity none", "none"},
             {"disparity bare --range 3", "--range"},
             {"disparity bare --range 3:2", "--range"},
             {"disparity bare --range nan:2", "--range"},
             {"disparity bare --range 0:501", "--range"},
             {"disparity bare --views 1", "--views"},
             {"disparity bare --views 9", "9 views"},
             {"disparity bare --threads 0", "--threads"},
             {"disparity bare -o map.png", ".pfm"},
             {"disparity bare -o none/map.pfm", "none"},
             {"disparity bare --confidence sure.txt", "sure.txt"},
             {"disparity bare --coverage cover.png", "--repair"},
             {"disparity lf --repair -o map.pfm --coverage cover.txt", "cover.txt"},
             {"disparity lf --repair -o map.pfm --coverage map.png", "--coverage"},
             {"disparity bare --confidence bare/disparity.png", "--confidence"},
             {"disparity bare --confidence bare/view_+0.0_+0.0.png", "light field"},
             {"disparity single -o map.pfm", "views"},
             {"disparity bare --repair -o map.pfm", "disparity.pfm"},
             {"disparity lf --repair", "--output"},
             {"disparity lf --repair -o map.pfm --range -3:3", "--range"}};
  for (const auto& one : bad) {
    CAPTURE(one.arguments);
    const int before = folder.count();
    const Outcome outcome = Call(folder, one.arguments);
    CAPTURE(outcome.err);
    CHECK(outcome.code != 0);
    CHECK(outcome.code != 70);
    CHECK(outcome.out == "");
    CHECK(outcome.err.find(one.mention) != std::string::npos);
    CHECK(folder.count() == before);
    CHECK(!fs::exists(folder.file("bare/disparity.pfm")));
  }
}

TEST_CASE("refocus, info: a map that is missing is estimated, and they say so") {
  TempFolder folder;
  PrepareScene(folder);
  const Outcome direct = Call(folder, "refocus bare -o direct.png --focus 3");
  CAPTURE(direct.err);
  REQUIRE(direct.code == 0);
  CHECK(direct.err.find("estimated from 5 views") != std::string::npos);
  CHECK(!fs::exists(folder.file("bare/disparity.pfm")));
  const Outcome info = Call(folder, "info bare");
  CHECK(info.code == 0);
  CHECK(info.err.find("estimated") != std::string::npos);
  REQUIRE(Call(folder, "disparity bare").code == 0);
  const Outcome after = Call(folder, "refocus bare -o after.png --focus 3");
  REQUIRE(after.code == 0);
  CHECK(after.err == "");
  CHECK(Text(folder.file("direct.png")) == Text(folder.file("after.png")));
  fs::copy(folder.file("lf"), folder.file("alone"));
  fs::remove(folder.file("alone/disparity.pfm"));
  const Outcome alone = Call(folder, "refocus alone -o x.png --focus 3 --views 1");
  CHECK(alone.code == 1);
  CHECK(alone.err.find("one view alone") != std::string::npos);
}

}  // namespace
}  // namespace starfocus::estimate_program_test
