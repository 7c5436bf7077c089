// SPDX-License-Identifier: Apache-2.0
// Tests the lines of the programs on terminals of any width: lines never continue the progress
// line, the progress line never wraps, and no text contains control characters. Tests how the
// answers of terminals with graphics are read, and that a signal restores the terminal.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <string>
#include <thread>

#include "platform/console.h"
#include "platform/progress.h"
#include "platform/result.h"
#include "platform/signal_cleanup.h"
#include "platform/terminal_graphics.h"
#include "platform/text.h"
#include "tests/support/processes.h"

namespace starfocus::terminal_test {
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
  TellLine("a\x1b[31m\nb\xc2\x9b");
  CHECK(terminal.Read() == std::string(kErase) + "a [31m b  \r\nrefocusing: 43 %");
  ShowProgress("a\x1b]0;b\a", ": 1 %");
  CHECK(terminal.Read() == std::string(kErase) + "a ]0;b : 1 %");
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
  const struct {
    const char* text;
    int columns;
    const char* fits;
  } rows[] = {
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
      {"o\xcc\x81o\xcc\x81", 2, "o\xcc\x81o\xcc\x81"},  // combining accents
      {"o\xcc\x81o\xcc\x81xyz", 4, "o\xcc\x81..."},
      {"\xff\xfewxyz", 5, "\xff\xfe..."},
  };
  for (const auto& one : rows) {
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

TEST_CASE("progress: the line shows the share and, after a second, the remaining time") {
  CHECK(Progress::State(43, 100, 0.5) == ": 43 %");
  CHECK(Progress::State(0, 100, 5) == ": 0 %");
  CHECK(Progress::State(25, 100, 4) == ": 25 %, 12 s left");
  CHECK(Progress::State(1, 3, 60) == ": 33 %, 2:00 min left");
  CHECK(Progress::State(100, 100, 60) == ": 100 %, 0 s left");
}

// Returns what a terminal has answered: the graphics, the attributes, and the sizes of the terminal
// and of sixels, or "" if the answer is incomplete.
std::string Read(const std::string& answer) {
  const TerminalAnswers read = ReadTerminalAnswers(answer);
  const auto size = [](int width, int height) {
    return " " + std::to_string(width) + "x" + std::to_string(height);
  };
  return !read.done ? ""
                    : std::string(read.kitty ? "kitty " : "") + (read.sixel ? "sixel " : "") +
                          read.attributes + size(read.width, read.height) +
                          size(read.sixel_width, read.sixel_height);
}

TEST_CASE(
    "terminal: an answer is complete with the device attributes, sixels need attribute 4, and "
    "kitty "
    "graphics need the answer OK") {
  const std::string whole = "\x1b_Gi=31;OK\x1b\\\x1b[4;600;800t\x1b[?2;0;1000;900S\x1b[?62;4;22c";
  for (size_t length = 0; length < whole.size(); ++length)
    CHECK(Read(whole.substr(0, length)) == "");
  for (const auto& [answer, read] :
       {std::pair{"key" + whole + "key", "kitty sixel 62;4;22 800x600 1000x900"},
        {"\x1b[?64;14;40c", "64;14;40 0x0 0x0"},
        {"\x1b[?6c", "6 0x0 0x0"},
        {"\x1b[?c", " 0x0 0x0"},
        {"\x1b[?44;24c", "44;24 0x0 0x0"},
        {"\x1b[?4c", "sixel 4 0x0 0x0"},
        {"\x1b[?4;6c", "sixel 4;6 0x0 0x0"},
        {"\x1b[?62;4c", "sixel 62;4 0x0 0x0"},
        {"\x1b_Gi=31;ENOTSUP:no\x1b\\\x1b[?6c", "6 0x0 0x0"},
        {"\x1b[4;123456;800t\x1b[?6c", "6 0x0 0x0"},
        {"\x1b[?2;3;0S\x1b[?6c", "6 0x0 0x0"}}) {
    CHECK(Read(answer) == read);
  }
}

TEST_CASE("terminal: a signal during the query restores the echo" *
          doctest::test_suite("terminal")) {
  const int terminal = OpenPseudoterminal();
  const int program = open(ptsname(terminal), O_RDWR | O_NOCTTY);
  REQUIRE(program >= 0);
  const auto echoes = [program] {
    termios mode = {};
    return tcgetattr(program, &mode) == 0 && (mode.c_lflag & ECHO) != 0;
  };
  REQUIRE(echoes());
  const int status = EndBySignal(SIGINT, [&](const auto& begun) {
    SignalCleanup::Install();
    dup2(program, STDIN_FILENO);
    dup2(program, STDOUT_FILENO);
    std::thread query([] { (void)FindGraphicsTerminal("--show"); });
    for (int i = 0; i < 1000 && echoes(); ++i) usleep(1000);
    const bool is_quiet = !echoes();
    if (begun()) query.join();
    if (!is_quiet) _exit(1);
  });
  CHECK(WIFSIGNALED(status));
  CHECK(echoes());
  close(program);
  close(terminal);
}

}  // namespace
}  // namespace starfocus::terminal_test
