// SPDX-License-Identifier: Apache-2.0
// Calls of the program that are refused, and broken inputs for them.
#ifndef STARFOCUS_TESTS_CLI_REFUSALS_H_
#define STARFOCUS_TESTS_CLI_REFUSALS_H_

#include <doctest/doctest.h>

#include <filesystem>
#include <limits>
#include <string>

#include "platform/file.h"
#include "platform/image_io.h"
#include "platform/pfm.h"
#include "tests/cli/call_program.h"
#include "tests/support/error_line.h"
#include "tests/support/temp_folder.h"

namespace starfocus {

// Nothing on stdout, no new file, and exit code 2 where the error line is about the command line, 1
// where it is about a file.
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
  CHECK(outcome.err.find(mention) != std::string::npos);
  CHECK(folder.count() == before);
}

// A folder with a 40x30 light field `lf` of 5 views and some broken things around it.
inline void Prepare(const TempFolder& folder) {
  REQUIRE(Call(folder, "scene lf --size 40x30 --views 5 --name wires").code == 0);
  REQUIRE(WriteFile(folder.file("text.png"), Bytes{'h', 'e', 'l', 'l', 'o'}) == "");
  REQUIRE(WriteImage(folder.file("small.png"), Image(4, 4)) == "");
  REQUIRE(WriteImage(folder.file("large.png"), Image(5, 4)) == "");
  for (const char* name : {"missing", "broken", "nan", "huge", "short"}) {
    std::filesystem::copy(folder.file("lf"), folder.file(name));
  }
  std::filesystem::copy(folder.file("lf"), folder.file("linked"));
  std::filesystem::rename(folder.file("linked/view_+1.0_+0.0.png"), folder.file("target.png"));
  std::filesystem::create_symlink("../target.png", folder.file("linked/view_+1.0_+0.0.png"));
  std::filesystem::create_symlink("../target.png", folder.file("linked/out.png"));
  std::filesystem::remove(folder.file("missing/view_+0.0_+0.0.png"));
  REQUIRE(WriteFile(folder.file("broken/view_-1.0_+0.0.png"), Bytes{1, 2, 3}) == "");
  FloatMap map;
  REQUIRE(ReadPfm(folder.file("lf/disparity.pfm"), &map) == "");
  map.values[45] = std::numeric_limits<float>::quiet_NaN();
  REQUIRE(WritePfm(folder.file("nan/disparity.pfm"), map) == "");
  map.values[45] = 1e9f;
  REQUIRE(WritePfm(folder.file("huge/disparity.pfm"), map) == "");
  std::filesystem::resize_file(folder.file("short/disparity.pfm"), 100);
  std::filesystem::create_directory(folder.file("taken_002.png"));
  REQUIRE(Call(folder, "scene tiny --size 20x10 --views 5").code == 0);
  REQUIRE(Call(folder, "scene single --size 40x30 --views 1").code == 0);
}

}  // namespace starfocus

#endif  // STARFOCUS_TESTS_CLI_REFUSALS_H_
