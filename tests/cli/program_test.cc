// SPDX-License-Identifier: Apache-2.0
// Tests the features that all subcommands share: exit codes, help, the version, rejected arguments,
// and lost output.
#include "examples/command_line/program.h"

#include <doctest/doctest.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <new>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "platform/file.h"
#include "platform/light_field.h"
#include "platform/temporary_file.h"
#include "platform/text.h"
#include "starfocus/pool.h"
#include "tests/cli/call_program.h"
#include "tests/cli/refusals.h"
#include "tests/support/child.h"
#include "tests/support/error_line.h"

namespace starfocus::program_test {
namespace {

namespace fs = std::filesystem;

TEST_CASE("program: exit codes distinguish errors of the user, the input and the program") {
  CHECK(RunProgram("test", [] { return Error(); }) == 0);
  CHECK(RunProgram("test", [] { return Expected("file", "a", "b"); }) == 1);
  CHECK(RunProgram("test", [] { return Error::Usage("--option", "a", "b"); }) == 2);
  CHECK(RunProgram("test", [] { return Error::Internal("engine", "a", "b"); }) == 70);
  CHECK(RunProgram("test", []() -> Error { throw std::bad_alloc(); }) == 1);
  CHECK(RunProgram("test", []() -> Error { throw std::logic_error("a test"); }) == 70);
}

TEST_CASE("program: a program that a signal ends leaves no temporary file") {
  TempFolder folder;
  const int status = EndBySignal(SIGTERM, [&](const auto& begun) {
    RunProgram("test", [&] {
      const TemporaryFile file(folder.path());
      while (folder.count() == 1 && begun()) pause();
      return Error();
    });
  });
  CHECK(WIFSIGNALED(status));
  CHECK(folder.count() == 0);
}

TEST_CASE("program: a limit of file sizes causes one error and leaves no file") {
  TempFolder folder;
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    constexpr rlimit kSmall = {1000, 1000}, kNoCore = {};
    setrlimit(RLIMIT_CORE, &kNoCore);
    setrlimit(RLIMIT_FSIZE, &kSmall);
    _exit(RunProgram("test", [&] { return WriteFile(folder.file("out"), Bytes(100000)); }));
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 1);
  CHECK(folder.count() == 0);
}

TEST_CASE("program: every way to request help prints the same text") {
  TempFolder folder;
  const Outcome all = Call(folder, "help");
  CHECK(all.code == 0);
  CHECK(all.err == "");
  CHECK(Contains(all.out, "Exit codes: 0 "));
  for (const char* way : {"--help", "-h"}) CHECK(Call(folder, way).out == all.out);
  for (const std::string command :
       {"refocus", "disparity", "video", "view", "info", "import", "help"}) {
    CAPTURE(command);
    CHECK(Contains(all.out, "\n  " + command + " "));
    const Outcome one = Call(folder, "help " + command);
    CHECK(one.code == 0);
    CHECK(Contains(one.out, "starfocus " + command + " [OPTIONS]"));
    for (const char* way : {" --help", " -h"}) CHECK(Call(folder, command + way).out == one.out);
    // The help text must name the kind of each option's value.
    CHECK(!Contains(one.out, " TEXT"));
  }
  CHECK(Call(folder, "help --help-all").out == Call(folder, "help --help").out);
  for (const std::string command : {"scene", "compare", "sheet", "analyze", "calibrate", "steps"}) {
    CAPTURE(command);
    CHECK(!Contains(all.out, "\n  " + command + " "));
    const Outcome one = Call(folder, command + " --help");
    CHECK(Call(folder, command + " --help-all").out == one.out);
    CHECK(one.code == 0);
    CHECK(Contains(one.out, "starfocus-lab " + command + " [OPTIONS]"));
    CHECK(!Contains(one.out, " TEXT"));
  }
}

// Returns the lines of a help text below "Examples:", without their indentation.
std::vector<std::string> ExamplesIn(const std::string& help) {
  std::vector<std::string> examples;
  const size_t begin = help.find("\nExamples:\n");
  if (begin == std::string::npos) return examples;
  std::istringstream lines(help.substr(begin + 11));
  for (std::string line; std::getline(lines, line) && line.rfind("  ", 0) == 0;) {
    examples.push_back(line.substr(2));
  }
  return examples;
}

// Returns the names of all options that a help text lists: "-o" and "--output" for the line
// "  -o,--output FILE".
std::set<std::string> OptionsIn(const std::string& help) {
  std::set<std::string> options;
  std::istringstream lines(help);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("  -", 0) != 0) continue;
    std::istringstream names(line.substr(2, line.find(' ', 2) - 2));
    for (std::string name; std::getline(names, name, ',');) options.insert(name);
  }
  return options;
}

