// SPDX-License-Identifier: Apache-2.0
// Tests light fields without a disparity map: `starfocus disparity`, and other commands that
// estimate maps.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include "platform/image_io.h"
#include "platform/light_field.h"
#include "tests/programs/inputs.h"
#include "tests/support/error_line.h"
#include "tests/support/temp_folder.h"
#include "tests/support/test_scene.h"

namespace starfocus::estimate_slow_test {
namespace {

namespace fs = std::filesystem;

// Writes the light field `lf` with its map, and a copy `bare` without the map.
void PrepareScene(const TempFolder& folder, const std::string& name = "wires --size 160x120") {
  Succeed(folder, "scene lf --views 5 --name " + name);
  fs::copy(folder.file("lf"), folder.file("bare"));
  fs::remove(folder.file("bare/disparity.pfm"));
}

TEST_CASE(
    "disparity: the estimate of a ray-traced scene has the scene's range and is mostly correct") {
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

// Writes `worse`, a copy of the light field `lf` with a map whose near objects are 3 pixels wider
// on each side.
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

TEST_CASE(
    "disparity --repair, refocus --repair: the picture comes closer to that of the exact map") {
  TempFolder folder;
  PrepareScene(folder, "portrait --size 256x192");
  MakeWorse(folder);
  Succeed(folder, "refocus lf -o exact.png --focus 0");
  Succeed(folder, "refocus worse -o worse.png --focus 0 --fill-invalid");
  // The program rejects the map, since the map contains NaN.
  CHECK(Call(folder, "refocus worse -o x.png --focus 0").code == 1);
  const Outcome direct = Call(folder, "refocus worse -o direct.png --focus 0 --repair");
  CAPTURE(direct.err);
  REQUIRE(direct.code == 0);
  CHECK(Psnr(folder, "exact.png direct.png") > Psnr(folder, "exact.png worse.png") + 4);
  const Outcome made = Call(folder, "disparity worse --repair -o map.pfm --confidence sure.png");
  CAPTURE(made.err);
  REQUIRE(made.code == 0);
  CHECK(Contains(made.out, "repaired with 5 views"));
  fs::copy_file(folder.file("map.pfm"), folder.file("worse/disparity.pfm"),
                fs::copy_options::overwrite_existing);
  Succeed(folder, "refocus worse -o after.png --focus 0");
  CHECK(Text(folder.file("direct.png")) == Text(folder.file("after.png")));
}

TEST_CASE("disparity --repair, refocus --repair: the map of one view is repaired by colours") {
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
  CHECK(Contains(made.out, "repaired with 1 view,"));
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
  // A repair must keep given coverage.
  Succeed(folder, "refocus truth -o given.png --focus -4 --repair");
  CHECK(Psnr(folder, "truth.png given.png") > Psnr(folder, "truth.png closed.png") + 3);
}

}  // namespace
}  // namespace starfocus::estimate_slow_test
