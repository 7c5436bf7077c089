// SPDX-License-Identifier: Apache-2.0
// Tests files and folders that the programs read and write, the lines of errors, and the commands
// that the programs run: neither processes nor temporary files and folders remain.
#include "platform/file.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "platform/clock.h"
#include "platform/folder.h"
#include "platform/helper/helper.h"
#include "platform/problem.h"
#include "platform/shell_command.h"
#include "platform/signal_cleanup.h"
#include "platform/temporary_file.h"
#include "platform/temporary_folder.h"
#include "starfocus/starfocus.h"
#include "tests/support/config.h"
#include "tests/support/error_line.h"
#include "tests/support/processes.h"
#include "tests/support/temp_folder.h"

namespace starfocus::file_test {
namespace {

namespace fs = std::filesystem;

Bytes FromText(const std::string& text) { return Bytes(text.begin(), text.end()); }

std::string Read(const std::string& path) {
  const Bytes bytes = ValueOf(ReadFile(path));
  return std::string(bytes.begin(), bytes.end());
}

// Returns the line of an error, with F for the path of the folder.
std::string LineIn(const TempFolder& folder, const Error& error) {
  std::string line = error.line();
  const size_t size = folder.path().size();
  for (size_t at; (at = line.find(folder.path())) != std::string::npos;)
    line.replace(at, size, "F");
  return line;
}

TEST_CASE("file: the message of an error is one line") {
  CHECK(Expected("a\nb", "c", "d\te") == "a b: expected c, found d e");
  CHECK(Cannot("read", "a\nb", "c") == "cannot read a b: c");
}

// Returns the line that users see if a call of the library is rejected.
std::string Line(starfocus_status status, const starfocus_problem* problem) {
  return Describe(status, problem).text;
}

TEST_CASE(
    "problem: the line names the field with its range and value, if the call has stored them") {
  starfocus_problem problem = {};
  test::Config config;
  size_t bytes = 0;
  const std::string range = ": a field or an argument is outside its range ";
  const auto rejected = [&](size_t* size) {
    return Line(starfocus_workspace_size(&config, size, &problem), &problem);
  };
  CHECK(rejected(&bytes) == "width" + range + "(expected 1 to 65535, found 0)");
  config.width = config.height = 8;
  config.views = 2;
  config.positions[1] = {0, 1.5};
  CHECK(rejected(&bytes) == "positions[1].v" + range + "(expected -1 to 1, found 1.5)");
  CHECK(rejected(nullptr) == "bytes: a required pointer is null (expected not null)");
  problem = {STARFOCUS_ERROR_DISPARITY, 0, "disparity", "-1 to 1", 2.5, -1, 1, 7, 3};
  CHECK(Contains(Line(STARFOCUS_ERROR_DISPARITY, &problem), "-1 to 1, found 2.5 at (7, 3))"));
  problem = {STARFOCUS_ERROR_RANGE, 0, "width", "1", std::nan(""), 0, 0, -1, -1};
  CHECK(Line(STARFOCUS_ERROR_RANGE, &problem) == "width" + range + "(expected 1)");
  CHECK(Line(STARFOCUS_ERROR_MEMORY, &problem) == "out of memory");
  CHECK(Line(STARFOCUS_ERROR_RANGE, nullptr) == starfocus_status_string(STARFOCUS_ERROR_RANGE));
  problem.field = "";
  CHECK(Line(STARFOCUS_ERROR_RANGE, &problem) == starfocus_status_string(STARFOCUS_ERROR_RANGE));
}

TEST_CASE("file: an error line names the cause of the error") {
  TempFolder folder;
  const auto file = [&](const std::string& name) { return folder.file(name); };
  const auto check = [&](const Error& error, const std::string& line) {
    CHECK(LineIn(folder, error) == line);
  };
  check(ReadFile(folder.path()).error(), "cannot read F: it is a folder");
  check(ReadFile(file("a")).error(), "cannot read F/a: no such file or directory");
  check(CheckOutputPath(folder.path()), "cannot write F: it is a folder");
  check(CheckOutputPath(file("a/b")), "cannot write F/a/b: folder F/a does not exist");
  REQUIRE(WriteFile(file("a"), FromText("x")) == "");
  check(CheckOutputPath(file("a/b")), "cannot write F/a/b: F/a is not a folder");
  check(OutputFolder().Create(file("a")), "cannot create folder F/a: a file of that name exists");
  check(OutputFolder().Create(file("a/b")), "cannot create folder F/a/b: not a directory");
  {
    OutputFolder made, again;
    CHECK(made.Create(folder.file("b/c/d/")) == "");
    CHECK(again.Create(folder.file("b/c")) == "");
    REQUIRE(WriteFile(folder.file("b/file"), {}) == "");
    CHECK(fs::is_directory(folder.file("b/c/d")));
  }
  // Only the folders that are empty and that the object made are removed.
  CHECK(!fs::exists(folder.file("b/c")));
  CHECK(fs::is_directory(folder.file("b")));
  fs::remove(folder.file("b/file"));
  CHECK(OutputFolder().Create(folder.file("b")) == "");
  CHECK(fs::is_directory(folder.file("b")));
  if (geteuid() == 0) return;  // the user root may write to any folder
  REQUIRE(chmod(folder.file("a").c_str(), 0) == 0);
  REQUIRE(chmod(folder.file("b").c_str(), 0500) == 0);
  check(ReadFile(file("a")).error(), "cannot read F/a: permission denied");
  check(OutputFolder().Create(file("b/d")), "cannot create folder F/b/d: permission denied");
  check(CheckOutputPath(file("b/d")), "cannot write into folder F/b: permission denied");
  REQUIRE(chmod(folder.file("b").c_str(), 0700) == 0);
}

TEST_CASE("file: devices and pipes are rejected without waiting, and limits apply to files") {
  TempFolder folder;
  REQUIRE(mkfifo(folder.file("waits").c_str(), 0600) == 0);
  for (const std::string& path :
       {std::string("/dev/zero"), std::string("/dev/null"), folder.file("waits")}) {
    if (!fs::exists(path)) continue;
    for (const Error& error :
         {ReadFile(path).error(), ReadSmallFile(path).error(), CheckPlainFile(path)}) {
      CHECK(error == "cannot read " + path + ": it is a device or pipe");
    }
  }
  // The function that opens the file reports that it is absent.
  CHECK(CheckPlainFile(folder.file("none")) == "");
  REQUIRE(WriteFile(folder.file("most"), Bytes(kMostSmallBytes)) == "");
  CHECK(CheckPlainFile(folder.file("most")) == "");
  CHECK(ValueOf(ReadSmallFile(folder.file("most"))).size() == kMostSmallBytes);
  REQUIRE(WriteFile(folder.file("more"), Bytes(kMostSmallBytes + 1)) == "");
  const std::string large = "F/more: the file is too large (expected at most ";
  CHECK(LineIn(folder, ReadSmallFile(folder.file("more")).error()) ==
        large + "1048576 bytes, found 1048577)");
  CHECK(ReadFile(folder.file("more")) == "");
  // The file is sparse, so that it occupies little disk space.
  REQUIRE(truncate(folder.file("more").c_str(), (off_t{1} << 31) + 1) == 0);
  CHECK(LineIn(folder, ReadFile(folder.file("more")).error()) ==
        large + "2147483648 bytes, found 2147483649)");
}

TEST_CASE("file: CheckOutputPath and WriteFile reject a read-only file") {
  TempFolder folder;
  const std::string path = folder.file("a");
  REQUIRE(WriteFile(path, FromText("old")) == "");
  fs::create_symlink("a", folder.file("link"));
  REQUIRE(chmod(path.c_str(), 0444) == 0);
  for (const std::string& name : {path, folder.file("link")}) {
    CHECK(Contains(CheckOutputPath(name), "read-only"));
    CHECK(Contains(WriteFile(name, FromText("new")), "read-only"));
  }
  CHECK(Read(path) == "old");
  CHECK(folder.count() == 2);
}

// Runs `work` in a process that cleans up at signals, and ends the process by a signal.
template <class Work>
void CheckEnd(int signal, const Work& work) {
  CAPTURE(signal);
  const int status = EndBySignal(signal, [&](const auto& begun) {
    constexpr rlimit kNoCore = {};
    setrlimit(RLIMIT_CORE, &kNoCore);
    SignalCleanup::Install();
    work(begun);
  });
  CHECK(WIFSIGNALED(status));
  CHECK(WTERMSIG(status) == signal);
}

constexpr int kSignals[] = {SIGHUP, SIGINT, SIGQUIT, SIGALRM, SIGTERM, SIGUSR1, SIGUSR2, SIGXCPU};

TEST_CASE("file: signals that end the program leave no temporary file and no empty folder") {
  for (const int signal : kSignals) {
    TempFolder folder;
    CheckEnd(signal, [&](const auto& begun) {
      OutputFolder output;
      if (output.Create(folder.file("a/b")) != "") _exit(1);
      TemporaryFile one(folder.path()), other(folder.file("a/b"));
      while (folder.count() == 2 && begun()) pause();
    });
    CHECK(folder.count() == 0);
  }
}

TEST_CASE("file: a signal during concurrent writes leaves only complete files") {
  const Bytes bytes(300000, 7);
  for (int attempt = 0; attempt < 20; ++attempt) {
    TempFolder folder;
    CheckEnd(SIGTERM, [&](const auto& begun) {
      std::vector<std::thread> threads;
      for (int t = 0; t < 3; ++t) {
        threads.emplace_back([&, t] {
          for (int i = 0;; ++i) {
            if (WriteFile(folder.file(std::to_string(t)), bytes) != "") _exit(1);
            if (i == attempt && t == 0) begun();
          }
        });
      }
      for (;;) pause();
    });
    CHECK(folder.count() <= 3);
    for (const auto& entry : fs::directory_iterator(folder.path())) {
      CHECK(fs::file_size(entry.path()) == bytes.size());
    }
  }
}

TEST_CASE("file: an ignored signal stays ignored") {
  int code = -1;
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    signal(SIGHUP, SIG_IGN);
    SignalCleanup::Install();
    raise(SIGHUP);
    _exit(5);
  }
  REQUIRE(waitpid(child, &code, 0) == child);
  CHECK(WIFEXITED(code));
  CHECK(WEXITSTATUS(code) == 5);
}

std::string ErrorOf(const TempFolder& folder, const std::string& command, int seconds = 60) {
  return RunShellCommand("tool", command, seconds, folder.file("log")).line();
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
bool HasEnded(const std::string& path) { return kill(std::stoi(Read(path)), 0) != 0; }

TEST_CASE("shell_command: the command gets its words, no input, and its log") {
  TempFolder folder;
  const std::string odd = folder.file("it's \"odd\" $HOME.txt");
  CHECK(ErrorOf(folder, "cat >" + ShellQuoted(odd) + "; echo out; echo err >&2") == "");
  CHECK(Read(odd) == "");
  CHECK(Read(folder.file("log")) == "out\nerr\n");
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
    CheckEnd(signal, [&](const auto& begun) {
      TemporaryFolder own;
      if (own.Create() != "") _exit(1);
      std::thread command([&] {
        (void)RunShellCommand("tool", "echo $$ >" + ShellQuoted(folder.file("id")) + "; sleep 100",
                              60, own.path() + "/log");
      });
      Await([&] { return fs::exists(folder.file("id")); });
      Await([&] { return !Read(folder.file("id")).empty(); });
      if (begun()) command.join();
    });
    unsetenv("TMPDIR");
    CHECK(folder.count() == 1);
    CHECK(Await([&] { return HasEnded(folder.file("id")); }));
  }
}

TEST_CASE("temporary_folder: every signal removes the whole folder of a program without exec") {
  for (const int signal : kSignals) {
    TempFolder folder, other;
    REQUIRE(WriteText(other.file("kept"), "text") == "");
    setenv("TMPDIR", folder.path().c_str(), 1);
    CheckEnd(signal, [&](const auto& begun) {
      ConfineDecoders();
      ConfineProgram();
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
      while (begun()) pause();
    });
    unsetenv("TMPDIR");
    CHECK(folder.count() == 0);
    CHECK(other.count() == 1);
  }
}

TEST_CASE("temporary_folder: the folder is private, and is removed with its contents") {
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
}  // namespace starfocus::file_test
