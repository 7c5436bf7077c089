// SPDX-License-Identifier: Apache-2.0
#include "platform/shell_command.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <system_error>
#include <vector>

#include "platform/clock.h"
#include "platform/signal_cleanup.h"

extern char** environ;

namespace starfocus {
namespace {

void KillGroup(const void* group) { kill(-*static_cast<const pid_t*>(group), SIGKILL); }

// A running shell. The shell is the leader of a new process group.
class Shell {
 public:
  // Kills the process group. The shell must not have been waited for, because its process id, which
  // is the id of the group, would then be free for other processes.
  ~Shell() {
    if (!cleanup_.is_listed()) return;
    {
      const SignalCleanup::Turn turn;
      KillGroup(&pid_);
      cleanup_.Remove(turn);
    }
    waitpid(pid_, nullptr, 0);
  }

  // Starts the shell. Returns an errno value, or 0 on success.
  int Start(const std::string& command, const std::string& log) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(
        &attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
    posix_spawnattr_setpgroup(&attributes, 0);
    // The command must not inherit ignored signals: the program ignores SIGPIPE and SIGXFSZ, and a
    // caller may ignore SIGCHLD.
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, SIGPIPE);
    sigaddset(&signals, SIGXFSZ);
    sigaddset(&signals, SIGCHLD);
    posix_spawnattr_setsigdefault(&attributes, &signals);
    const char* arguments[] = {"sh", "-c", command.c_str(), nullptr};
    const SignalCleanup::Turn turn;
    posix_spawnattr_setsigmask(&attributes, &turn.before());
    const int failure = posix_spawn(&pid_, "/bin/sh", &actions, &attributes,
                                    const_cast<char**>(arguments), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    if (failure == 0) cleanup_.Add(turn, KillGroup, &pid_);
    return failure;
  }

  // Waits until the shell ends, but does not release its process id. Returns 0 on success,
  // ETIMEDOUT if the shell still runs after `seconds`, or another errno value.
  int Wait(int seconds, siginfo_t* end) {
    constexpr timespec kStep = {0, 20'000'000};  // 20 ms
    for (const double start = Seconds(); Seconds() - start < seconds; nanosleep(&kStep, nullptr)) {
      *end = {};
      const int failed = waitid(P_PID, static_cast<id_t>(pid_), end, WEXITED | WNOHANG | WNOWAIT);
      if (failed == 0 && end->si_pid == pid_) return 0;
      if (failed == 0 || errno == EINTR) continue;
      const int reason = errno;
      // The system may have given the process id to another process, which must not be killed.
      cleanup_.Remove(SignalCleanup::Turn());
      return reason;
    }
    return ETIMEDOUT;
  }

 private:
  pid_t pid_ = 0;
  SignalCleanup cleanup_;
};

// Shortens a line to at most 300 bytes. Does not split a character of UTF-8.
std::string Shortened(const std::string& line) {
  constexpr size_t kMostBytes = 300;
  if (line.size() <= kMostBytes) return line;
  size_t size = kMostBytes - 3;
  while (size > 0 && (line[size] & 0xc0) == 0x80) --size;
  return line.substr(0, size) + "...";
}

// Returns the last lines of a log, with a colon in front, or an empty string if the log is empty.
std::string LastLines(const std::string& path) {
  constexpr std::streamoff kMostBytes = 4096;
  constexpr size_t kMostLines = 3;
  std::ifstream log(path, std::ios::ate | std::ios::binary);
  const std::streamoff begin = std::max<std::streamoff>(0, log.tellg() - kMostBytes);
  log.seekg(begin);
  std::string text(std::istreambuf_iterator<char>(log), {});
  std::replace(text.begin(), text.end(), '\r', '\n');  // progress bars overwrite their line
  // The first line may be incomplete if bytes before it were not read.
  const size_t next = text.find('\n') + 1;
  if (begin > 0 && next < text.size()) text.erase(0, next);
  std::vector<std::string> lines;
  std::istringstream rows(text);
  for (std::string line; std::getline(rows, line);) {
    if (line.find_first_not_of(" \t") != std::string::npos) lines.push_back(Shortened(line));
  }
  std::string last;
  for (size_t k = lines.size() - std::min(kMostLines, lines.size()); k < lines.size(); ++k) {
    last += (last.empty() ? ": " : " / ") + lines[k];
  }
  return last;
}

std::string EndOf(const siginfo_t& end) {
  if (end.si_code != CLD_EXITED) return std::string("signal ") + strsignal(end.si_status);
  constexpr int kNotFound = 127;  // exit code of the shell
  return "exit code " + std::to_string(end.si_status) +
         (end.si_status == kNotFound ? " (command not found)" : "");
}

}  // namespace

std::string ShellQuoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

Error RunShellCommand(const std::string& where, const std::string& command, int seconds,
                      const std::string& log) {
  Shell shell;
  if (const int failure = shell.Start(command, log); failure != 0) {
    return Cannot("run", "/bin/sh", {failure, std::generic_category()});
  }
  siginfo_t end = {};
  const int failure = shell.Wait(seconds, &end);
  if (failure == ETIMEDOUT) {
    return Expected(where, "a command that ends within " + std::to_string(seconds) + " s",
                    "one that still runs" + LastLines(log));
  }
  if (failure != 0) return Cannot("wait for", "/bin/sh", {failure, std::generic_category()});
  if (end.si_code == CLD_EXITED && end.si_status == 0) return {};
  return Expected(where, "a command that succeeds", EndOf(end) + LastLines(log));
}

}  // namespace starfocus
