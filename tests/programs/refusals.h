// SPDX-License-Identifier: Apache-2.0
// Checks calls that the programs must reject, and makes malformed inputs for these calls.
#ifndef STARFOCUS_TESTS_PROGRAMS_REFUSALS_H_
#define STARFOCUS_TESTS_PROGRAMS_REFUSALS_H_

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include "platform/file.h"
#include "platform/image_io.h"
#include "platform/pfm.h"
#include "tests/programs/call_program.h"
#include "tests/support/error_line.h"
#include "tests/support/temp_folder.h"

namespace starfocus {

// Checks that a call fails with an error line that contains `mention`, prints nothing to stdout and
// writes no file. The exit code must be 2 for an error in the command line, and 1 for an error in a
// file.
inline void CheckRefused(const TempFolder& folder, const std::string& arguments,
                         const std::string& mention) {
  CAPTURE(arguments);
  const int before = folder.count();
  const Outcome outcome = Call(folder, arguments);
  CAPTURE(outcome.err);
  bool usage = false;
  for (const char* what :
       {"-", "command line: ", "DIR: ", "SRC: ", "COMMAND: ", "A: ", "B: ", "IMG: "}) {
    usage = usage || ErrorOf(outcome.err).rfind(what, 0) == 0;
  }
  CHECK(outcome.code == (usage ? 2 : 1));
  CHECK(outcome.out == "");
  CheckErrorLine(outcome.err);
  CHECK(Contains(outcome.err, mention));
  CHECK(folder.count() == before);
}

// Checks each row of the table tests/programs/NAME.
inline void CheckRefusals(const TempFolder& folder, const std::string& name) {
  std::ifstream table(STARFOCUS_SOURCE_DIR "/tests/programs/" + name);
  int rows = 0;
  for (std::string row; std::getline(table, row);) {
    const size_t arrow = row.find(" -> ");
    if (row.rfind("#", 0) == 0 || arrow == std::string::npos) continue;
    CheckRefused(folder, row.substr(0, arrow), row.substr(arrow + 4));
    ++rows;
  }
  CHECK(rows > 50);
}

// Writes malformed files and the light field `lf`, which has 40x30 pixels and 5 views. `bare` is a
// copy of `lf` without map, and `grid` is a copy of `lf` with other names of views. `link` is a
// link to `lf`.
inline void Prepare(const TempFolder& folder) {
  namespace fs = std::filesystem;
  Succeed(folder, "scene lf --size 40x30 --views 5 --name wires");
  REQUIRE(WriteFile(folder.file("text.png"), Bytes{'h', 'e', 'l', 'l', 'o'}) == "");
  REQUIRE(WriteImage(folder.file("small.png"), Image(4, 4)) == "");
  REQUIRE(WriteImage(folder.file("large.png"), Image(5, 4)) == "");
  for (const char* name : {"missing", "broken", "nan", "huge", "short", "bare", "linked"}) {
    fs::copy(folder.file("lf"), folder.file(name));
  }
  fs::rename(folder.file("linked/view_+1.0_+0.0.png"), folder.file("target.png"));
  fs::create_symlink("../target.png", folder.file("linked/view_+1.0_+0.0.png"));
  fs::create_symlink("../target.png", folder.file("linked/out.png"));
  fs::remove(folder.file("missing/view_+0.0_+0.0.png"));
  REQUIRE(WriteFile(folder.file("broken/view_-1.0_+0.0.png"), Bytes{1, 2, 3}) == "");
  FloatMap map = ValueOf(ReadPfm(folder.file("lf/disparity.pfm")));
  map.values[45] = std::numeric_limits<float>::quiet_NaN();
  REQUIRE(WritePfm(folder.file("nan/disparity.pfm"), map) == "");
  map.values[45] = 1e9f;
  REQUIRE(WritePfm(folder.file("huge/disparity.pfm"), map) == "");
  fs::resize_file(folder.file("short/disparity.pfm"), 100);
  fs::create_directory(folder.file("taken_002.png"));
  fs::remove(folder.file("bare/disparity.pfm"));
  fs::create_directory_symlink("lf", folder.file("link"));
  fs::create_directory(folder.file("grid"));
  for (const char* name : {"v_0_0.png", "v_0_1.png", "v_0_2.png"}) {
    fs::copy_file(folder.file("lf/view_+0.0_+0.0.png"), folder.file(std::string("grid/") + name));
  }
  fs::copy_file(folder.file("lf/disparity.pfm"), folder.file("grid/disparity.pfm"));
  fs::create_hard_link(folder.file("grid/v_0_1.png"), folder.file("hard.png"));
  Succeed(folder, "scene truths --size 40x30 --views 1 --truth 1,1");
  Succeed(folder, "scene tiny --size 20x10 --views 5");
  Succeed(folder, "scene single --size 40x30 --views 1");
}

}  // namespace starfocus

#endif  // STARFOCUS_TESTS_PROGRAMS_REFUSALS_H_
