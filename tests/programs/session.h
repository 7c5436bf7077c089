// SPDX-License-Identifier: Apache-2.0
// Runs the program STARFOCUS_PROGRAM, or starfocus-lab in the same folder, as tables of sessions
// state. The first lines of each table, tests/programs/*.txt, name the test that runs it.
//
// Each session starts in an empty folder and consists of the line "== NAME" and these lines:
// clang-format off
//   $ ARGUMENTS             calls the program, which must succeed
//   ! ARGUMENTS -> TEXT     calls the program, which must fail with this text (CheckRefused)
//   out TEXT, err TEXT      the last call must have printed the text
//   no out TEXT             the last call must not have printed the text; also with err
//   only out TEXT           the last call must have printed only the text; also with err
//   % COMMAND               runs a shell command, which must succeed; `starfocus` and `lab` are programs
//   psnr A B LEAST          the pictures A and B must agree to this PSNR in dB (inf: be equal)
//   closer T A B GAIN       the PSNR of T and A must exceed that of T and B by more than the gain in dB
//   map DIR [VALUE] [X,Y,W,H=VALUE]...
//                           sets all disparities of a light field, and those in rectangles
//   @ NAME                  makes inputs with one of the preparations of the test
// clang-format on
#ifndef STARFOCUS_TESTS_PROGRAMS_SESSION_H_
#define STARFOCUS_TESTS_PROGRAMS_SESSION_H_

#include <doctest/doctest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <sstream>
#include <string>

#include "platform/file.h"
#include "platform/image_io.h"
#include "platform/light_field.h"
#include "platform/pfm.h"
#include "platform/runner.h"
#include "tests/support/error_line.h"
#include "tests/support/hair.h"
#include "tests/support/temp_folder.h"

