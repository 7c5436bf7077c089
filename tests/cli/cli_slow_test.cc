// SPDX-License-Identifier: Apache-2.0
// The subcommands by their results and what they refuse.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "platform/file.h"
#include "platform/image_io.h"
#include "platform/light_field.h"
#include "tests/cli/call_program.h"
#include "tests/cli/refusals.h"
#include "tests/support/error_line.h"
#include "tests/support/temp_folder.h"

namespace starfocus::cli_slow_test {
namespace {

namespace fs = std::filesystem;

TEST_CASE("cli: bad input is refused") {
  TempFolder folder;
  Prepare(folder);
  CheckRefusals(folder, "refusals.txt");
}

TEST_CASE("cli: scene writes what its name says, again the same bytes") {
  TempFolder folder;
  const std::string size = "48x36";
  const std::string arguments = " --size " + size + " --views 9 --truth 1.5,0.5 -2,1 --truth 0,1";
  Succeed(folder, "scene a" + arguments + " --threads 1");
  Succeed(folder, "scene b" + arguments + " --threads 3");
  int files = 0;
  for (const auto& entry : fs::directory_iterator(folder.file("a"))) {
    const std::string name = entry.path().filename().string();
    CAPTURE(name);
    CHECK(Text(folder.file("a/" + name)) == Text(folder.file("b/" + name)));
    ++files;
  }
  CHECK(files == 9 + 1 + 3 + 1);
  CHECK(fs::exists(folder.file("a/truth_dt1.5_ut0.5.png")));
  CHECK(fs::exists(folder.file("a/truth_dt-2_ut1.png")));
  CHECK(fs::exists(folder.file("a/truth_dt0_ut1.png")));
  CHECK(Contains(Text(folder.file("a/meta.txt")), "\nmiddle: "));
  // The same set may be written over.
  CHECK(Call(folder, "scene a --size 20x10 --views 9").code == 0);
  LightField light_field = ValueOf(LoadLightField(folder.file("a"), {}));
  CHECK(light_field.width() == 20);
}

TEST_CASE("cli: calibrate writes what refocus --timing takes") {
  TempFolder folder;
  const std::string size = "96x64";
  Succeed(folder, "scene lf --name portrait --size " + size);
  const Outcome outcome = Call(folder, "calibrate --light-field lf --check lf -o timing.json");
  CAPTURE(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(Contains(outcome.out, "per block"));
  // The agreement is told and not judged.
  CHECK(Contains(outcome.out, "R2 "));
  CHECK(!Contains(outcome.out, "below"));
  CHECK(Contains(Text(folder.file("timing.json")), "\"block\""));
  CHECK(Call(folder, "refocus lf --focus 2 --timing timing.json -o a.png").code == 0);
  CHECK(fs::exists(folder.file("a.png")));
}

TEST_CASE("cli: refocus, stream, report, compare, info and sheet work together") {
  TempFolder folder;
  Prepare(folder);
  const std::string refocus = "refocus lf --focus 0.5 --report report.json -o ";
  for (const char* more : {"whole.png", "whole.ppm", "stream.png --stream", "many.png --threads 3",
                           "one.jpg --views 1", "bench.png --mode benchmark --aperture 0.5"}) {
    CAPTURE(more);
    const Outcome outcome = Call(folder, refocus + more);
    CHECK(outcome.code == 0);
    CHECK(outcome.err == "");
  }
  const std::string report = Text(folder.file("report.json"));
  for (const char* field :
       {"mode", "width", "height", "views", "focus", "aperture", "r_max", "N", "n_scale",
        "rendered_views", "rendered_samples", "seconds_refocus", "copied_pixels", "gathered_pixels",
        "seconds_total", "workspace_bytes", "simd_target", "threads"}) {
    CHECK(Contains(report, "\"" + std::string(field) + "\": "));
  }
  CHECK(Call(folder, "compare whole.png stream.png").out == "PSNR inf, largest difference 0\n");
  CHECK(Call(folder, "compare whole.png whole.ppm --json").out ==
        "{\"psnr\":null,\"largest_difference\":0}\n");
  CHECK(Call(folder, "compare whole.png many.png").out == "PSNR inf, largest difference 0\n");
  CHECK(Call(folder, "refocus nan -o filled.png --focus-at 5,1 --fill-invalid").code == 0);
  CHECK(Contains(Call(folder, "info nan").out, "5 views"));
  CHECK(Contains(Call(folder, "info nan --json").out, "\"invalid\":1,"));
  CHECK(Call(folder, "sheet -o sheet.png whole.png small.png --labels near,far --width 60").code ==
        0);
  Image sheet = ValueOf(ReadImage(folder.file("sheet.png")));
  CHECK(sheet.width <= 60);
  CHECK(Call(folder, "--help").code == 0);
  CHECK(Call(folder, "refocus --help").code == 0);
  CHECK(Call(folder, "analyze --help").code == 0);
}

TEST_CASE("wide pictures are refocused in larger blocks") {
  const TempFolder folder;
  for (const auto& [size, side] : {std::pair{"1535x16", "64"}, {"1536x16", "128"}}) {
    CAPTURE(size);
    Succeed(folder, std::string("scene wide --views 1 --size ") + size);
    Succeed(folder, "refocus wide -o wide.ppm --focus 3 --report wide.json");
    const std::string expected = std::string("\"superblock\": ") + side + ",";
    CHECK(Contains(Text(folder.file("wide.json")), expected));
  }
}

TEST_CASE("cli: a region is that part of the picture") {
  TempFolder folder;
  Prepare(folder);
  Succeed(folder, "refocus lf -o whole.png --focus 0.5 --map map.png");
  Succeed(folder,
          "refocus lf -o part.png --focus 0.5 --region 7,5,20,11 --map part_map.png "
          "--report part.json");
  for (const std::string name : {"whole part", "map part_map"}) {
    const Image whole = ValueOf(ReadImage(folder.file(name.substr(0, name.find(' ')) + ".png")));
    const Image part = ValueOf(ReadImage(folder.file(name.substr(name.find(' ') + 1) + ".png")));
    REQUIRE(part.width == 20);
    REQUIRE(part.height == 11);
    for (int y = 0; y < part.height; ++y) {
      CHECK(std::equal(part.row(y), part.row(y) + part.stride(), whole.row(y + 5) + 3 * 7));
    }
  }
  CHECK(Contains(Text(folder.file("part.json")), "\"region\": ["));
}

TEST_CASE("cli: a video is its frames one by one, but for the work") {
  TempFolder folder;
  Succeed(folder, "scene lf --size 200x100 --views 5 --name wires");
  REQUIRE(fs::create_directory(folder.file("in")));
  for (const char* name : {"in/1", "in/2", "in/3", "in/4"}) {
    fs::copy(folder.file("lf"), folder.file(name));
  }
  // The third and fourth frame differ from the others in a corner.
  Image view;
  const std::string centre = folder.file("in/3/view_+0.0_+0.0.png");
  view = ValueOf(ReadImage(centre));
  std::fill_n(view.row(2), 20, uint8_t{255});
  REQUIRE(WriteImage(centre, view) == "");
  fs::copy(centre, folder.file("in/4/view_+0.0_+0.0.png"), fs::copy_options::overwrite_existing);
  const std::string lens = " --focus 3 --aperture 0.2 --superblock 32";
  Succeed(folder, "video in -o out --report v.json" + lens);
  Succeed(folder, "video in/1 in/3 -o two" + lens);
  // Neither a hidden folder nor its own output is a frame.
  REQUIRE(fs::create_directory(folder.file("in/.cache")));
  REQUIRE(fs::create_directory(folder.file("in/out")));
  Succeed(folder, "video in -o in/out" + lens);
  CHECK(Text(folder.file("in/out/frame_0003.png")) == Text(folder.file("out/frame_0003.png")));
  for (const int frame : {0, 1, 2, 3}) {
    const std::string name = std::to_string(frame + 1);
    Succeed(folder, "refocus in/" + name + " -o one.png" + lens);
    CHECK(Text(folder.file("out/frame_000" + std::to_string(frame) + ".png")) ==
          Text(folder.file("one.png")));
  }
  CHECK(Text(folder.file("two/frame_0001.png")) == Text(folder.file("out/frame_0002.png")));
  CHECK(Text(folder.file("two/frame_0000.png")) != Text(folder.file("two/frame_0001.png")));
  // Blocks of the frames: none of the first, all, most, all.
  const std::string report = Text(folder.file("v.json"));
  std::vector<int> reused;
  for (size_t at = report.find("\"reused_blocks\": "); at != std::string::npos;
       at = report.find("\"reused_blocks\": ", at + 1)) {
    reused.push_back(std::atoi(report.c_str() + at + 17));
  }
  REQUIRE(reused.size() == 5);
  CHECK(reused[0] == 0);
  CHECK(reused[1] == 28);
  CHECK(reused[2] >= 4);
  CHECK(reused[2] < 28);
  CHECK(reused[3] == 28);
  CHECK(reused[4] == reused[1] + reused[2] + reused[3]);
}

TEST_CASE("cli: a sweep is its pictures one by one") {
  TempFolder folder;
  Prepare(folder);
  for (const std::string more : {"", " --mode frame --aperture 0.5", " --region 3,4,20,21"}) {
    CAPTURE(more);
    Succeed(folder, "refocus lf -o s.png --sweep -1:2:4 --threads 2 --report s.json" + more);
    for (int i = 0; i < 4; ++i) {
      const std::string focus = std::to_string(i - 1), name = "s_00" + std::to_string(i) + ".png";
      Succeed(folder, "refocus lf -o one.png --focus " + focus + more);
      CHECK(Text(folder.file(name)) == Text(folder.file("one.png")));
    }
    CHECK(!fs::exists(folder.file("s.png")));
    CHECK(!fs::exists(folder.file("s_004.png")));
    const std::string report = Text(folder.file("s.json"));
    CHECK(Contains(report, "\"s_003.png\""));
    CHECK(!Contains(report, "\"prepared_bytes\": 0"));
  }
}

}  // namespace
}  // namespace starfocus::cli_slow_test
