// SPDX-License-Identifier: Apache-2.0
// Tests the results of the subcommands, and the arguments that they reject.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "platform/file.h"
#include "platform/image_io.h"
#include "platform/light_field.h"
#include "tests/programs/call_program.h"
#include "tests/programs/session.h"
#include "tests/support/error_line.h"
#include "tests/support/temp_folder.h"

namespace starfocus::cli_slow_test {
namespace {

namespace fs = std::filesystem;

TEST_CASE("cli: every session of slow_sessions.txt succeeds") {
  RunSessions("programs/slow_sessions.txt", {{"light fields", Prepare}});
}

TEST_CASE("cli: every call of refusals.txt fails with the stated error") {
  TempFolder folder;
  Prepare(folder);
  CheckRefusals(folder, "refusals.txt");
}

TEST_CASE("cli: a region equals the same part of the whole picture") {
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

TEST_CASE(
    "cli: the frames of a video equal pictures refocused singly, although blocks are reused") {
  TempFolder folder;
  Succeed(folder, "scene lf --size 200x100 --views 5 --name wires");
  REQUIRE(fs::create_directory(folder.file("in")));
  for (const char* name : {"in/1", "in/2", "in/3", "in/4"}) {
    fs::copy(folder.file("lf"), folder.file(name));
  }
  // The third and the fourth frame differ from the first two frames in a corner.
  Image view;
  const std::string centre = folder.file("in/3/view_+0.0_+0.0.png");
  view = ValueOf(ReadImage(centre));
  std::fill_n(view.row(2), 20, uint8_t{255});
  REQUIRE(WriteImage(centre, view) == "");
  fs::copy(centre, folder.file("in/4/view_+0.0_+0.0.png"), fs::copy_options::overwrite_existing);
  const std::string lens = " --focus 3 --aperture 0.2 --superblock 32";
  Succeed(folder, "video in -o out --report v.json" + lens);
  Succeed(folder, "video in/1 in/3 -o two" + lens);
  // The program must not treat hidden folders and the output folder as frames.
  REQUIRE(fs::create_directory(folder.file("in/.cache")));
  REQUIRE(fs::create_directory(folder.file("in/out")));
  Succeed(folder, "video in -o in/out" + lens);
  CHECK(Text(folder.file("in/out/4.png")) == Text(folder.file("out/4.png")));
  for (const std::string name : {"1", "2", "3", "4"}) {
    Succeed(folder, "refocus in/" + name + " -o one.png" + lens);
    CHECK(Text(folder.file("out/" + name + ".png")) == Text(folder.file("one.png")));
  }
  CHECK(Text(folder.file("two/3.png")) == Text(folder.file("out/3.png")));
  CHECK(Text(folder.file("two/1.png")) != Text(folder.file("two/3.png")));
  // The four frames reuse no blocks, all blocks, most blocks, and all blocks.
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

TEST_CASE("cli: the pictures of a sweep equal single pictures") {
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
