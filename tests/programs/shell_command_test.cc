// SPDX-License-Identifier: Apache-2.0
// Runs shell commands, and checks that neither processes nor temporary folders remain.
#include "platform/shell_command.h"

#include <doctest/doctest.h>
#include <signal.h>
#include <sys/resource.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "platform/clock.h"
#include "platform/file.h"
#include "platform/helper/helper.h"
#include "platform/signal_cleanup.h"
#include "platform/temporary_folder.h"
#include "tests/support/child.h"
#include "tests/support/error_line.h"
#include "tests/support/temp_folder.h"

namespace starfocus::shell_command_test {
namespace {

std::string ErrorOf(const TempFolder& folder, const std::string& command, int seconds = 60) {
  return RunShellCommand("tool", command, seconds, folder.file("log")).line();
}

std::string Text(const std::string& path) {
  const Bytes bytes = ValueOf(ReadFile(path));
  return {bytes.begin(), bytes.end()};
}

// Waits up to 10 s until `done` returns true.
template <class Done>
bool Await(const Done& done) {
  for (const double start = Seconds(); Seconds() - start < 10; usleep(10000)) {
    if (done()) return true;
  }
  return false;
}

// Returns true if the process whose id is in the file `path` has ended.
bool HasEnded(const std::string& path) { return kill(std::stoi(Text(path)), 0) != 0; }

TEST_CASE("shell_command: the command gets its words, no input, and its log") {
  TempFolder folder;
  const std::string odd = folder.file("it's \"odd\" $HOME.txt");
  CHECK(ErrorOf(folder, "cat >" + ShellQuoted(odd) + "; echo out; echo err >&2") == "");
  CHECK(Text(odd) == "");
  CHECK(Text(folder.file("log")) == "out\nerr\n");
}

TEST_CASE("shell_command: a failure is reported with its end and the last lines of the log") {
  TempFolder folder;
  CHECK(ErrorOf(folder, "exit 3") == "tool: expected a command that succeeds, found exit code 3");
  CHECK(ErrorOf(folder, "printf '1\\n2\\n3\\n\\n4\\n'; exit 1") ==
        "tool: expected a command that succeeds, found exit code 1: 2 / 3 / 4");
  CHECK(Contains(ErrorOf(folder, "no-such-command-here"),
                 "found exit code 127 (command not found): "));
  CHECK(Contains(ErrorOf(folder, "kill -9 $$"), "found signal Killed"));
  const std::string found = "tool: expected a command that succeeds, found exit code 1: ";
  CHECK(ErrorOf(folder, "printf '10%%\\r90%%\\r\\nno model\\n'; exit 1") ==
        found + "10% / 90% / no model");
  const std::string fill = "head -c 100000 /dev/zero | tr '\\0' x; ";
  CHECK(ErrorOf(folder, fill + "exit 1") == found + std::string(297, 'x') + "...");
  CHECK(ErrorOf(folder, fill + "echo; echo end; exit 1") == found + "end");
  CHECK(ErrorOf(folder, "yes \303\244 | tr -d '\\n' | head -c 400; exit 1").size() ==
        found.size() + 296 + 3);
}

TEST_CASE("shell_command: the time limit and the end of the shell end all processes of the group") {
  TempFolder folder;
  const std::string background =
      "sleep 100 & echo $! >" + ShellQuoted(folder.file("id")) + "; echo late; ";
  CHECK(ErrorOf(folder, background + "wait", 1) ==
        "tool: expected a command that ends within 1 s, found one that still runs: late");
  CHECK(Await([&] { return HasEnded(folder.file("id")); }));
  CHECK(ErrorOf(folder, background) == "");
  CHECK(Await([&] { return HasEnded(folder.file("id")); }));
}

TEST_CASE("shell_command: the loss of the end of the shell is reported") {
  TempFolder folder;
  const auto before = signal(SIGCHLD, SIG_IGN);
  CHECK(ErrorOf(folder, "true", 5) == "cannot wait for /bin/sh: no child processes");
  signal(SIGCHLD, before);
}

TEST_CASE("shell_command: a signal ends the command and removes its folder") {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    TempFolder folder;
    setenv("TMPDIR", folder.path().c_str(), 1);
    const int status = EndBySignal(signal, [&](const auto& begun) {
      SignalCleanup::Install();
      TemporaryFolder own;
      if (own.Create() != "") _exit(1);
      std::thread command([&] {
        (void)RunShellCommand("tool", "echo $$ >" + ShellQuoted(folder.file("id")) + "; sleep 100",
                              60, own.path() + "/log");
      });
      Await([&] { return std::filesystem::exists(folder.file("id")); });
      Await([&] { return !Text(folder.file("id")).empty(); });
      if (begun()) command.join();
    });
    unsetenv("TMPDIR");
    CHECK(WIFSIGNALED(status));
    CHECK(WTERMSIG(status) == signal);
    CHECK(folder.count() == 1);
    CHECK(Await([&] { return HasEnded(folder.file("id")); }));
  }
}

TEST_CASE("temporary_folder: every signal removes the whole folder of a program without exec") {
  namespace fs = std::filesystem;
  for (const int signal : {SIGHUP, SIGINT, SIGQUIT, SIGALRM, SIGTERM, SIGUSR1, SIGUSR2, SIGXCPU}) {
    CAPTURE(signal);
    TempFolder folder, other;
    REQUIRE(WriteText(other.file("kept"), "text") == "");
    setenv("TMPDIR", folder.path().c_str(), 1);
    const int status = EndBySignal(signal, [&](const auto& begun) {
      constexpr rlimit kNoCore = {};
      setrlimit(RLIMIT_CORE, &kNoCore);
      ConfineDecoders();
      ConfineProgram();
      SignalCleanup::Install();
      TemporaryFolder own;
      if (own.Create() != "") _exit(1);
      std::string deep = own.path();
      for (int level = 0; level < 12; ++level) {
        deep += "/" + std::string(50, 'd');
        fs::create_directories(deep + "/empty");
        std::ofstream(deep + "/file") << "text";
      }
      for (int k = 0; k < 100; ++k) {  // more entries than fit into the buffer of the handler
        std::ofstream(own.path() + "/" + std::to_string(k)) << "text";
      }
      fs::create_directory_symlink(other.path(), own.path() + "/link");
      if (begun()) {
        for (;;) pause();
      }
    });
    unsetenv("TMPDIR");
    CHECK(WIFSIGNALED(status));
    CHECK(WTERMSIG(status) == signal);
    CHECK(folder.count() == 0);
    CHECK(other.count() == 1);
  }
}

TEST_CASE("temporary_folder: the folder is private, and is removed with its contents") {
  namespace fs = std::filesystem;
  std::string path;
  {
    TemporaryFolder folder;
    REQUIRE(folder.Create() == "");
    path = folder.path();
    CHECK(fs::status(path).permissions() == fs::perms::owner_all);
    fs::create_directories(path + "/a/b");
    REQUIRE(WriteText(path + "/a/b/file", "text") == "");
  }
  CHECK(!fs::exists(path));
  TempFolder folder;
  setenv("TMPDIR", folder.file("none").c_str(), 1);
  TemporaryFolder missing;
  CHECK(Contains(missing.Create(), "cannot create folder " + folder.file("none")));
  unsetenv("TMPDIR");
}

}  // namespace
}  // namespace starfocus::shell_command_test
