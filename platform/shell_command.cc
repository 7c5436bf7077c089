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
#include <system_error>
#include <vector>

#include "platform/clock.h"
#include "platform/signal_cleanup.h"

extern char** environ;

namespace starfocus {
namespace {

void KillGroup(const void* group) { kill(-*static_cast<const pid_t*>(group), SIGKILL); }

// A running shell, which leads a process group of its own.
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
    // The program ignores SIGPIPE, which the command must not inherit.
    sigset_t pipe;
    sigemptyset(&pipe);
    sigaddset(&pipe, SIGPIPE);
    posix_spawnattr_setsigdefault(&attributes, &pipe);
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

  // Waits until the shell ends, but does not release its process id. Returns false if the shell
  // still runs after `seconds`.
  bool Wait(int seconds, siginfo_t* end) const {
    constexpr timespec kStep = {0, 20'000'000};  // 20 ms
    for (const double start = Seconds(); Seconds() - start < seconds; nanosleep(&kStep, nullptr)) {
      *end = {};
      waitid(P_PID, static_cast<id_t>(pid_), end, WEXITED | WNOHANG | WNOWAIT);
      if (end->si_pid == pid_) return true;
    }
    return false;
  }

 private:
  pid_t pid_ = 0;
  SignalCleanup cleanup_;
};

// Returns the last lines of a log, with a colon in front, or an empty string if the log is empty.
std::string LastLines(const std::string& path) {
  constexpr std::streamoff kMostBytes = 4096;
  constexpr size_t kMostLines = 3;
  std::ifstream log(path, std::ios::ate | std::ios::binary);
  const std::streamoff size = log.tellg();
  log.seekg(std::max<std::streamoff>(0, size - kMostBytes));
  std::vector<std::string> lines;
  for (std::string line; std::getline(log, line);) {
    if (line.find_first_not_of(" \t\r") != std::string::npos) lines.push_back(line);
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
  if (!shell.Wait(seconds, &end)) {
    return Expected(where, "a command that ends within " + std::to_string(seconds) + " s",
                    "one that still runs" + LastLines(log));
  }
  if (end.si_code == CLD_EXITED && end.si_status == 0) return {};
  return Expected(where, "a command that succeeds", EndOf(end) + LastLines(log));
}

}  // namespace starfocus
