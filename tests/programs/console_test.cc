// SPDX-License-Identifier: Apache-2.0
// Tests the lines of the programs on terminals of any width: lines never continue the progress
// line, the progress line never wraps, and no text contains control characters.
#include "platform/console.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <string>
#include <vector>

#include "platform/progress.h"
#include "platform/result.h"
#include "platform/text.h"
#include "tests/support/terminal.h"

namespace starfocus::console_test {
namespace {

// Connects stderr to a terminal until the object is destroyed.
class StderrTerminal {
 public:
  StderrTerminal() : controller_(OpenPseudoterminal()) {
    REQUIRE(fcntl(controller_, F_SETFL, O_NONBLOCK) == 0);
    const int terminal = open(ptsname(controller_), O_RDWR | O_NOCTTY);
    REQUIRE(terminal >= 0);
    before_ = dup(STDERR_FILENO);
    dup2(terminal, STDERR_FILENO);
    close(terminal);
  }
  ~StderrTerminal() {
    dup2(before_, STDERR_FILENO);
    close(before_);
    close(controller_);
  }
  StderrTerminal(const StderrTerminal&) = delete;
  StderrTerminal& operator=(const StderrTerminal&) = delete;

  void Resize(int columns) const {
    const winsize size = {24, static_cast<unsigned short>(columns), 0, 0};
    REQUIRE(ioctl(controller_, TIOCSWINSZ, &size) == 0);
  }

  // Returns the text that has been written to the terminal since the last call. Terminals pass text
  // on some time after it is written, so Read writes a character and waits for it.
  std::string Read() const {
    constexpr char kEnd = '\x01';
    REQUIRE(write(STDERR_FILENO, &kEnd, 1) == 1);
    std::string text;
    while (text.empty() || text.back() != kEnd) {
      pollfd ready = {controller_, POLLIN, 0};
      REQUIRE(poll(&ready, 1, 10000) == 1);
      char buffer[4096];
      const ssize_t got = read(controller_, buffer, sizeof(buffer));
      REQUIRE(got > 0);
      text.append(buffer, size_t(got));
    }
    text.pop_back();
    return text;
  }

 private:
  const int controller_;
  int before_ = -1;
};

constexpr char kErase[] = "\r\x1b[K";

TEST_CASE("console: a line replaces the progress line, which appears again below the line" *
          doctest::test_suite("terminal")) {
  const StderrTerminal terminal;
  terminal.Resize(40);
  TellLine("first");
  CHECK(terminal.Read() == "first\r\n");
  ShowProgress("refocusing", ": 43 %");
  CHECK(terminal.Read() == std::string(kErase) + "refocusing: 43 %");
  TellLine("a note that is longer than the terminal is wide is not cut");
  CHECK(terminal.Read() == std::string(kErase) +
                               "a note that is longer than the terminal is wide is not cut\r\n"
                               "refocusing: 43 %");
  EraseProgress();
  TellLine("last");
  CHECK(terminal.Read() == std::string(kErase) + "last\r\n");
}

TEST_CASE("console: the progress line is narrower than the terminal at every width" *
          doctest::test_suite("terminal")) {
  const StderrTerminal terminal;
  const std::string label = "refocusing a photo with a long name", state = ": 43 %, 12 s left";
  for (const int columns : {200, 60, 40, 30, 20, 10, 4, 3, 2, 1, 60}) {
    CAPTURE(columns);
    terminal.Resize(columns);
    ShowProgress(label, state);
    const std::string shown = terminal.Read().substr(sizeof(kErase) - 1);
    CHECK(shown.size() < size_t(columns));
    // The label is cut before the state.
    if (columns >= 20) CHECK(shown.substr(shown.size() - state.size()) == state);
    if (columns > 60) CHECK(shown == label + state);
  }
  EraseProgress();
}

TEST_CASE("console: texts of any characters are cut between characters, to the exact width") {
  struct Case {
    const char* text;
    int columns;
    const char* fits;
  };
  for (const Case& one : std::vector<Case>{
           {"", 0, ""},
           {"abc", 3, "abc"},
           {"abcd", 3, "..."},
           {"abcdef", 5, "ab..."},
           {"abcdef", 1, "."},
           {"abcdef", 0, ""},
           {"\xc3\xa4\xc3\xb6\xc3\xbc\xc3\xa4\xc3\xb6\xc3\xbc", 5, "\xc3\xa4\xc3\xb6..."},
           {"\xe5\x86\x99\xe7\x9c\x9f", 4, "\xe5\x86\x99\xe7\x9c\x9f"},  // two wide characters
           {"\xe5\x86\x99\xe7\x9c\x9f\xe5\x86\x99", 5, "\xe5\x86\x99..."},
           {"\xe5\x86\x99\xe7\x9c\x9f\xe5\x86\x99", 4, "..."},
           {"e\xcc\x81"
            "e\xcc\x81",
            2,
            "e\xcc\x81"
            "e\xcc\x81"},  // combining accents
           {"e\xcc\x81"
            "e\xcc\x81"
            "abc",
            4, "e\xcc\x81..."},
           {"\xff\xfe"
            "abcd",
            5, "\xff\xfe..."},
       }) {
    CAPTURE(one.text);
    CAPTURE(one.columns);
    CHECK(FitColumns(one.text, one.columns) == one.fits);
  }
}

TEST_CASE("console: lines and errors contain no control characters, and keep all other text") {
  const std::string safe = "a \xc3\xa9\xc4\x9b\xe5\x86\x99\xf0\x9f\x93\xb7\xe9z";
  CHECK(Printable(safe) == safe);
  CHECK(Error(ErrorKind::kInput, safe).line() == safe);
  for (int code = 1; code < 0xa0; ++code) {
    if (code == 0x20) code = 0x7f;
    CAPTURE(code);
    const std::string raw(1, char(code));
    CHECK(Printable("a" + raw + "[31mb") == "a [31mb");
    CHECK(Error(ErrorKind::kInput, raw).line() == " ");
    if (code >= 0x80) CHECK(Printable("a\xc2" + raw + "31mb") == "a  31mb");
  }
}

TEST_CASE("console: terminals receive no control characters of names" *
          doctest::test_suite("terminal")) {
  const StderrTerminal terminal;
  terminal.Resize(40);
  TellLine("a\x1b[31m\nb\xc2\x9b");
  CHECK(terminal.Read() == "a [31m b  \r\n");
  ShowProgress("a\x1b]0;b\a", ": 1 %");
  CHECK(terminal.Read() == std::string(kErase) + "a ]0;b : 1 %");
  EraseProgress();
}

TEST_CASE("progress: the line shows the share and, after a second, the remaining time") {
  CHECK(Progress::State(43, 100, 0.5) == ": 43 %");
  CHECK(Progress::State(0, 100, 5) == ": 0 %");
  CHECK(Progress::State(25, 100, 4) == ": 25 %, 12 s left");
  CHECK(Progress::State(1, 3, 60) == ": 33 %, 2:00 min left");
  CHECK(Progress::State(100, 100, 60) == ": 100 %, 0 s left");
}

}  // namespace
}  // namespace starfocus::console_test
