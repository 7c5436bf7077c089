// SPDX-License-Identifier: Apache-2.0
// What every subcommand has in common: exit codes, help, the version, and output that is lost.
#include "examples/command_line/program.h"

#include <doctest/doctest.h>
#include <signal.h>
#include <unistd.h>

#include <new>
#include <stdexcept>
#include <string>

#include "platform/temporary_file.h"
#include "tests/cli/call_program.h"

namespace starfocus {
namespace {

TEST_CASE("program: exit codes tell whose an error is") {
  CHECK(RunProgram("test", [] { return Error(); }) == 0);
  CHECK(RunProgram("test", [] { return Error("file: expected a, found b"); }) == 1);
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
  for (const std::string command : {"scene", "refocus", "video", "calibrate", "compare", "info",
                                    "view", "sheet", "analyze", "stress", "help"}) {
    CAPTURE(command);
    CHECK(all.out.find("\n  " + command + " ") != std::string::npos);
    const Outcome one = Call(folder, "help " + command);
    CHECK(one.code == 0);
    CHECK(one.out.find("starfocus " + command + " [OPTIONS]") != std::string::npos);
    for (const char* way : {" --help", " -h"}) CHECK(Call(folder, command + way).out == one.out);
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
  for (const char* part : {".TH STARFOCUS 1", ".SS refocus SRC\n", ".SS help COMMAND\n",
                           "\\-\\-focus\\-at", ".SH EXIT STATUS"}) {
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

}  // namespace
}  // namespace starfocus
