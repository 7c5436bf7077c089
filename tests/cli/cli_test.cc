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

namespace starfocus::cli_test {
namespace {

namespace fs = std::filesystem;

TEST_CASE("cli: refocus refuses bad input") {
  TempFolder folder;
  Prepare(folder);
  const struct {
    const char* arguments;
    const char* mention;
  } bad[] = {{"", "subcommand"},
             {"frobnicate", "frobnicate"},
             {"refocus", "SRC"},
             {"refocus lf --focus 1", "--output"},
             {"refocus lf -o x.png --focus", "--focus"},
             {"refocus lf -o x.png --focus 1 --focus-at 1,1", "--focus"},
             {"refocus lf -o x.png --focus abc", "--focus"},
             {"refocus lf -o x.png --focus nan", "--focus"},
             {"refocus lf -o x.png --focus inf", "--focus"},
             {"refocus lf -o x.png --focus 1e999", "--focus"},
             {"refocus lf -o x.png --focus 1x", "--focus"},
             {"refocus lf -o x.png --focus=", "--focus"},
             {"refocus lf -o x.png --focus 1000 --aperture 1", "128"},
             {"refocus lf -o x.png --focus 1e300", "1e+06"},
             {"refocus lf -o x.png --focus-at 40,0", "39,29"},
             {"refocus lf -o x.png --focus-at 0,30", "39,29"},
             {"refocus lf -o x.png --focus-at -1,0", "--focus-at"},
             {"refocus lf -o x.png --focus-at 1", "--focus-at"},
             {"refocus lf -o x.png --focus-at 1.5,2", "--focus-at"},
             {"refocus lf -o x.png --focus-at 1,2,3", "--focus-at"},
             {"refocus lf -o x.png --focus 1 --aperture 0", "--aperture"},
             {"refocus lf -o x.png --focus 1 --aperture -1", "--aperture"},
             {"refocus lf -o x.png --focus 1 --aperture 1.01", "--aperture"},
             {"refocus lf -o x.png --focus 1 --aperture nan", "--aperture"},
             {"refocus lf -o x.png --focus 1 --aperture 0.5 --f-stop 2", "both"},
             {"refocus lf -o x.png --focus 1 --f-stop 0.99", "--f-stop: expected an f-stop"},
             {"refocus lf -o x.png --focus 1 --f-stop 0", "--f-stop"},
             {"refocus lf -o x.png --focus 1 --f-stop f/2", "--f-stop"},
             {"refocus lf -o x.png --focus 1 --f-stop inf", "--f-stop"},
             {"refocus lf -o x.png --focus 1 --f-stop 1.8 --widest 2", "the widest on, 2"},
             {"refocus lf -o x.png --focus 1 --f-stop 2 --widest 0", "--widest"},
             {"refocus lf -o x.png --focus 1 --f-stop 2 --widest wide", "--widest"},
             {"refocus lf -o x.png --focus 1 --widest 2", "--f-stop"},
             {"refocus lf -o x.png --focus 1 --strength -1", "--strength"},
             {"refocus lf -o x.png --focus 1 --strength 100.1", "--strength"},
             {"refocus lf -o x.png --focus 1 --strength nan", "--strength"},
             {"refocus lf -o x.png --focus 1 --strength half", "--strength"},
             {"refocus lf -o x.png --focus 1 --mode fast", "--mode"},
             {"refocus lf -o x.png --focus 1 --views 3", "--views"},
             {"refocus lf -o x.png --focus 1 --views 9", "5 in lf"},
             {"refocus lf -o x.png --focus 1 --views 0,0:0.5,0", "view_+0.5_+0.0"},
             {"refocus lf -o x.png --focus 1 --views 1,0:0,0", "0,0, first"},
             {"refocus lf -o x.png --focus 1 --views 0,0:1,0:1,0", "differ"},
             {"refocus lf -o x.png --focus 1 --views 0,0:2,0", "within +-1"},
             {"refocus lf -o x.png --focus 1 --views 0,0:", "U,V"},
             {"refocus lf -o x.png --focus 1 --views 0,0:1,0 --rule paper", "star"},
             {"refocus lf -o x.png --focus 1 --views -1", "--views"},
             {"refocus lf -o x.png --focus 1 --threads 0", "--threads"},
             {"refocus lf -o x.png --focus 1 --threads 65", "--threads"},
             {"refocus lf -o x.png --focus 1 --threads two", "--threads"},
             {"refocus lf -o x.png --focus 1 --shape square", "--shape: expected fall-off"},
             {"refocus lf -o x.png --focus 1 --shape disc:1", "--shape"},
             {"refocus lf -o x.png --focus 1 --shape polygon", "--shape"},
             {"refocus lf -o x.png --focus 1 --shape polygon:2", "--shape"},
             {"refocus lf -o x.png --focus 1 --shape polygon:13", "--shape"},
             {"refocus lf -o x.png --focus 1 --shape polygon:5.5", "--shape"},
             {"refocus lf -o x.png --focus 1 --shape polygon:5,361", "--shape"},
             {"refocus lf -o x.png --focus 1 --shape polygon:5,0,1.1", "--shape"},
             {"refocus lf -o x.png --focus 1 --shape polygon:5,0,1,1", "--shape"},
             {"refocus lf -o x.png --focus 1 --shape polygon:5,,1", "--shape"},
             {"refocus lf -o x.png --focus 1 --shape ring:0.91", "--shape"},
             {"refocus lf -o x.png --focus 1 --shape ring:-0.1", "--shape"},
             {"refocus lf -o x.png --focus 1 --shape ring:0.5,1", "--shape"},
             {"refocus lf -o x.png --focus 1 --theta 0.04", "--theta: expected a part of pi"},
             {"refocus lf -o x.png --focus 1 --theta 0.46", "--theta"},
             {"refocus lf -o x.png --focus 1 --theta wide", "--theta"},
             {"refocus lf -o x.png --focus 1 --theta 0.3 --shape disc", "--shape fall-off"},
             {"refocus lf -o x.png --focus 1 --cats-eye -0.1", "--cats-eye"},
             {"refocus lf -o x.png --focus 1 --cats-eye 1.1", "--cats-eye"},
             {"refocus lf -o x.png --focus 1 --cats-eye nan", "--cats-eye"},
             {"refocus lf -o x.png --focus 1 --n-scale 0.49", "--n-scale"},
             {"refocus lf -o x.png --focus 1 --n-scale 2.1", "--n-scale"},
             {"refocus lf -o x.png --focus 1 --n-scale nan", "--n-scale"},
             {"refocus lf -o x.png --focus 1 --n-scale two", "--n-scale"},
             {"refocus lf -o x.png --focus 1 --region 1,2,3", "--region"},
             {"refocus lf -o x.png --focus 1 --region 1,2,3,4,5", "--region"},
             {"refocus lf -o x.png --focus 1 --region 1,2,,4", "--region"},
             {"refocus lf -o x.png --focus 1 --region 1,2,3,0", "--region"},
             {"refocus lf -o x.png --focus 1 --region -1,2,3,4", "--region"},
             {"refocus lf -o x.png --focus 1 --region 37,0,4,4", "40x30"},
             {"refocus lf -o x.png --focus 1 --region 0,30,1,1", "40x30"},
             {"refocus lf -o x.png --focus 1 --region 0,0,4,4 --stream", "--stream"},
             {"refocus lf -o x.png --focus 1 --report ./x.png", "--report"},
             {"refocus lf -o x.png --focus 1 --map ./x.png", "--map"},
             {"refocus lf -o x.png --sweep 0:1:3 --report x_001.png", "--report"},
             {"refocus lf -o lf/view_+0.0_+1.0.png --focus 1", "light field"},
             {"refocus lf -o ./lf/../lf/view_+1.0_+1.0.jpg --focus 1", "light field"},
             {"refocus lf -o x.png --focus 1 --report lf/disparity.pfm", "light field"},
             {"refocus lf -o x.png --focus 1 --map lf/view_-1.0_+0.0.png", "light field"},
             {"refocus linked -o target.png --focus 1", "which is read"},
             {"refocus linked -o x.png --focus 1 --map ./target.png", "which is read"},
             {"refocus linked -o linked/out.png --focus 1", "which is read"},
             {"refocus lf -o x.png --focus 1 --timing t.json --report lf/../t.json", "--report"},
             {"refocus lf -o x.png --sweep 1:2", "--sweep"},
             {"refocus lf -o x.png --sweep 1:2:1", "--sweep"},
             {"refocus lf -o x.png --sweep 1:2:1001", "--sweep"},
             {"refocus lf -o x.png --sweep 1:nan:3", "--sweep"},
             {"refocus lf -o x.png --sweep 1:2:3:4", "--sweep"},
             {"refocus lf -o x.png --sweep 0:900:3 --strength 100", "--strength"},
             {"refocus lf -o x.png --sweep 0:1:3 --focus 1", "--focus"},
             {"refocus lf -o x.png --sweep 0:1:3 --stream", "--stream"},
             {"refocus lf -o x.png --sweep 0:1:3 --map m.png", "--map"},
             {"refocus lf -o none/x.png --sweep 0:1:3", "none"},
             {"refocus lf -o taken.png --sweep 0:1:3", "taken_002.png"},
             {"refocus lf -o x.bmp --focus 1", ".bmp"},
             {"refocus lf -o x --focus 1", "extension"},
             {"refocus lf -o '' --focus 1", "--output"},
             {"refocus '' -o x.png --focus 1", "SRC"},
             {"refocus lf -o x.png --focus 1 --region ''", "--region"},
             {"refocus lf -o x.png --focus 1 --rule ''", "--rule"},
             {"refocus lf -o x.png --focus 1 --report ''", "--report"},
             {"refocus lf -o none/x.png --focus 1", "none"},
             {"refocus lf -o x.png --focus 1 --report none/r.json", "none"},
             {"refocus lf -o x.png --focus 1 --report lf", "folder"},
             {"refocus lf -o x.png --focus 1 --frobnicate", "frobnicate"},
             {"refocus lf extra -o x.png --focus 1", "a folder for the pictures"},
             {"refocus none -o x.png --focus 1", "none"},
             {"refocus text.png -o x.png --focus 1", "text.png"},
             {"refocus missing -o x.png --focus 1", "view_+0.0_+0.0"},
             {"refocus broken -o x.png --focus 1", "view_-1.0_+0.0.png"},
             {"refocus nan -o x.png --focus 1", "first at 5,1"},
             {"refocus huge -o x.png --focus 1", "disparity.pfm"},
             {"refocus short -o x.png --focus 1", "disparity.pfm"}};
  for (const auto& row : bad) CheckRefused(folder, row.arguments, row.mention);
}

TEST_CASE("cli: scene, compare, info, sheet and analyze refuse bad input") {
  TempFolder folder;
  Prepare(folder);
  const struct {
    const char* arguments;
    const char* mention;
  } bad[] = {{"scene", "DIR"},
             {"scene new --name sea", "--name"},
             {"scene new --size 0x10", "--size"},
             {"scene new --size 10", "--size"},
             {"scene new --size 65535x65535", "--size"},
             {"scene new --size 99999999999x1", "--size"},
             {"scene new --size -4x4", "--size"},
             {"scene new --views 4", "--views"},
             {"scene new --threads 0", "--threads"},
             {"refocus lf --focus 1 -o a.png --highlights 0.5", "--highlights"},
             {"refocus lf --focus 1 -o a.png --highlights 65", "--highlights"},
             {"scene new --transfer linear", "--transfer"},
             {"refocus lf --focus 1 -o a.png --transfer SRGB", "--transfer"},
             {"scene new --truth 1", "--truth"},
             {"scene new --truth 1,0", "--truth"},
             {"scene new --truth nan,1", "--truth"},
             {"scene new --truth 1e9,1", "--truth"},
             {"scene new --truth 1,1,1", "--truth"},
             {"scene text.png --size 4x4", "text.png"},
             {"scene lf --size 4x4 --views 1", "view_+1.0_+0.0.png"},
             {"compare small.png", "B"},
             {"compare small.png large.png", "5x4"},
             {"compare small.png none.png", "none.png"},
             {"compare text.png small.png", "text.png"},
             {"compare lf lf", "lf"},
             {"info", "SRC"},
             {"info none", "none"},
             {"info missing", "view_+0.0_+0.0"},
             {"info short", "disparity.pfm"},
             {"video lf", "--output"},
             {"video lf -o text.png --focus 1", "text.png"},
             {"video lf -o none/out --focus 1", "none"},
             {"video lf -o out --focus 1 --report none/r.json", "none"},
             {"video lf -o out --focus 1 --report lf/disparity.pfm", "light field"},
             {"video lf -o out --focus 1 --report out", "--report"},
             {"video lf -o missing --focus 1 --report missing/frame_0000.png", "--report"},
             {"video lf -o lf --focus 1", "a light field that is read"},
             {"video tiny lf -o ./lf/ --focus 1", "a light field that is read"},
             {"video lf none -o out --focus 1", "none"},
             {"video lf nan -o out --focus 1", "first at 5,1"},
             {"video lf tiny -o out --focus 1", "40x30"},
             {"video lf single -o out --focus 1", "5 views"},
             {"video lf --focus 900 --f-stop 1 -o out", "128"},
             {"video taken_002.png -o out --focus 1", "light-field folders"},
             {"sheet -o x.png", "IMG"},
             {"sheet -o x.tif small.png", ".tif"},
             {"sheet small.png", "--output"},
             {"sheet large.png small.png -o ./lf/../small.png", "which is read"},
             {"sheet -o x.png none.png", "none.png"},
             {"help lens", "lens"},
             {"help --man --bash", "--bash"},
             {"help refocus lens", "lens"},
             {"calibrate --light-field lf -o lf/disparity.pfm", "light field"},
             {"calibrate --check lf -o lf/view_+0.0_+0.0.png", "light field"},
             {"sheet -o x.png small.png --labels a,b", "--labels"},
             {"sheet -o x.png small.png --width 3", "--width"},
             {"analyze --max-blur 0", "--max-blur"},
             {"analyze --max-blur 129", "--max-blur"},
             {"analyze --max-blur 2.5", "--max-blur"},
             {"analyze -o text.png", "text.png"},
             {"analyze extra", "extra"}};
  for (const auto& row : bad) CheckRefused(folder, row.arguments, row.mention);
}

TEST_CASE("cli: scene writes what its name says, again the same bytes") {
  TempFolder folder;
  const std::string size = STARFOCUS_EMULATED ? "20x15" : "48x36";
  const std::string arguments = " --size " + size + " --views 9 --truth 1.5,0.5 -2,1 --truth 0,1";
  REQUIRE(Call(folder, "scene a" + arguments + " --threads 1").code == 0);
  REQUIRE(Call(folder, "scene b" + arguments + " --threads 3").code == 0);
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
  CHECK(Text(folder.file("a/meta.txt")).find("\nmiddle: ") != std::string::npos);
  // The same set may be written over.
  CHECK(Call(folder, "scene a --size 20x10 --views 9").code == 0);
  LightField light_field;
  CHECK(LoadLightField(folder.file("a"), {}, &light_field) == "");
  CHECK(light_field.width() == 20);
}

TEST_CASE("cli: calibrate writes what refocus --timing takes") {
  TempFolder folder;
  const std::string size = STARFOCUS_EMULATED ? "64x48" : "96x64";
  REQUIRE(Call(folder, "scene lf --name portrait --size " + size).code == 0);
  const Outcome outcome = Call(folder, "calibrate --light-field lf --check lf -o timing.json");
  CAPTURE(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(outcome.out.find("per block") != std::string::npos);
  // The agreement is told and not judged.
  CHECK(outcome.out.find("R2 ") != std::string::npos);
  CHECK(outcome.out.find("below") == std::string::npos);
  CHECK(Text(folder.file("timing.json")).find("\"block\"") != std::string::npos);
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
  for (const char* field : {"mode",
                            "width",
                            "height",
                            "views",
                            "focus",
                            "aperture",
                            "r_max",
                            "N",
                            "n_scale",
                            "rendered_views",
                            "rendered_samples",
                            "seconds_refocus",
                            "copied_blocks",
                            "filled_blocks",
                            "layer_columns",
                            "gathered_pixels",
                            "side_bytes_read",
                            "bytes_per_pixel",
                            "least_bytes_per_pixel",
                            "seconds_total",
                            "workspace_bytes",
                            "simd_target",
                            "threads"}) {
    CHECK(report.find("\"" + std::string(field) + "\": ") != std::string::npos);
  }
  CHECK(Call(folder, "compare whole.png stream.png").out == "PSNR inf, largest difference 0\n");
  CHECK(Call(folder, "compare whole.png whole.ppm --json").out ==
        "{\"psnr\":null,\"largest_difference\":0}\n");
  CHECK(Call(folder, "compare whole.png many.png").out == "PSNR inf, largest difference 0\n");
  CHECK(Call(folder, "refocus nan -o filled.png --focus-at 5,1 --fill-invalid").code == 0);
  CHECK(Call(folder, "info nan").out.find("5 views") != std::string::npos);
  CHECK(Call(folder, "info nan --json").out.find("\"invalid\":1,") != std::string::npos);
  CHECK(Call(folder, "sheet -o sheet.png whole.png small.png --labels near,far --width 60").code ==
        0);
  Image sheet;
  REQUIRE(ReadImage(folder.file("sheet.png"), &sheet) == "");
  CHECK(sheet.width <= 60);
  CHECK(Call(folder, "--help").code == 0);
  CHECK(Call(folder, "refocus --help").code == 0);
  CHECK(Call(folder, "analyze --help").code == 0);
}

TEST_CASE("wide pictures are refocused in larger blocks") {
  const TempFolder folder;
  for (const auto& [size, side] : {std::pair{"1535x16", "64"}, {"1536x16", "128"}}) {
    CAPTURE(size);
    REQUIRE(Call(folder, std::string("scene wide --views 1 --size ") + size).code == 0);
    REQUIRE(Call(folder, "refocus wide -o wide.ppm --focus 3 --report wide.json").code == 0);
    const std::string expected = std::string("\"largest_block\": ") + side + ",";
    CHECK(Text(folder.file("wide.json")).find(expected) != std::string::npos);
  }
}

TEST_CASE("cli: a region is that part of the picture") {
  TempFolder folder;
  Prepare(folder);
  REQUIRE(Call(folder, "refocus lf -o whole.png --focus 0.5 --map map.png").code == 0);
  REQUIRE(Call(folder,
               "refocus lf -o part.png --focus 0.5 --region 7,5,20,11 --map part_map.png "
               "--report part.json")
              .code == 0);
  for (const std::string name : {"whole part", "map part_map"}) {
    Image whole, part;
    REQUIRE(ReadImage(folder.file(name.substr(0, name.find(' ')) + ".png"), &whole) == "");
    REQUIRE(ReadImage(folder.file(name.substr(name.find(' ') + 1) + ".png"), &part) == "");
    REQUIRE(part.width == 20);
    REQUIRE(part.height == 11);
    for (int y = 0; y < part.height; ++y) {
      CHECK(std::equal(part.row(y), part.row(y) + part.stride(), whole.row(y + 5) + 3 * 7));
    }
  }
  CHECK(Text(folder.file("part.json")).find("\"region\": [") != std::string::npos);
}

TEST_CASE("cli: a video is its frames one by one, but for the work") {
  TempFolder folder;
  REQUIRE(Call(folder, "scene lf --size 200x100 --views 5 --name wires").code == 0);
  REQUIRE(fs::create_directory(folder.file("in")));
  for (const char* name : {"in/1", "in/2", "in/3", "in/4"}) {
    fs::copy(folder.file("lf"), folder.file(name));
  }
  // The third and fourth frame differ from the others in a corner.
  Image view;
  const std::string centre = folder.file("in/3/view_+0.0_+0.0.png");
  REQUIRE(ReadImage(centre, &view) == "");
  std::fill_n(view.row(2), 20, uint8_t{255});
  REQUIRE(WriteImage(centre, view) == "");
  fs::copy(centre, folder.file("in/4/view_+0.0_+0.0.png"), fs::copy_options::overwrite_existing);
  const std::string lens = " --focus 3 --aperture 0.2 --largest-block 32";
  REQUIRE(Call(folder, "video in -o out --report v.json" + lens).code == 0);
  REQUIRE(Call(folder, "video in/1 in/3 -o two" + lens).code == 0);
  // Neither a hidden folder nor its own output is a frame.
  REQUIRE(fs::create_directory(folder.file("in/.cache")));
  REQUIRE(fs::create_directory(folder.file("in/out")));
  REQUIRE(Call(folder, "video in -o in/out" + lens).code == 0);
  CHECK(Text(folder.file("in/out/frame_0003.png")) == Text(folder.file("out/frame_0003.png")));
  for (const int frame : {0, 1, 2, 3}) {
    const std::string name = std::to_string(frame + 1);
    REQUIRE(Call(folder, "refocus in/" + name + " -o one.png" + lens).code == 0);
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
    REQUIRE(Call(folder, "refocus lf -o s.png --sweep -1:2:4 --threads 2 --report s.json" + more)
                .code == 0);
    for (int i = 0; i < 4; ++i) {
      const std::string focus = std::to_string(i - 1), name = "s_00" + std::to_string(i) + ".png";
      REQUIRE(Call(folder, "refocus lf -o one.png --focus " + focus + more).code == 0);
      CHECK(Text(folder.file(name)) == Text(folder.file("one.png")));
    }
    CHECK(!fs::exists(folder.file("s.png")));
    CHECK(!fs::exists(folder.file("s_004.png")));
    const std::string report = Text(folder.file("s.json"));
    CHECK(report.find("\"s_003.png\"") != std::string::npos);
    CHECK(report.find("\"prepared_bytes\": 0") == std::string::npos);
  }
}

}  // namespace
}  // namespace starfocus::cli_test
