// SPDX-License-Identifier: Apache-2.0
// Runs child processes that are ended by a signal, and programs on a pseudoterminal that answers
// queries as a terminal emulator would.
#ifndef STARFOCUS_TESTS_SUPPORT_PROCESSES_H_
#define STARFOCUS_TESTS_SUPPORT_PROCESSES_H_

#include <doctest/doctest.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <string>

namespace starfocus {

// Starts a process that calls `work`. Sends `signal` to the process as soon as `work` has reported
// its start, and returns the exit status of the process.
template <class Work>
int EndBySignal(int signal, const Work& work) {
  int ends[2];
  REQUIRE(pipe(ends) == 0);
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    ::signal(signal, SIG_DFL);  // The parent may ignore the signal, as nohup does.
    work([&] { return write(ends[1], "x", 1) == 1; });
    _exit(0);
  }
  char byte = 0;
  REQUIRE(read(ends[0], &byte, 1) == 1);
  REQUIRE(kill(child, signal) == 0);
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  close(ends[0]);
  close(ends[1]);
  return status;
}

}  // namespace starfocus

namespace starfocus {

struct TerminalRun {
  int code = -1;    // exit code, or -1 if a signal ended the program
  std::string out;  // everything that the program wrote to the terminal
  bool restored =
      false;  // true if the terminal echoes and reads lines after the program, as before
};

// Opens the controlling side of a new pseudoterminal. Where /dev/pts is not mounted, as in some
// chroots, the test case fails with a message for which ctest lists the suite `terminal` as
// skipped.
inline int OpenPseudoterminal() {
  const int controller = posix_openpt(O_RDWR | O_NOCTTY);
  const bool exists = controller >= 0 && grantpt(controller) == 0 && unlockpt(controller) == 0 &&
                      access(ptsname(controller), F_OK) == 0;
  REQUIRE_MESSAGE(exists, "SKIPPED: this machine has no pseudoterminals; is /dev/pts mounted?");
  return controller;
}

// Connects standard input and output of this process to a terminal, and runs a shell command.
[[noreturn]] inline void RunOnTerminal(const std::string& name, const std::string& command) {
  setsid();
  const int terminal = open(name.c_str(), O_RDWR);
  const bool ready = ioctl(terminal, TIOCSCTTY, 0) == 0 && dup2(terminal, STDIN_FILENO) >= 0 &&
                     dup2(terminal, STDOUT_FILENO) >= 0;
  if (ready) execl("/bin/sh", "sh", "-c", command.c_str(), static_cast<char*>(nullptr));
  _exit(126);
}

// Runs a shell command on a terminal of the given size. When the output ends with `query`, the
// terminal sends `answer`.
inline TerminalRun CallOnTerminal(const std::string& command, const winsize& size,
                                  const std::string& query, const std::string& answer) {
  const int controller = OpenPseudoterminal();
  REQUIRE(ioctl(controller, TIOCSWINSZ, &size) == 0);
  const std::string name = ptsname(controller);
  const int kept = open(name.c_str(), O_RDWR | O_NOCTTY);  // keeps the terminal after the program
  REQUIRE(kept >= 0);
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) RunOnTerminal(name, command);
  TerminalRun run;
  int status = 0;
  for (bool ended = false;;) {
    pollfd output = {controller, POLLIN, 0};
    if (poll(&output, 1, 20) > 0) {
      char buffer[4096];
      const ssize_t got = read(controller, buffer, sizeof(buffer));
      run.out.append(buffer, got > 0 ? size_t(got) : 0);
      const size_t begin = run.out.size() - std::min(run.out.size(), query.size());
      if (run.out.compare(begin, std::string::npos, query) == 0 && !answer.empty()) {
        REQUIRE(write(controller, answer.data(), answer.size()) == ssize_t(answer.size()));
      }
    } else if (ended) {
      break;
    } else {
      ended = waitpid(child, &status, WNOHANG) == child;
    }
  }
  termios mode;
  run.restored =
      tcgetattr(kept, &mode) == 0 && (mode.c_lflag & ICANON) != 0 && (mode.c_lflag & ECHO) != 0;
  close(kept);
  close(controller);
  if (WIFEXITED(status)) run.code = WEXITSTATUS(status);
  return run;
}

}  // namespace starfocus

#endif  // STARFOCUS_TESTS_SUPPORT_PROCESSES_H_
