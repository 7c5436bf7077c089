// SPDX-License-Identifier: Apache-2.0
// Options in a photographer's words, by the pictures that they give.
#include <doctest/doctest.h>

#include <string>

#include "platform/image_io.h"
#include "platform/light_field.h"
#include "tests/cli/call_program.h"
#include "tests/support/temp_folder.h"

namespace starfocus {
namespace {

TEST_CASE("cli: f-stops and strengths are apertures; strength 0 is the centre view") {
  TempFolder folder;
  REQUIRE(Call(folder, "scene lf --size 40x30 --views 5 --name wires").code == 0);
  const auto picture = [&](const std::string& options) {
    CAPTURE(options);
    REQUIRE(Call(folder, "refocus lf --focus 1 -o one.png " + options).code == 0);
    return Text(folder.file("one.png"));
  };
  const std::string half = picture("--aperture 0.5");
  for (const char* same :
       {"--f-stop 2", "--f-stop 2.8 --widest 1.4", "--strength 50", "--f-stop 1 --widest 0.5"}) {
    CHECK(picture(same) == half);
  }
  CHECK(picture("--f-stop 1") == picture(""));
  CHECK(picture("--strength 99") != picture("--strength 100"));
  Image centre, out;
  REQUIRE(ReadImage(folder.file("lf/view_+0.0_+0.0.png"), &centre) == "");
  for (const char* more : {"", "--mode frame", "--mode benchmark", "--mode blur", "--rule paper",
                           "--stream", "--f-stop 2 --threads 2"}) {
    picture("--strength 0 " + std::string(more));
    REQUIRE(ReadImage(folder.file("one.png"), &out) == "");
    CHECK(out.pixels == centre.pixels);
  }
  // No blur is too large for it.
  REQUIRE(Call(folder, "refocus lf -o s.png --sweep -900:900:2 --strength 0").code == 0);
  REQUIRE(ReadImage(folder.file("s_001.png"), &out) == "");
  CHECK(out.pixels == centre.pixels);
}

TEST_CASE("cli: --focus-at takes the surface around the pixel, not the pixel") {
  TempFolder folder;
  REQUIRE(Call(folder, "scene lf --size 40x30 --views 5 --name wires").code == 0);
  FloatMap map;
  REQUIRE(ReadPfm(folder.file("lf/disparity.pfm"), &map) == "");
  map.values.assign(map.values.size(), 1.25f);
  map.values[size_t(15 * map.width + 20)] = 4;
  REQUIRE(WritePfm(folder.file("lf/disparity.pfm"), map) == "");
  REQUIRE(Call(folder, "refocus lf -o at.png --focus-at 20,15 --report at.json").code == 0);
  CHECK(Text(folder.file("at.json")).find("\"focus\": 1.25") != std::string::npos);
  REQUIRE(Call(folder, "refocus lf -o d.png --focus 1.25").code == 0);
  CHECK(Text(folder.file("at.png")) == Text(folder.file("d.png")));
}

}  // namespace
}  // namespace starfocus
