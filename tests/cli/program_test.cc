// SPDX-License-Identifier: Apache-2.0
// What every subcommand has in common: exit codes, help, the version, refusals, and output that is
// lost.
#include "examples/command_line/program.h"

#include <doctest/doctest.h>
#include <signal.h>
#include <unistd.h>

#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>

#include "platform/light_field.h"
#include "platform/temporary_file.h"
#include "tests/cli/call_program.h"
#include "tests/cli/refusals.h"
#include "tests/support/error_line.h"

namespace starfocus::program_test {
namespace {

namespace fs = std::filesystem;

TEST_CASE("program: exit codes tell whose an error is") {
  CHECK(RunProgram("test", [] { return Error(); }) == 0);
  CHECK(RunProgram("test", [] { return Expected("file", "a", "b"); }) == 1);
  CHECK(RunProgram("test", [] { return Error::Usage("--option", "a", "b"); }) == 2);
  CHECK(RunProgram("test", [] { return Error::Internal("engine", "a", "b"); }) == 70);
  CHECK(RunProgram("test", []() -> Error { throw std::bad_alloc(); }) == 1);
  CHECK(RunProgram("test", []() -> Error { throw std::logic_error("a test"); }) == 70);
}

TEST_CASE("program: a signal leaves no temporary file") {
  TempFolder folder;
  int ends[2];
  REQUIRE(pipe(ends) == 0);
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    RunProgram("test", [&] {
      const TemporaryFile file(folder.path());
      while (write(ends[1], "x", 1) == 1) pause();
      return Error();
    });
    _exit(0);
  }
  char byte = 0;
  REQUIRE(read(ends[0], &byte, 1) == 1);
  CHECK(folder.count() == 1);
  REQUIRE(kill(child, SIGTERM) == 0);
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(WIFSIGNALED(status));
  CHECK(folder.count() == 0);
  close(ends[0]);
  close(ends[1]);
}

TEST_CASE("program: every way to ask for help tells the same") {
  TempFolder folder;
  const Outcome all = Call(folder, "help");
  CHECK(all.code == 0);
  CHECK(all.err == "");
  CHECK(all.out.find("Exit codes: 0 ") != std::string::npos);
  for (const char* way : {"--help", "-h"}) CHECK(Call(folder, way).out == all.out);
  for (const std::string command :
       {"refocus", "disparity", "video", "view", "info", "import", "help"}) {
    CAPTURE(command);
    CHECK(all.out.find("\n  " + command + " ") != std::string::npos);
    const Outcome one = Call(folder, "help " + command);
    CHECK(one.code == 0);
    CHECK(one.out.find("starfocus " + command + " [OPTIONS]") != std::string::npos);
    for (const char* way : {" --help", " -h"}) CHECK(Call(folder, command + way).out == one.out);
    // Each option says what it takes.
    CHECK(one.out.find(" TEXT") == std::string::npos);
  }
  for (const std::string command :
       {"scene", "compare", "sheet", "analyze", "calibrate", "stress"}) {
    CAPTURE(command);
    CHECK(all.out.find("\n  " + command + " ") == std::string::npos);
    const Outcome one = Call(folder, command + " --help");
    CHECK(one.code == 0);
    CHECK(one.out.find("starfocus-lab " + command + " [OPTIONS]") != std::string::npos);
    CHECK(one.out.find(" TEXT") == std::string::npos);
  }
}

TEST_CASE("program: --version names the library's version and the SIMD target") {
  TempFolder folder;
  const Outcome outcome = Call(folder, "--version");
  CHECK(outcome.code == 0);
  CHECK(outcome.out == VersionText("starfocus") + "\n");
  CHECK(outcome.out.find("starfocus 0.") == 0);
}

TEST_CASE("program: the manual and the completion have every option") {
  TempFolder folder;
  const Outcome manual = Call(folder, "help --man"), script = Call(folder, "help --bash > script");
  CHECK(manual.code == 0);
  CHECK(script.code == 0);
  for (const char* part : {".TH starfocus 1", ".SS refocus SRC\n", ".SS help COMMAND\n",
                           "\\-\\-focus\\-at\\fR \\fIX,Y", ".SH EXIT STATUS"}) {
    CHECK(manual.out.find(part) != std::string::npos);
  }
  const auto complete = [&](const std::string& words) {
    const std::string text = ". ./script\nCOMP_WORDS=(starfocus " + words +
                             ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_starfocus\n"
                             "echo \"${COMPREPLY[*]}\"\n";
    REQUIRE(WriteFile(folder.file("try"), Bytes(text.begin(), text.end())) == "");
    const std::string command = "cd '" + folder.path() + "' && bash try > said 2>&1";
    CHECK(std::system(command.c_str()) == 0);
    return Text(folder.file("said"));
  };
  if (std::system("command -v bash >/dev/null") != 0) return;
  CHECK(complete("refo") == "refocus\n");
  CHECK(complete("refocus --focus-") == "--focus-index --focus-at\n");
  CHECK(complete("refocus lf --mode be") == "benchmark\n");
  CHECK(complete("refocus lf --focus ''") == "\n");
  CHECK(complete("refocus lf --views ''") == "17 9 5 1\n");
  CHECK(complete("refocus lf --shape ''") == "fall-off disc\n");
  CHECK(complete("refocus lf -o sc") == "script\n");
  CHECK(complete("help vid") == "video\n");
}

TEST_CASE("program: output that does not arrive is an error") {
  TempFolder folder;
  REQUIRE(Call(folder, "scene lf --size 20x15 --views 1").code == 0);
  const std::string view = "lf/view_+0.0_+0.0.png ";
  for (const std::string& arguments :
       {std::string("info lf"), std::string("info lf --json"), "compare " + view + view,
        std::string("--help"), std::string("--version"), std::string("help --man")}) {
    CAPTURE(arguments);
    const Outcome full = Call(folder, arguments + " >/dev/full");
    CHECK(full.code == 1);
    CheckErrorLine(full.err);
    CHECK(full.err.find("standard output") != std::string::npos);
    const Outcome closed =
        Call(folder, arguments + " >&8", "rm -f p; mkfifo p; true <p & exec 8>p; wait;");
    CHECK(closed.code == 1);
    CheckErrorLine(closed.err);
    CHECK(closed.err.find("standard output") != std::string::npos);
  }
  CHECK(Call(folder, "refocus lf --focus 1 -o a.png --report /dev/full").code == 1);
}

TEST_CASE("program: a refusal names its true cause") {
  TempFolder folder;
  Prepare(folder);
  const struct {
    const char* arguments;
    const char* mention;
  } bad[] = {
      {"refocus lf -o x.png --focs 1",
       "--focs: expected an option of refocus (the nearest is --focus)"},
      {"refocus lf --outptu x.png",
       "--outptu: expected an option of refocus (the nearest is --output)"},
      {"refocus lf -o x.png --fstop=2",
       "--fstop: expected an option of refocus (the nearest is --f-stop)"},
      {"refocus lf -o x.png --depth-pho", "(the nearest is --depth-photo)"},
      {"refocus lf -o x.png --zzzzzz 1", "`starfocus refocus --help` lists them"},
      {"refcous lf -o x.png", "a subcommand (the nearest is refocus), found 'refcous'"},
      {"help refocsu", "a subcommand (the nearest is refocus)"},
      {"refocus lf -o x.png --focus-at 16 12",
       "as in --focus-at 16,12, found '16 12' (a comma is missing)"},
      {"refocus lf --focus-at 16 12 -o x.png", "(a comma is missing)"},
      {"refocus lf -o x.png --focus-at '16 12'", "(a comma is missing)"},
      {"refocus lf -o x.png --focus-at=16 12", "(a comma is missing)"},
      {"refocus lf -o x.png --focus-at 16, 12", "found '16, 12' (with spaces)"},
      {"refocus lf -o x.png --focus 1 --region 1 2 3 4", "--region 1,2,3,4, found"},
      {"refocus lf -o x.png --sweep -1 2 4", "--sweep -1:2:4, found '-1 2 4' (a colon is missing)"},
      {"disparity lf -o map.pfm --range -4 9", "--range -4:9, found"},
      {"scene new --size 40 30", "--size 40x30, found '40 30' (an x is missing)"},
      {"scene new --truth 4 1", "--truth 4,1, found"},
      {"refocus lf -o", "--output: expected a value FILE, found none"},
      {"refocus lf -o x.png --focus", "--focus: expected a value D, found none"},
      {"refocus lf --focus 1", "--output: expected --output FILE, found none"},
      {"refocus -o x.png", "SRC: expected DIR|PHOTO, found none"},
      {"compare small.png large.png text.png", "no other argument of compare, found 'text.png'"},
      {"info lf --json lf", "no other argument of info, found 'lf'"},
      {"import lf text.png", "cannot create folder text.png: a file of that name exists"},
      {"import lf text.png/new", "cannot create folder text.png/new: "},
      {"video lf -o text.png --focus 1",
       "cannot create folder text.png: a file of that name exists"},
      {"scene text.png", "cannot create folder text.png: a file of that name exists"},
      {"refocus lf tiny -o text.png/ --focus 1", "cannot create folder text.png/: "}};
  for (const auto& row : bad) CheckRefused(folder, row.arguments, row.mention);
  if (geteuid() == 0) return;  // root may write everywhere
  fs::create_directory(folder.file("locked"));
  fs::permissions(folder.file("locked"), fs::perms::owner_read | fs::perms::owner_exec);
  for (const char* arguments : {"import lf locked/new", "scene locked/new", "analyze -o locked/new",
                                "refocus lf tiny -o locked/new --focus 1"}) {
    CheckRefused(folder, arguments, "cannot create folder locked/new: permission denied");
  }
}

TEST_CASE("program: no output goes into a light field that is read") {
  TempFolder folder;
  Prepare(folder);
  fs::create_directory_symlink("lf", folder.file("link"));
  fs::create_directory(folder.file("grid"));
  for (const char* name : {"v_0_0.png", "v_0_1.png", "v_0_2.png"}) {
    fs::copy_file(folder.file("lf/view_+0.0_+0.0.png"), folder.file(std::string("grid/") + name));
  }
  fs::copy_file(folder.file("lf/disparity.pfm"), folder.file("grid/disparity.pfm"));
  fs::create_hard_link(folder.file("grid/v_0_1.png"), folder.file("hard.png"));
  REQUIRE(Call(folder, "scene truths --size 40x30 --views 1 --truth 1,1").code == 0);
  const size_t before = LightFieldFiles(folder.file("lf")).size();
  const struct {
    const char* arguments;
    const char* mention;
  } bad[] = {{"refocus lf tiny -o lf --focus 1", "lf, a light field that is read"},
             {"refocus tiny lf -o ./lf/ --focus 1", "a light field that is read"},
             {"refocus lf tiny -o link --focus 1", "a light field that is read"},
             {"refocus link tiny -o lf/../lf --focus 1", "a light field that is read"},
             {"refocus lf -o lf --focus 1", "a light field that is read"},
             {"refocus grid -o grid/out.png --focus 1", "would be taken for a view"},
             {"refocus grid -o x.png --focus 1 --map grid/map.png", "would be taken for a view"},
             {"refocus grid -o x.png --focus 1 --report grid/calib.txt", "which is read"},
             {"import lf link", "a light field that is read"},
             {"import grid ./grid/", "a light field that is read"},
             {"view truths -o truths/truth_dt1_ut1.png", "which is read"},
             {"compare grid/v_0_0.png grid/v_0_1.png --map hard.png", "which is read"},
             {"video lf lf -o link --focus 1", "a light field that is read"}};
  for (const auto& row : bad) CheckRefused(folder, row.arguments, row.mention);
  CHECK(LightFieldFiles(folder.file("lf")).size() == before);
  CHECK(!fs::exists(folder.file("lf/lf.png")));
  // A folder within one, or one that holds inputs, is another.
  CHECK(Call(folder, "refocus lf tiny -o lf/out --focus 1").code == 0);
  CHECK(Call(folder, "refocus lf tiny -o . --focus 1").code == 0);
}

}  // namespace
}  // namespace starfocus::program_test
