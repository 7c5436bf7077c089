// SPDX-License-Identifier: Apache-2.0
// Tests the options for photographers by the resulting pictures.
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "platform/image_io.h"
#include "platform/light_field.h"
#include "tests/programs/inputs.h"
#include "tests/programs/session.h"
#include "tests/support/error_line.h"
#include "tests/support/psnr.h"
#include "tests/support/temp_folder.h"

namespace starfocus::lens_options_slow_test {
namespace {

namespace fs = std::filesystem;

TEST_CASE("cli: every session of lens_sessions.txt succeeds") {
  RunSessions("programs/lens_sessions.txt",
              {{"deep folder", MakeDeepFolder}, {"hair", PrepareHair}});
}

TEST_CASE("cli: f-stops and strengths select apertures, and strength 0 is the centre view") {
  TempFolder folder;
  Succeed(folder, "scene lf --size 40x30 --views 5 --name wires");
  const auto picture = [&](const std::string& options) {
    CAPTURE(options);
    Succeed(folder, "refocus lf --focus 1 -o one.png " + options);
    return Text(folder.file("one.png"));
  };
  const std::string half = picture("--aperture 0.5");
  for (const char* same :
       {"--f-stop 2", "--f-stop 2.8 --widest 1.4", "--strength 50", "--f-stop 1 --widest 0.5"}) {
    CHECK(picture(same) == half);
  }
  CHECK(picture("--f-stop 1") == picture(""));
  CHECK(picture("--strength 99") != picture("--strength 100"));
  const Image centre = ValueOf(ReadImage(folder.file("lf/view_+0.0_+0.0.png")));
  for (const char* more : {"", "--mode frame", "--mode benchmark", "--mode blur",
                           "--renderer line-scan", "--stream", "--f-stop 2 --threads 2"}) {
    picture("--strength 0 " + std::string(more));
    CHECK(ValueOf(ReadImage(folder.file("one.png"))).pixels == centre.pixels);
  }
  // With strength 0, every focus is accepted, since no blur exceeds the limit.
  Succeed(folder, "refocus lf -o s.png --sweep -900:900:2 --strength 0");
  CHECK(ValueOf(ReadImage(folder.file("s_001.png"))).pixels == centre.pixels);
}

TEST_CASE("cli: --focus-at selects the surface around the pixel, not the pixel") {
  TempFolder folder;
  Succeed(folder, "scene lf --size 40x30 --views 5 --name wires");
  FloatMap map = ValueOf(ReadPfm(folder.file("lf/disparity.pfm")));
  map.values.assign(map.values.size(), 1.25f);
  map.values[size_t(15 * map.width + 20)] = 4;
  REQUIRE(WritePfm(folder.file("lf/disparity.pfm"), map) == "");
  Succeed(folder, "refocus lf -o at.png --focus-at 20,15 --report at.json");
  CHECK(Contains(Text(folder.file("at.json")), "\"focus\": 1.25"));
  Succeed(folder, "refocus lf -o d.png --focus 1.25");
  CHECK(Text(folder.file("at.png")) == Text(folder.file("d.png")));
}

TEST_CASE("cli: with each --transfer, lamps match the truth that is averaged in the same way") {
  TempFolder folder;
  for (const char* traced : {"srgb", "none"}) {
    Succeed(folder, "scene lf --size 120x90 --views 5 --name lamps --truth 4,1 --transfer " +
                        std::string(traced));
    CHECK(Contains(Text(folder.file("lf/meta.txt")), std::string("transfer: ") + traced));
    Image truth = ValueOf(ReadImage(folder.file("lf/truth_dt4_ut1.png")));
    const auto psnr = [&](const std::string& transfer) {
      Succeed(folder, "refocus lf --focus 4 -o a.png --report a.json --transfer " + transfer);
      CHECK(Contains(Text(folder.file("a.json")), "\"transfer\": \"" + transfer + "\""));
      return test::Psnr(ValueOf(ReadImage(folder.file("a.png"))).pixels, truth.pixels);
    };
    const double srgb = psnr("srgb"), none = psnr("none");
    CAPTURE(srgb);
    CAPTURE(none);
    CHECK((std::string(traced) == "srgb" ? srgb - none : none - srgb) > 3);
    Succeed(folder, "refocus lf --focus 4 -o b.png");
    const std::string other = Text(folder.file("b.png"));
    Succeed(folder, "refocus lf --focus 4 -o a.png --transfer srgb");
    CHECK(Text(folder.file("a.png")) == other);
  }
}

TEST_CASE("cli: with highlights above 1, blurred lamps are closer to the ray-traced picture") {
  TempFolder folder;
  Succeed(folder, "scene lf --size 160x120 --views 5 --name lamps --truth 4,1");
  Image truth = ValueOf(ReadImage(folder.file("lf/truth_dt4_ut1.png")));
  const auto psnr = [&](const std::string& highlights) {
    Succeed(folder, "refocus lf --focus 4 -o a.png --report a.json --highlights " + highlights);
    CHECK(Contains(Text(folder.file("a.json")), "\"highlights\": " + highlights));
    return test::Psnr(ValueOf(ReadImage(folder.file("a.png"))).pixels, truth.pixels);
  };
  const double clipped = psnr("1.0"), bright = psnr("3.0");
  CAPTURE(clipped);
  CAPTURE(bright);
  CHECK(bright - clipped > 0.5);
}

TEST_CASE("cli: sweeps, videos, pages and batches reduce the aperture to the limit of the blur") {
  TempFolder folder;
  MakeDeepFolder(folder);
  fs::copy(folder.file("lf"), folder.file("second"));
  const struct {
    const char* arguments;
    const char* named;
  } calls[] = {{"refocus lf --sweep -100:0:2 -o s.png", "f/3.13"},
               {"video lf second --focus 0 -o out", "f/2.35"},
               {"refocus lf second --focus 0 -o batch/", "f/2.35"},
               {"view lf -o page.html", "f/2.35"}};
  for (const auto& call : calls) {
    CAPTURE(call.arguments);
    const Outcome outcome = Call(folder, call.arguments);
    CHECK(outcome.code == 0);
    CHECK(Contains(outcome.err, std::string("aperture set to ") + call.named));
    const Outcome refused = Call(folder, call.arguments + std::string(" --f-stop 2.34"));
    CHECK(refused.code != 0);
    CHECK(Contains(refused.err, std::string(call.named) + " or narrower"));
    const std::string same = call.arguments + std::string(" --f-stop ") + (call.named + 2);
    const Outcome named = Call(folder, same);
    CHECK(named.code == 0);
    CHECK(!Contains(named.err, "aperture"));
  }
  // The note about the first input also applies to the second.
  const std::string batch = Call(folder, "refocus lf second --focus 0 -o batch/").err;
  CHECK(Count(batch, "aperture set to f/") == 1);
  CHECK(Contains(batch, "starfocus: notes like those about lf apply to second\n"));
  // The error for the aperture of a video must name an aperture that suits all frames.
  FloatMap map = ValueOf(ReadPfm(folder.file("second/disparity.pfm")));
  for (float& value : map.values) value *= 4.0f / 3;
  REQUIRE(WritePfm(folder.file("second/disparity.pfm"), map) == "");
  const Outcome frames = Call(folder, "video lf second --focus 0 --f-stop 1 -o none");
  CHECK(frames.code == 2);
  CHECK(Contains(frames.err, "f/3.13 or narrower"));
}

TEST_CASE("cli: by default, the nearest large surface near the centre is in focus") {
  TempFolder folder;
  Succeed(folder, "scene lf --size 160x120 --views 1");
  FloatMap map = ValueOf(ReadPfm(folder.file("lf/disparity.pfm")));
  // The scene has a wall at disparity 1, a subject at 6 to the right of the centre, a wire at 9,
  // and an object at 20 in a corner.
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      float& value = map.values[size_t(y) * size_t(map.width) + size_t(x)];
      value = 1;
      if (x >= 84 && x < 116 && y >= 40 && y < 84) value = 6;
      if (x >= 60 && x < 62) value = 9;
      if (x < 36 && y >= 92) value = 20;
    }
  }
  REQUIRE(WritePfm(folder.file("lf/disparity.pfm"), map) == "");
  const Outcome outcome = Call(folder, "refocus lf -o a.png --report a.json");
  CHECK(outcome.code == 0);
  CHECK(Contains(outcome.err, "lf: focused at the nearest large surface near the centre"));
  CHECK(Contains(outcome.err, "a.png: focus "));
  CHECK(Contains(outcome.err, " (disparity 6), f/1\n"));
  CHECK(Contains(Text(folder.file("a.json")), "\"focus\": 6.0"));
  const Outcome video = Call(folder, "video lf -o out --report v.json");
  CHECK(video.code == 0);
  CHECK(Contains(Text(folder.file("v.json")), "\"focus\": 6.0"));
  // The program chooses the default focus separately for each input of a batch.
  fs::copy(folder.file("lf"), folder.file("other"));
  for (float& value : map.values) value = -2;
  REQUIRE(WritePfm(folder.file("other/disparity.pfm"), map) == "");
  const Outcome batch = Call(folder, "refocus lf other -o both/");
  CHECK(batch.code == 0);
  CHECK(Contains(batch.err, "both/other.png: focus "));
  CHECK(Contains(batch.err, " (disparity -2), f/1\n"));
  Succeed(folder, "refocus other --focus -2 -o b.png");
  CHECK(Text(folder.file("both/other.png")) == Text(folder.file("b.png")));
  CHECK(Text(folder.file("both/lf.png")) == Text(folder.file("a.png")));
}

}  // namespace
}  // namespace starfocus::lens_options_slow_test
