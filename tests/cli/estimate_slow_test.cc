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

namespace starfocus::estimate_slow_test {
namespace {

namespace fs = std::filesystem;

// A light field `lf` with its map, and `bare` without.
void PrepareScene(const TempFolder& folder, const std::string& name = "wires --size 160x120") {
  Succeed(folder, "scene lf --views 5 --name " + name);
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
  CHECK(Contains(made.out, "5 views"));
  const FloatMap exact = ValueOf(ReadPfm(folder.file("lf/disparity.pfm")));
  const FloatMap found = ValueOf(ReadPfm(folder.file("bare/disparity.pfm")));
  REQUIRE(found.values.size() == exact.values.size());
  int off = 0;
  for (size_t i = 0; i < exact.values.size(); ++i) {
    off += std::fabs(found.values[i] - exact.values[i]) > 0.5;
  }
  CHECK(off < int(exact.values.size()) / 8);
  const Image picture = ValueOf(ReadImage(folder.file("bare/disparity.png")));
  const Image sure = ValueOf(ReadImage(folder.file("sure.png")));
  CHECK(picture.width == 160);
  CHECK(sure.height == 120);
}

TEST_CASE("disparity: what is written there already stays") {
  TempFolder folder;
  PrepareScene(folder);
  const std::string before = Text(folder.file("lf/disparity.pfm"));
  const Outcome refused = Call(folder, "disparity lf");
  CHECK(refused.code == 1);
  CHECK(Contains(refused.err, "--output"));
  CHECK(Text(folder.file("lf/disparity.pfm")) == before);
  CHECK(Call(folder, "disparity lf -o new.pfm --range -3:9 --threads 2").code == 0);
  CHECK(Call(folder, "disparity lf -o again.pfm --range -3:9").code == 0);
  CHECK(Text(folder.file("new.pfm")) == Text(folder.file("again.pfm")));
  CHECK(Text(folder.file("new.png")) == Text(folder.file("again.png")));
}

// The map of `lf` with its near objects 3 pixels wider, in `worse`.
void MakeWorse(const TempFolder& folder) {
  fs::copy(folder.file("lf"), folder.file("worse"));
  FloatMap exact = ValueOf(ReadPfm(folder.file("lf/disparity.pfm")));
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
  Succeed(folder, "refocus lf -o exact.png --focus 0");
  Succeed(folder, "refocus worse -o worse.png --focus 0 --fill-invalid");
  CHECK(Call(folder, "refocus worse -o x.png --focus 0").code == 1);  // NaN
  const Outcome direct = Call(folder, "refocus worse -o direct.png --focus 0 --repair");
  CAPTURE(direct.err);
  REQUIRE(direct.code == 0);
  CHECK(Psnr(folder, "exact.png direct.png") > Psnr(folder, "exact.png worse.png") + 4);
  const Outcome made = Call(folder, "disparity worse --repair -o map.pfm --confidence sure.png");
  CAPTURE(made.err);
  REQUIRE(made.code == 0);
  CHECK(Contains(made.out, "repaired by 5 views"));
  fs::copy_file(folder.file("map.pfm"), folder.file("worse/disparity.pfm"),
                fs::copy_options::overwrite_existing);
  Succeed(folder, "refocus worse -o after.png --focus 0");
  CHECK(Text(folder.file("direct.png")) == Text(folder.file("after.png")));
}

TEST_CASE("disparity --repair, refocus --repair: one view is repaired by its colours") {
  TempFolder folder;
  PrepareScene(folder, "portrait --size 256x192");
  fs::copy(folder.file("lf"), folder.file("noisy"));
  FloatMap map = ValueOf(ReadPfm(folder.file("lf/disparity.pfm")));
  test::Random random(3);
  for (float& value : map.values) value += float(random.Int(-150, 150)) * 0.01F;
  REQUIRE(WritePfm(folder.file("noisy/disparity.pfm"), map) == "");
  Succeed(folder, "refocus lf -o exact.png --focus 0 --views 1");
  Succeed(folder, "refocus noisy -o noisy.png --focus 0 --views 1");
  Succeed(folder, "refocus noisy -o repaired.png --focus 0 --views 1 --repair");
  CHECK(Psnr(folder, "exact.png repaired.png") > Psnr(folder, "exact.png noisy.png") + 3);
  const Outcome made = Call(folder, "disparity noisy --repair --views 1 -o map.pfm");
  CHECK(made.code == 0);
  CHECK(Contains(made.out, "repaired by 1 view,"));
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
  Succeed(folder, "refocus truth -o truth.png --focus -4");
  Succeed(folder, "refocus closed -o closed.png --focus -4");
  Succeed(folder, "refocus closed -o repaired.png --focus -4 --repair");
  CHECK(Psnr(folder, "truth.png repaired.png") > Psnr(folder, "truth.png closed.png") + 3);
  Succeed(folder, "import closed imported --repair");
  REQUIRE(fs::exists(folder.file("imported/coverage.png")));
  Succeed(folder, "refocus imported -o imported.png --focus -4");
  CHECK(Text(folder.file("imported.png")) == Text(folder.file("repaired.png")));
  // Coverage that was given stays.
  Succeed(folder, "refocus truth -o given.png --focus -4 --repair");
  CHECK(Psnr(folder, "truth.png given.png") > Psnr(folder, "truth.png repaired.png"));
}

TEST_CASE("disparity --repair --coverage: writes what is found, and nothing if nothing is") {
  TempFolder folder;
  PrepareHair(folder);
  const Outcome made =
      Call(folder, "disparity closed --repair -o map.pfm --coverage cover.png --confidence c.png");
  CHECK(made.err == "");
  REQUIRE(made.code == 0);
  Succeed(folder, "refocus closed -o repaired.png --focus -4 --repair");
  fs::copy_file(folder.file("cover.png"), folder.file("closed/coverage.png"));
  fs::copy_file(folder.file("map.pfm"), folder.file("closed/disparity.pfm"),
                fs::copy_options::overwrite_existing);
  Succeed(folder, "refocus closed -o after.png --focus -4");
  CHECK(Text(folder.file("after.png")) == Text(folder.file("repaired.png")));
  PrepareScene(folder);
  const Outcome none = Call(folder, "disparity lf --repair -o wires.pfm --coverage none.png");
  CHECK(none.code == 0);
  CHECK(Contains(none.err, "no coverage"));
  CHECK_FALSE(fs::exists(folder.file("none.png")));
}

TEST_CASE("refocus, info: a map that is missing is estimated, and they say so") {
  TempFolder folder;
  PrepareScene(folder);
  const Outcome direct = Call(folder, "refocus bare -o direct.png --focus 3");
  CAPTURE(direct.err);
  REQUIRE(direct.code == 0);
  CHECK(Contains(direct.err, "estimated from 5 views"));
  CHECK(!fs::exists(folder.file("bare/disparity.pfm")));
  const Outcome info = Call(folder, "info bare");
  CHECK(info.code == 0);
  CHECK(Contains(info.err, "estimated"));
  Succeed(folder, "disparity bare");
  const Outcome after = Call(folder, "refocus bare -o after.png --focus 3");
  REQUIRE(after.code == 0);
  CHECK(after.err == "");
  CHECK(Text(folder.file("direct.png")) == Text(folder.file("after.png")));
  fs::copy(folder.file("lf"), folder.file("alone"));
  fs::remove(folder.file("alone/disparity.pfm"));
  const Outcome alone = Call(folder, "refocus alone -o x.png --focus 3 --views 1");
  CHECK(alone.code == 1);
  CHECK(Contains(alone.err, "one view alone"));
}

}  // namespace
}  // namespace starfocus::estimate_slow_test