TEST_CASE("program: the help of each command ends with two examples") {
  TempFolder folder;
  const Outcome manual = Call(folder, "help --man");
  for (const std::string command :
       {"refocus", "disparity", "video", "view", "info", "import", "help", "scene", "compare",
        "sheet", "analyze", "calibrate", "steps"}) {
    CAPTURE(command);
    const std::string path = ProgramFor(command);
    const std::string name = path.substr(path.rfind('/') + 1);
    const std::string help = Call(folder, command + " --help").out;
    const std::set<std::string> options = OptionsIn(help);
    const std::vector<std::string> examples = ExamplesIn(help);
    CHECK(examples.size() == 2);
    for (const std::string& example : examples) {
      CAPTURE(example);
      CHECK((example + " ").rfind(name + " " + command + " ", 0) == 0);
      std::istringstream words(example);
      for (std::string word; words >> word;) {
        const bool number = word.size() > 1 && word[1] >= '0' && word[1] <= '9';
        if (word[0] == '-' && !number) CHECK(options.count(word) == 1);
      }
    }
  }
  CHECK(Contains(manual.out, "starfocus refocus photo.jpg \\-o near.jpg"));
}

// Returns the lines of a text.
std::vector<std::string> LinesOf(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST_CASE("program: --help fits on a screen, and --help-all and the manual have every option") {
  TempFolder folder;
  const std::string manual = Call(folder, "help --man").out;
  const std::string everything = Call(folder, "--help-all").out;
  for (const std::string command :
       {"", "refocus", "disparity", "video", "view", "info", "import"}) {
    CAPTURE(command);
    const std::string basic = Call(folder, command + " --help").out;
    const Outcome all = Call(folder, command + " --help-all");
    CHECK(all.code == 0);
    CHECK(LinesOf(basic).size() <= 25);
    for (const std::string& line : LinesOf(basic)) {
      CAPTURE(line);
      CHECK(line.size() <= 80);
      CHECK(line.rfind("   ", 0) != 0);  // a line without a name
    }
    const std::set<std::string> basics = OptionsIn(basic), options = OptionsIn(all.out);
    CHECK(options.size() > (command.empty() ? 3 : basics.size()));
    for (const std::string& option : basics) CHECK(options.count(option) == 1);
    for (const std::string& option : options) {
      CAPTURE(option);
      std::string roff = option;
      for (size_t at = 0; (at = roff.find('-', at)) != std::string::npos; at += 2) {
        roff.insert(at, "\\");
      }
      CHECK(Contains(manual, "\\fB" + roff + "\\fR"));
    }
    CHECK(options.count("--help-all") == 1);
    CHECK(Contains(everything, all.out));
  }
}

TEST_CASE("program: without arguments, the programs print the first lines of their help") {
  TempFolder folder;
  for (const std::string program : {STARFOCUS_PROGRAM, STARFOCUS_PROGRAM "-lab"}) {
    CAPTURE(program);
    const std::string logs = "'" + folder.file("out") + "' 2>'" + folder.file("err") + "'";
    const int status = std::system((STARFOCUS_EMULATOR " '" + program + "' >" + logs).c_str());
    CHECK(WEXITSTATUS(status) == 2);
    CHECK(Text(folder.file("err")) == "");
    const std::string lines = Text(folder.file("out"));
    const std::string start = lines.substr(0, lines.find("\n`"));
    CHECK(LinesOf(start).size() >= 10);
    CHECK(std::system((STARFOCUS_EMULATOR " '" + program + "' --help >" + logs).c_str()) == 0);
    CHECK(Text(folder.file("out")).rfind(start, 0) == 0);
  }
}

TEST_CASE("program: names with control characters are printed without them") {
  TempFolder folder;
  Succeed(folder, "scene lf --size 32x24 --views 1");
  for (const std::string name :
       {"\x1b[31mred", "bell\a", "two\nlines", "back\b", "delete\x7f", "c1 \xc2\x9b", "raw \x9b"}) {
    CAPTURE(name);
    fs::copy(folder.file("lf"), folder.file(name));
    const std::string quoted = "'" + name + "'";
    for (const std::string& arguments :
         {"info " + quoted, "refocus " + quoted + " -o " + quoted + ".png",
          "refocus " + quoted + " -o out/ --focus 500", "refocus " + quoted + " -o none/x.png",
          "view " + quoted + " -o x.html", "video " + quoted + " -o frames",
          "import " + quoted + " 'new " + name + "'",
          "disparity " + quoted + " --repair -o " + quoted + ".pfm",
          "info " + quoted + " --json"}) {
      CAPTURE(arguments);
      const Outcome outcome = Call(folder, arguments);
      const std::string printed = outcome.out + outcome.err;
      CHECK(!printed.empty());
      for (const std::string& line : LinesOf(printed)) CHECK(Printable(line) == line);
      CHECK(!Contains(printed, "\nlines"));
    }
  }
}

TEST_CASE("program: the default number of threads is the number of cores that it may use") {
  TempFolder folder;
  Succeed(folder, "scene lf --size 32x24 --views 1");
  const auto check = [&] {
    const std::string threads = "\"threads\": " + std::to_string(starfocus_pool_cores());
    for (const std::string call : {"refocus lf -o a.png", "video lf -o frames"}) {
      Succeed(folder, call + " --focus 1 --report a.json");
      const std::string report = Text(folder.file("a.json"));
      CHECK((Contains(report, threads + ",") || Contains(report, threads + "\n")));
    }
  };
  check();
  cpu_set_t all, one;
  REQUIRE(sched_getaffinity(0, sizeof(all), &all) == 0);
  CPU_ZERO(&one);
  for (int core = 0; CPU_COUNT(&one) == 0; ++core) {
    if (CPU_ISSET(core, &all)) CPU_SET(core, &one);
  }
  REQUIRE(sched_setaffinity(0, sizeof(one), &one) == 0);
  CHECK(starfocus_pool_cores() == 1);
  check();
  REQUIRE(sched_setaffinity(0, sizeof(all), &all) == 0);
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
    CHECK(Contains(manual.out, part));
  }
  const auto complete = [&](const std::string& words) {
    const std::string text = ". ./script\nCOMP_WORDS=(starfocus " + words +
                             ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_starfocus\n"
                             "IFS='|'\nprintf '%s\\n' \"${COMPREPLY[*]}\" | tr '|' '\\n' | "
                             "LC_ALL=C sort | paste -sd '|'\n";
    REQUIRE(WriteFile(folder.file("try"), Bytes(text.begin(), text.end())) == "");
    const std::string command = "cd '" + folder.path() + "' && bash try > said 2>&1";
    CHECK(std::system(command.c_str()) == 0);
    return Text(folder.file("said"));
  };
  if (std::system("command -v bash >/dev/null") != 0) return;
  CHECK(complete("refo") == "refocus\n");
  CHECK(complete("refocus --focus-") == "--focus-at|--focus-index|--focus-range\n");
  CHECK(complete("refocus lf --mode be") == "benchmark\n");
  CHECK(complete("refocus lf --focus ''") == "\n");
  CHECK(complete("refocus lf --views ''") == "1|17|5|9\n");
  CHECK(complete("refocus lf --shape ''") == "disc|fall-off\n");
  CHECK(complete("refocus lf -o sc") == "script\n");
  CHECK(complete("help vid") == "video\n");
  // Names with spaces, stars and quotes are single completions.
  for (const char* name : {"my first photo.jpg", "my *.jpg", "my 'quoted'.jpg"}) {
    REQUIRE(WriteText(folder.file(name), "") == "");
  }
  fs::create_directory(folder.file("my folder"));
  CHECK(complete("refocus my") == "my 'quoted'.jpg|my *.jpg|my first photo.jpg|my folder\n");
  CHECK(complete("refocus lf -o my") == "my 'quoted'.jpg|my *.jpg|my first photo.jpg|my folder\n");
  CHECK(complete("video lf -o my") == "my folder\n");
}