namespace starfocus {

// Returns the program that has the subcommand at the start of `arguments`.
inline std::string ProgramFor(const std::string& arguments) {
  const std::string command = arguments.substr(0, arguments.find(' '));
  for (const char* one :
       {"analyze", "calibrate", "compare", "flicker", "scene", "sheet", "steps"}) {
    if (command == one) return STARFOCUS_PROGRAM "-lab";
  }
  return STARFOCUS_PROGRAM;
}

struct Outcome {
  int code = -1;  // exit code, or -1 if a signal ended the program
  std::string out, err;
};

inline std::string Text(const std::string& path) {
  const Bytes bytes = ValueOf(ReadFile(path));
  return std::string(bytes.begin(), bytes.end());
}

// Runs a shell command.
inline Outcome RunLogged(const std::string& command) {
  TempFolder logs;
  const std::string out = logs.file("out"), err = logs.file("err");
  const int status = std::system(("exec >'" + out + "' 2>'" + err + "'; " + command).c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, Text(out), Text(err)};
}

// Runs a program in `folder` with shell-quoted arguments. The shell runs the command `before`
// first.
inline Outcome Call(const TempFolder& folder, const std::string& arguments,
                    const std::string& before = "") {
  return RunLogged("cd '" + folder.path() + "' && " + before + " exec " STARFOCUS_EMULATOR " '" +
                   ProgramFor(arguments) + "' " + arguments);
}

// Runs a call that must succeed.
inline void Succeed(const TempFolder& folder, const std::string& arguments) {
  CAPTURE(arguments);
  REQUIRE(Call(folder, arguments).code == 0);
}

// Returns an error line without the name of the program at its start.
inline std::string ErrorOf(const std::string& err) {
  const bool lab = err.rfind("starfocus-lab: ", 0) == 0, named = err.rfind("starfocus: ", 0) == 0;
  CHECK_MESSAGE((lab || named), "the error must begin with the name of the program");
  return err.substr(std::min<size_t>(lab ? 15 : 11, err.size()));
}

// Checks that stderr is one line that begins with the name of the program. The line must state what
// was expected and found, what the program cannot do and why, what it does not support, or "out of
// memory".
inline void CheckErrorLine(const std::string& err) {
  CHECK(err.find('\n') == err.size() - 1);
  const auto has = [&err](const char* part) { return err.find(part) != std::string::npos; };
  const bool cannot =
      ErrorOf(err).rfind("cannot ", 0) == 0 || has(" is not supported: ") || has(": out of memory");
  CHECK((cannot || has("expected ")));
  CHECK((cannot || has(", found ")));
}

// Checks that a call fails with an error line that contains `mention`, prints nothing to stdout and
// writes no file. The exit code must be 2 for an error in the command line, and 1 for an error in a
// file.
inline void CheckRefused(const TempFolder& folder, const std::string& arguments,
                         const std::string& mention) {
  CAPTURE(arguments);
  const int before = folder.count();
  const Outcome outcome = Call(folder, arguments);
  CAPTURE(outcome.err);
  REQUIRE_MESSAGE(outcome.code != 0, "the call must fail");
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

// Writes a light field into the folder `name` of a folder.
inline void SaveField(const TempFolder& folder, const std::string& name, const LightField& field) {
  ThreadRunner runner(1);
  REQUIRE(SaveLightField(folder.file(name), field, &runner) == "");
}

inline Image Picture(const TempFolder& folder, const std::string& name) {
  return ValueOf(ReadImage(folder.file(name)));
}

// Runs a shell command, in which `starfocus` and `lab` are the programs. Returns its exit status.
inline int RunShell(const TempFolder& folder, const std::string& command) {
  const std::string programs =
      "starfocus() { " STARFOCUS_EMULATOR " '" STARFOCUS_PROGRAM
      "' \"$@\"; }; lab() { " STARFOCUS_EMULATOR " '" STARFOCUS_PROGRAM "-lab' \"$@\"; }; ";
  return std::system(
      ("cd '" + folder.path() + "' && { " + programs + command + "; } >/dev/null").c_str());
}

using Preparations = std::map<std::string, std::function<void(const TempFolder&)>>;

// Changes the map of a light field: "DIR [VALUE] [X,Y,W,H=VALUE]...".
inline void ChangeMap(const TempFolder& folder, const std::string& change) {
  std::istringstream words(change);
  std::string light_field;
  words >> light_field;
  const std::string path = folder.file(light_field + "/disparity.pfm");
  FloatMap map = ValueOf(ReadPfm(path));
  for (std::string word; words >> word;) {
    int x = 0, y = 0, width = map.width, height = map.height;
    const size_t is = word.find('=');
    if (is != std::string::npos) {
      REQUIRE(std::sscanf(word.c_str(), "%d,%d,%d,%d=", &x, &y, &width, &height) == 4);
    }
    const float value = std::stof(word.substr(is == std::string::npos ? 0 : is + 1));
    for (int row = y; row < y + height; ++row) {
      std::fill_n(map.values.begin() + ptrdiff_t(row) * map.width + x, width, value);
    }
  }
  REQUIRE(WritePfm(path, map) == "");
}

// Returns the PSNR of two pictures in dB as the subcommand compare measures it.
inline double PsnrOf(const TempFolder& folder, const std::string& a, const std::string& b) {
  const Outcome outcome = Call(folder, "compare " + a + " " + b);
  CAPTURE(outcome.err);
  REQUIRE(outcome.out.rfind("PSNR ", 0) == 0);
  return std::stod(outcome.out.substr(5));
}

// Checks a line "psnr A B LEAST" or "closer T A B GAIN" of a session.
inline void CheckCloseness(const TempFolder& folder, const std::string& line) {
  std::istringstream words(line);
  std::string kind, truth, good, bad, limit;
  words >> kind >> truth >> good;
  if (kind == "closer") words >> bad;
  words >> limit;
  const double found = PsnrOf(folder, truth, good);
  const double other = bad.empty() ? 0 : PsnrOf(folder, truth, bad);
  CAPTURE(found);
  CAPTURE(other);
  CHECK((bad.empty() ? found >= std::stod(limit) : found > other + std::stod(limit)));
}

// Writes malformed files and the light field `lf`, which has 40x30 pixels and 5 views. `bare` is a
// copy of `lf` without map, and `grid` is a copy of `lf` with other names of views. `link` is a
// link to `lf`.
inline void MakeLightFields(const TempFolder& folder) {
  REQUIRE(RunShell(folder, R"(set -e
lab scene lf --size 40x30 --views 5 --name wires
lab scene truths --size 40x30 --views 1 --truth 1,1
lab scene tiny --size 20x10 --views 5
lab scene single --size 40x30 --views 1
lab scene small --size 4x4 --views 1 && mv small/view_+0.0_+0.0.png small.png && rm -r small
lab scene large --size 5x4 --views 1 && mv large/view_+0.0_+0.0.png large.png && rm -r large
printf hello >text.png
for name in missing broken nan huge short bare linked; do cp -r lf $name; done
mv linked/view_+1.0_+0.0.png target.png
ln -s ../target.png linked/view_+1.0_+0.0.png
ln -s ../target.png linked/out.png
rm missing/view_+0.0_+0.0.png bare/disparity.pfm
printf '\1\2\3' >broken/view_-1.0_+0.0.png
head -c 100 lf/disparity.pfm >short/disparity.pfm
mkdir taken_002.png grid
ln -s lf link
for number in 0 1 2; do cp lf/view_+0.0_+0.0.png grid/v_0_$number.png; done
cp lf/disparity.pfm grid
ln grid/v_0_1.png hard.png)") == 0);
  ChangeMap(folder, "nan 5,1,1,1=nan");
  ChangeMap(folder, "huge 5,1,1,1=1e9");
}

// Writes two folders with a portrait: `truth` has the coverage of the hair, and `closed` has no
// coverage.
inline void PrepareHair(const TempFolder& folder) {
  const test::ClosedHair portrait = test::MakeClosedHair();
  LightField field;
  field.views.emplace_back(test::ClosedHair::kWidth, test::ClosedHair::kHeight);
  field.views[0].pixels = portrait.rgb;
  field.disparity = {test::ClosedHair::kWidth, test::ClosedHair::kHeight, portrait.map};
  SaveField(folder, "closed", field);
  field.coverage = portrait.coverage;
  SaveField(folder, "truth", field);
}

// Checks the output of the last call against an out or err line of a session.
inline void CheckOutcome(std::string line, const Outcome& last) {
  const bool has = line.rfind("no ", 0) != 0, only = line.rfind("only ", 0) == 0;
  if (!has || only) line.erase(0, only ? 5 : 3);
  const bool is_known = line.rfind("out", 0) == 0 || line.rfind("err", 0) == 0;
  const bool ends = line.size() == 3 || line[3 % line.size()] == ' ';
  REQUIRE_MESSAGE((is_known && ends), "session.h does not describe this line");
  const std::string& printed = line[0] == 'o' ? last.out : last.err;
  CAPTURE(printed);
  if (only) CHECK(printed == line.substr(4) + "\n");
  CHECK((line.size() < 5 ? !printed.empty() : Contains(printed, line.substr(4))) == has);
}

// Runs the sessions of the table tests/NAME.
inline void RunSessions(const std::string& name, const Preparations& preparations = {}) {
  std::ifstream table(STARFOCUS_SOURCE_DIR "/tests/" + name);
  std::string session;
  std::unique_ptr<TempFolder> folder;
  Outcome last;
  int number = 0, lines = 1;  // lines of the table; lines of the session
  for (std::string line; std::getline(table, line);) {
    ++number;
    if (line.empty() || line[0] == '#') continue;
    INFO(name, ":", number, ": ", line, "  (", session, ")");
    const std::string rest = line.substr(std::min<size_t>(2, line.size()));
    if (line[0] == '=') {
      CHECK_MESSAGE(lines > 0, "the session before this line is empty");
      session = line;
      folder = std::make_unique<TempFolder>();
      lines = 0;
      continue;
    }
    REQUIRE_MESSAGE(folder != nullptr, "a line before the first session");
    ++lines;
    if (line[0] == '$') {
      last = Call(*folder, rest);
      CAPTURE(last.err);
      CHECK(last.code == 0);
    } else if (line[0] == '!') {
      const size_t arrow = rest.find(" -> ");
      REQUIRE_MESSAGE(arrow != std::string::npos, "expected \" -> \" and a text of the error");
      CheckRefused(*folder, rest.substr(0, arrow), rest.substr(arrow + 4));
    } else if (line[0] == '%') {
      CHECK(RunShell(*folder, rest) == 0);
    } else if (line.rfind("psnr ", 0) == 0 || line.rfind("closer ", 0) == 0) {
      CheckCloseness(*folder, line);
    } else if (line.rfind("map ", 0) == 0) {
      ChangeMap(*folder, line.substr(4));
    } else if (line[0] == '@') {
      const auto preparation = preparations.find(rest);
      REQUIRE_MESSAGE(preparation != preparations.end(),
                      "the test has no preparation of this name");
      preparation->second(*folder);
    } else {
      CheckOutcome(line, last);
    }
  }
  CHECK((lines > 0 && folder != nullptr));
}

}  // namespace starfocus

#endif  // STARFOCUS_TESTS_PROGRAMS_SESSION_H_
