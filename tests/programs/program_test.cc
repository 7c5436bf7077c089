// SPDX-License-Identifier: Apache-2.0
// Tests the features that all subcommands share: exit codes, help, the version, rejected arguments,
// and lost output.
#include "examples/command_line/program.h"

#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <new>
#include <regex>
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
#include "tests/programs/session.h"
#include "tests/support/error_line.h"
#include "tests/support/processes.h"

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

// Returns the lines of a text.
std::vector<std::string> LinesOf(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// Returns the lines of a help text below "Examples:", without their indentation.
std::vector<std::string> ExamplesIn(const std::string& help) {
  std::vector<std::string> examples;
  const size_t begin = help.find("\nExamples:\n");
  if (begin == std::string::npos) return examples;
  for (const std::string& line : LinesOf(help.substr(begin + 11))) {
    if (line.rfind("  ", 0) != 0) break;
    examples.push_back(line.substr(2));
  }
  return examples;
}

// Returns the names of all options that a help text lists: "-o" and "--output" for the line
// "  -o,--output FILE".
std::set<std::string> OptionsIn(const std::string& help) {
  std::set<std::string> options;
  for (const std::string& line : LinesOf(help)) {
    if (line.rfind("  -", 0) != 0) continue;
    std::istringstream names(line.substr(2, line.find(' ', 2) - 2));
    for (std::string name; std::getline(names, name, ',');) options.insert(name);
  }
  return options;
}

// Checks that two examples call the command with options of `options`.
void CheckExamples(const std::string& help, const std::string& command,
                   const std::set<std::string>& options) {
  const std::string path = ProgramFor(command);
  const std::string start = path.substr(path.rfind('/') + 1) + " " + command + " ";
  const std::vector<std::string> examples = ExamplesIn(help);
  CHECK(examples.size() == 2);
  for (const std::string& example : examples) {
    CAPTURE(example);
    CHECK((example + " ").rfind(start, 0) == 0);
    std::istringstream words(example);
    for (std::string word; words >> word;) {
      const bool number = word.size() > 1 && word[1] >= '0' && word[1] <= '9';
      if (word[0] == '-' && !number) CHECK(options.count(word) == 1);
    }
  }
}

TEST_CASE(
    "program: help ends with two examples, and every way to request it prints the same text") {
  TempFolder folder;
  const Outcome all = Call(folder, "help");
  CHECK(all.code == 0);
  CHECK(all.err == "");
  CHECK(Contains(all.out, "Exit codes: 0 "));
  for (const char* way : {"--help", "-h"}) CHECK(Call(folder, way).out == all.out);
  for (const std::string command :
       {"refocus", "disparity", "video", "view", "info", "import", "help", "scene", "compare",
        "flicker", "sheet", "analyze", "calibrate", "steps"}) {
    CAPTURE(command);
    const bool lab = Contains(ProgramFor(command), "-lab");
    CHECK(Contains(all.out, "\n  " + command + " ") == !lab);
    const Outcome one = Call(folder, command + " --help");
    CHECK(one.code == 0);
    CHECK(Contains(one.out,
                   std::string(lab ? "starfocus-lab " : "starfocus ") + command + " [OPTIONS]"));
    CHECK(Call(folder, command + " -h").out == one.out);
    if (!lab) CHECK(Call(folder, "help " + command).out == one.out);
    if (lab || command == "help") CHECK(Call(folder, command + " --help-all").out == one.out);
    // The help text must name the kind of each option's value.
    CHECK(!Contains(one.out, " TEXT"));
    CheckExamples(one.out, command, OptionsIn(one.out));
  }
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
    CHECK(std::includes(options.begin(), options.end(), basics.begin(), basics.end()));
    for (const std::string& option : options) {
      CAPTURE(option);
      CHECK(Contains(manual, "\\fB" + std::regex_replace(option, std::regex("-"), "\\-") + "\\fR"));
    }
    CHECK(options.count("--help-all") == 1);
    CHECK(Contains(everything, all.out));
  }
}

TEST_CASE("program: --version names the library's version and the SIMD target") {
  TempFolder folder;
  CHECK(Call(folder, "--version").out == VersionText("starfocus") + "\n");
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
  const std::string threads = "\"threads\": " + std::to_string(starfocus_pool_cores());
  for (const std::string call : {"refocus lf -o a.png", "video lf -o frames"}) {
    Succeed(folder, call + " --focus 1 --report a.json");
    const std::string report = Text(folder.file("a.json"));
    CHECK((Contains(report, threads + ",") || Contains(report, threads + "\n")));
  }
}

TEST_CASE("program: every session of causes.txt succeeds") {
  RunSessions("programs/causes.txt", {{"light fields", MakeLightFields}});
}

}  // namespace
}  // namespace starfocus::program_test
