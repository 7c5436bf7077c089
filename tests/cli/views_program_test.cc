// SPDX-License-Identifier: Apache-2.0
// The program with views at any positions, and what they are worth against the ray tracer's truth.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "platform/image_io.h"
#include "platform/light_field.h"
#include "tests/cli/call_program.h"
#include "tests/support/error_line.h"

namespace starfocus::views_program_test {
namespace {

namespace fs = std::filesystem;

double Psnr(const TempFolder& folder, const std::string& names) {
  const Outcome outcome = Call(folder, "compare " + names);
  REQUIRE(outcome.out.rfind("PSNR ", 0) == 0);
  return std::atof(outcome.out.c_str() + 5);
}

TEST_CASE("views: the more sides are captured, the nearer to the truth") {
  TempFolder folder;
  Succeed(folder, "scene lf --size 256x192 --views 5 --transfer none --truth=-2.4,1");
  const auto error = [&](const std::string& views) {
    Succeed(folder, "refocus lf -o x.png --transfer none --focus=-2.4 --views " + views);
    return Psnr(folder, "lf/truth_dt-2.4_ut1.png x.png");
  };
  const double one = error("1"), five = error("5");
  const double pair = error("0,0:1,0"), other = error("0,0:-1,0");
  const double corner = error("0,0:1,0:0,1"), row = error("0,0:-1,0:1,0");
  CHECK(five > one + 2);
  // One of four sides.
  CHECK(pair > one + 0.15 * (five - one));
  CHECK(other > one + 0.15 * (five - one));
  CHECK(corner > pair);
  CHECK(row > pair);
  CHECK(row > other);
  CHECK(five > row);
}

TEST_CASE("views: a stereo pair as Middlebury's is opened, unknown disparities filled") {
  TempFolder folder;
  Succeed(folder, "scene lf --size 64x48 --views 0,0:1,0");
  LightField field = ValueOf(LoadLightField(folder.file("lf"), {}));
  fs::create_directory(folder.file("pair"));
  REQUIRE(WriteImage(folder.file("pair/im0.png"), field.views[0]) == "");
  REQUIRE(WriteImage(folder.file("pair/im1.png"), field.views[1]) == "");
  REQUIRE(WritePfm(folder.file("pair/disp0.pfm"), field.disparity) == "");
  Succeed(folder, "refocus lf -o a.png --focus 0");
  Succeed(folder, "refocus pair -o b.png --focus 0");
  CHECK(Call(folder, "compare a.png b.png").out == "PSNR inf, largest difference 0\n");
  field.disparity.values[70] = HUGE_VALF;
  REQUIRE(WritePfm(folder.file("pair/disp0.pfm"), field.disparity) == "");
  CHECK(Contains(Call(folder, "info pair").out, "1 invalid"));
  REQUIRE(WritePfm(folder.file("lf/disparity.pfm"), field.disparity) == "");
  // A pair's map has infinite values by its format, a light field's by mistake.
  CHECK(Contains(Call(folder, "refocus lf -o c.png --focus 0").err, "--fill-invalid"));
  Succeed(folder, "refocus lf -o c.png --focus 0 --fill-invalid");
  Succeed(folder, "refocus pair -o b.png --focus 0");
  CHECK(Call(folder, "compare b.png c.png").out == "PSNR inf, largest difference 0\n");
  CHECK(Call(folder, "refocus pair -o pair/im1.png --focus 0 --fill-invalid").code == 2);
}

}  // namespace
}  // namespace starfocus::views_program_test
