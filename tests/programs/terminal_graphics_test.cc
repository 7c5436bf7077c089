// SPDX-License-Identifier: Apache-2.0
// Tests how the answers of terminals are read, and that a signal restores the terminal.
#include "platform/terminal_graphics.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <termios.h>
#include <unistd.h>

#include <cstdlib>
#include <string>
#include <thread>

#include "platform/signal_cleanup.h"
#include "tests/support/child.h"
#include "tests/support/terminal.h"

namespace starfocus::terminal_graphics_test {
namespace {

TEST_CASE("terminal: an answer is complete when the device attributes have arrived") {
  const std::string whole = "\x1b_Gi=31;OK\x1b\\\x1b[4;600;800t\x1b[?2;0;1000;900S\x1b[?62;4;22c";
  for (size_t length = 0; length < whole.size(); ++length) {
    CHECK_FALSE(ReadTerminalAnswers(whole.substr(0, length)).done);
  }
  const TerminalAnswers answers = ReadTerminalAnswers("key" + whole + "key");
  CHECK(answers.done);
  CHECK(answers.kitty);
  CHECK(answers.sixel);
  CHECK(answers.attributes == "62;4;22");
  CHECK(answers.width == 800);
  CHECK(answers.height == 600);
  CHECK(answers.sixel_width == 1000);
  CHECK(answers.sixel_height == 900);
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

TEST_CASE("terminal: sixels need attribute 4, and kitty graphics need the answer OK") {
  for (const char* without : {"\x1b[?64;14;40c", "\x1b[?6c", "\x1b[?c", "\x1b[?44;24c"}) {
    CAPTURE(without);
    CHECK(ReadTerminalAnswers(without).done);
    CHECK_FALSE(ReadTerminalAnswers(without).sixel);
  }
  for (const char* with : {"\x1b[?4c", "\x1b[?4;6c", "\x1b[?62;4c"}) {
    CAPTURE(with);
    CHECK(ReadTerminalAnswers(with).sixel);
  }
  CHECK_FALSE(ReadTerminalAnswers("\x1b_Gi=31;ENOTSUP:no\x1b\\\x1b[?6c").kitty);
  CHECK(ReadTerminalAnswers("\x1b[4;123456;800t\x1b[?6c").width == 0);
  CHECK(ReadTerminalAnswers("\x1b[?2;3;0S\x1b[?6c").sixel_width == 0);
}

}  // namespace
}  // namespace starfocus::terminal_graphics_test
