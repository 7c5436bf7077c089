// SPDX-License-Identifier: Apache-2.0
// Reads sessions from tables, and runs the programs as the sessions state. Each session starts in
// an empty folder, and consists of the line "== NAME" followed by these lines:
//   $ ARGUMENTS          calls the program, which must succeed
//   ! ARGUMENTS -> TEXT  calls the program, which must fail with this text (CheckRefused)
//   out TEXT, err TEXT   the last call must have printed the text
//   no out TEXT          the last call must not have printed the text; also with err
//   only out TEXT        the last call must have printed only the text; also with err
//   % COMMAND            runs a shell command, which must succeed
//   @ NAME               makes inputs with one of the preparations
#ifndef STARFOCUS_TESTS_PROGRAMS_SESSION_H_
#define STARFOCUS_TESTS_PROGRAMS_SESSION_H_

#include <functional>
#include <map>
#include <memory>

#include "tests/programs/refusals.h"

namespace starfocus {

using Preparations = std::map<std::string, std::function<void(const TempFolder&)>>;

// Checks the output of the last call against an out or err line of a session.
inline void CheckOutcome(std::string line, const Outcome& last) {
  const bool has = line.rfind("no ", 0) != 0, only = line.rfind("only ", 0) == 0;
  if (!has || only) line.erase(0, only ? 5 : 3);
  const bool is_known = line.rfind("out", 0) == 0 || line.rfind("err", 0) == 0;
  REQUIRE_MESSAGE(is_known, line);
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
  for (std::string line; std::getline(table, line);) {
    CAPTURE(session);
    CAPTURE(line);
    const std::string rest = line.substr(std::min<size_t>(2, line.size()));
    if (line.empty() || line[0] == '#') continue;
    if (line[0] == '=') {
      session = line;
      folder = std::make_unique<TempFolder>();
    } else if (line[0] == '$') {
      last = Call(*folder, rest);
      CAPTURE(last.err);
      CHECK(last.code == 0);
    } else if (line[0] == '!') {
      const size_t arrow = rest.find(" -> ");
      CheckRefused(*folder, rest.substr(0, arrow), rest.substr(arrow + 4));
    } else if (line[0] == '%') {
      CHECK(std::system(("cd '" + folder->path() + "' && { " + rest + "; } >/dev/null").c_str()) ==
            0);
    } else if (line[0] == '@') {
      preparations.at(rest)(*folder);
    } else {
      CheckOutcome(line, last);
    }
  }
  CHECK(!session.empty());
}

}  // namespace starfocus

#endif  // STARFOCUS_TESTS_PROGRAMS_SESSION_H_