TEST_CASE("program: the program fails if it cannot write its output") {
  TempFolder folder;
  Succeed(folder, "scene lf --size 20x15 --views 1");
  const std::string view = "lf/view_+0.0_+0.0.png ";
  for (const std::string& arguments :
       {std::string("info lf"), std::string("info lf --json"), "compare " + view + view,
        std::string("--help"), std::string("--version"), std::string("help --man")}) {
    CAPTURE(arguments);
    const Outcome full = Call(folder, arguments + " >/dev/full");
    CHECK(full.code == 1);
    CheckErrorLine(full.err);
    CHECK(Contains(full.err, "standard output"));
    const Outcome closed =
        Call(folder, arguments + " >&8", "rm -f p; mkfifo p; true <p & exec 8>p; wait;");
    // A closed pipe, as after `| head`, ends the program like other programs.
    CHECK(closed.code == -1);
    CHECK(closed.err == "");
  }
  CHECK(Call(folder, "refocus lf --focus 1 -o a.png --report /dev/full").code == 1);
}

TEST_CASE(
    "program: if starfocus gets a subcommand of starfocus-lab, the error names starfocus-lab") {
  TempFolder folder;
  for (const std::string name : {"analyze", "calibrate", "compare", "scene", "sheet", "steps"}) {
    CAPTURE(name);
    CHECK(Call(folder, name + " --help").code == 0);  // Call selects the program starfocus-lab.
    // With quotes around the subcommand, Call selects starfocus.
    CheckRefused(folder, "'" + name + "' lf",
                 "command line: expected `starfocus-lab " + name + "`, found '" + name + "'");
  }
}

TEST_CASE("program: an error line names the cause of the error") {
  TempFolder folder;
  Prepare(folder);
  const size_t before = LightFieldFiles(folder.file("lf")).size();
  CheckRefusals(folder, "causes.txt");
  CHECK(LightFieldFiles(folder.file("lf")).size() == before);
  CHECK(!fs::exists(folder.file("lf/lf.png")));
  CHECK(!fs::exists(folder.file("bare/disparity.pfm")));
  if (geteuid() == 0) return;  // Root can write to any folder, so the calls below would not fail.
  fs::create_directory(folder.file("locked"));
  fs::permissions(folder.file("locked"), fs::perms::owner_read | fs::perms::owner_exec);
  for (const char* arguments :
       {"import lf locked/new", "scene locked/new", "analyze -o locked/new",
        "steps lf -o locked/new --focus 1", "refocus lf tiny -o locked/new --focus 1"}) {
    CheckRefused(folder, arguments, "cannot create folder locked/new: permission denied");
  }
}

}  // namespace
}  // namespace starfocus::program_test
