// SPDX-License-Identifier: Apache-2.0
// Runs the program STARFOCUS_PROGRAM, or starfocus-lab in the same folder.
#ifndef STARFOCUS_TESTS_CLI_CALL_PROGRAM_H_
#define STARFOCUS_TESTS_CLI_CALL_PROGRAM_H_

#include <doctest/doctest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "platform/file.h"
#include "tests/support/error_line.h"
#include "tests/support/temp_folder.h"

namespace starfocus {

// Returns the program that has the subcommand at the start of `arguments`.
inline std::string ProgramFor(const std::string& arguments) {
  const std::string command = arguments.substr(0, arguments.find(' '));
  for (const char* one : {"analyze", "calibrate", "compare", "scene", "sheet", "steps"}) {
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

// Runs a program in `folder` with shell-quoted arguments. The shell runs the command `before`
// first.
inline Outcome Call(const TempFolder& folder, const std::string& arguments,
                    const std::string& before = "") {
  TempFolder logs;
  const std::string command = "cd '" + folder.path() + "' && " + before +
                              " exec " STARFOCUS_EMULATOR " '" + ProgramFor(arguments) + "' " +
                              arguments;
  const int status = std::system(
      ("exec >'" + logs.file("out") + "' 2>'" + logs.file("err") + "'; " + command).c_str());
  Outcome outcome;
  if (WIFEXITED(status)) outcome.code = WEXITSTATUS(status);
  outcome.out = Text(logs.file("out"));
  outcome.err = Text(logs.file("err"));
  return outcome;
}

// Runs a call that must succeed.
inline void Succeed(const TempFolder& folder, const std::string& arguments) {
  CAPTURE(arguments);
  REQUIRE(Call(folder, arguments).code == 0);
}

// Returns an error line without the name of the program at its start.
inline std::string ErrorOf(const std::string& err) {
  const size_t begin = err.rfind("starfocus-lab: ", 0) == 0 ? 15 : 11;
  CHECK((begin == 15 || err.rfind("starfocus: ", 0) == 0));
  return err.substr(std::min(begin, err.size()));
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

}  // namespace starfocus

#endif  // STARFOCUS_TESTS_CLI_CALL_PROGRAM_H_
