// SPDX-License-Identifier: Apache-2.0
#include "platform/file.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "platform/folder.h"
#include "platform/temporary_file.h"
#include "tests/support/child.h"
#include "tests/support/error_line.h"
#include "tests/support/temp_folder.h"

namespace starfocus::file_test {
namespace {

namespace fs = std::filesystem;

Bytes FromText(const std::string& text) { return Bytes(text.begin(), text.end()); }

std::string Read(const std::string& path) {
  const Bytes bytes = ValueOf(ReadFile(path));
  return std::string(bytes.begin(), bytes.end());
}

mode_t Mode(const std::string& path) {
  struct stat status;
  REQUIRE(stat(path.c_str(), &status) == 0);
  return status.st_mode & 07777;
}

TEST_CASE("file: writing through a link keeps the link") {
  TempFolder folder;
  REQUIRE(WriteFile(folder.file("real"), FromText("old")) == "");
  fs::create_symlink("real", folder.file("link"));
  REQUIRE(WriteFile(folder.file("link"), FromText("new")) == "");
  CHECK(fs::is_symlink(folder.file("link")));
  CHECK(Read(folder.file("real")) == "new");
}

TEST_CASE("file: the message of an error is one line") {
  CHECK(Expected("a\nb", "c", "d\te") == "a b: expected c, found d e");
  CHECK(Cannot("read", "a\nb", "c") == "cannot read a b: c");
}

TEST_CASE("file: an error line names the cause of the error") {
  TempFolder folder;
  CHECK(ReadFile(folder.path()) == "cannot read " + folder.path() + ": it is a folder");
  CHECK(ReadFile(folder.file("a")) ==
        "cannot read " + folder.file("a") + ": no such file or directory");
  CHECK(CheckOutputPath(folder.path()) == "cannot write " + folder.path() + ": it is a folder");
  CHECK(CheckOutputPath(folder.file("a/b")) ==
        "cannot write " + folder.file("a/b") + ": folder " + folder.file("a") + " does not exist");
  REQUIRE(WriteFile(folder.file("a"), FromText("x")) == "");
  CHECK(CheckOutputPath(folder.file("a/b")) ==
        "cannot write " + folder.file("a/b") + ": " + folder.file("a") + " is not a folder");
  CHECK(OutputFolder().Create(folder.file("a")) ==
        "cannot create folder " + folder.file("a") + ": a file of that name exists");
  CHECK(OutputFolder().Create(folder.file("a/b")) ==
        "cannot create folder " + folder.file("a/b") + ": not a directory");
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
  CHECK(ReadFile(folder.file("a")) == "cannot read " + folder.file("a") + ": permission denied");
  CHECK(OutputFolder().Create(folder.file("b/d")) ==
        "cannot create folder " + folder.file("b/d") + ": permission denied");
  CHECK(CheckOutputPath(folder.file("b/d")) ==
        "cannot write into folder " + folder.file("b") + ": permission denied");
  REQUIRE(chmod(folder.file("b").c_str(), 0700) == 0);
}

TEST_CASE("file: devices and endless pipes are not read, and a limit applies to small files") {
  TempFolder folder;
  const auto device = [](const char* path) {
    return std::string("cannot read ") + path + ": it is a device or pipe";
  };
  for (const char* path : {"/dev/zero", "/dev/null"}) {
    if (!fs::exists(path)) continue;
    CHECK(ReadFile(path) == device(path));
    CHECK(ReadSmallFile(path) == device(path));
  }
  REQUIRE(WriteFile(folder.file("most"), Bytes(kMostSmallBytes)) == "");
  CHECK(ValueOf(ReadSmallFile(folder.file("most"))).size() == kMostSmallBytes);
  REQUIRE(WriteFile(folder.file("more"), Bytes(kMostSmallBytes + 1)) == "");
  CHECK(ReadSmallFile(folder.file("more")) ==
        folder.file("more") +
            ": the file is too large (expected at most 1048576 bytes, found 1048577)");
  CHECK(ReadFile(folder.file("more")) == "");
  // The file is sparse, so that it occupies little disk space.
  REQUIRE(truncate(folder.file("more").c_str(), (off_t{1} << 31) + 1) == 0);
  CHECK(ReadFile(folder.file("more")) ==
        folder.file("more") +
            ": the file is too large (expected at most 2147483648 bytes, found 2147483649)");
  // A pipe on standard input is read completely if it ends, and otherwise up to the limit.
  for (const bool endless : {false, true}) {
    const std::string path = folder.file(endless ? "endless" : "pipe");
    REQUIRE(mkfifo(path.c_str(), 0600) == 0);
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
      ::signal(SIGPIPE, SIG_DFL);
      const int handle = open(path.c_str(), O_WRONLY);
      const char text[1000] = {};
      while (write(handle, text, sizeof(text)) > 0 && endless) {
      }
      _exit(0);
    }
    const int own = dup(STDIN_FILENO), pipe = open(path.c_str(), O_RDONLY);
    REQUIRE(dup2(pipe, STDIN_FILENO) == STDIN_FILENO);
    const Result<Bytes> read = ReadSmallFile("-");
    REQUIRE(dup2(own, STDIN_FILENO) == STDIN_FILENO);
    close(pipe);
    close(own);
    if (endless) {
      CHECK(read == "-: the file is too large (expected at most 1048576 bytes, found more)");
    } else {
      CHECK(read == "");
      CHECK(read->size() == 1000);
    }
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
  }
}

TEST_CASE("file: a replaced file keeps its permissions") {
  TempFolder folder;
  const std::string path = folder.file("a");
  for (const mode_t mode : {0600, 0640, 0666, 0755}) {
    REQUIRE(WriteFile(path, FromText("old")) == "");
    REQUIRE(chmod(path.c_str(), mode) == 0);
    REQUIRE(WriteFile(path, FromText("new")) == "");
    CHECK(Mode(path) == mode);
    CHECK(Read(path) == "new");
  }
  CHECK(folder.count() == 1);
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

TEST_CASE("file: CheckOutputPath and WriteFile accept the longest file name, and no longer name") {
  TempFolder folder;
  const long longest = pathconf(folder.path().c_str(), _PC_NAME_MAX);
  REQUIRE(longest > 200);
  for (const long length : {longest - 20, longest - 11, longest}) {
    const std::string path = folder.file(std::string(size_t(length), 'n'));
    CHECK(CheckOutputPath(path) == "");
    CHECK(WriteFile(path, FromText("x")) == "");
  }
  const std::string path = folder.file(std::string(size_t(longest) + 1, 'n'));
  CHECK(CheckOutputPath(path) != "");
  CHECK(WriteFile(path, FromText("x")) != "");
  CHECK(folder.count() == 3);
}

TEST_CASE("file: pipes and devices are rejected without waiting") {
  TempFolder folder;
  REQUIRE(mkfifo(folder.file("pipe").c_str(), 0600) == 0);
  REQUIRE(WriteFile(folder.file("file"), {}) == "");
  CHECK(CheckPlainFile(folder.file("pipe")) != "");
  CHECK(CheckPlainFile("/dev/null") != "");
  CHECK(CheckPlainFile(folder.file("file")) == "");
  // The function that opens the file reports the error.
  CHECK(CheckPlainFile(folder.file("none")) == "");
  for (const std::string& path : {folder.file("pipe"), std::string("/dev/zero")}) {
    CHECK(ReadFile(path) == "cannot read " + path + ": it is a device or pipe");
    CHECK(ReadSmallFile(path) == "cannot read " + path + ": it is a device or pipe");
  }
}

TEST_CASE("file: a link to an absent file is written through, like a link to a file") {
  TempFolder folder;
  fs::create_directory(folder.file("in"));
  fs::create_symlink("in/second", folder.file("first"));
  fs::create_symlink(folder.file("in/third"), folder.file("in/second"));
  for (const char* text : {"absent", "present"}) {
    CHECK(CheckOutputPath(folder.file("first")) == "");
    REQUIRE(WriteFile(folder.file("first"), FromText(text)) == "");
    CHECK(fs::is_symlink(folder.file("first")));
    CHECK(fs::is_symlink(folder.file("in/second")));
    CHECK(Read(folder.file("in/third")) == text);
  }
  fs::create_symlink("loop", folder.file("loop"));
  CHECK(CheckOutputPath(folder.file("loop")) != "");
}

TEST_CASE("file: WriteFile returns an error if the device is full") {
  if (!fs::exists("/dev/full")) return;
  CHECK(WriteFile("/dev/full", FromText("x")) != "");
}

TEST_CASE("file: signals that end the program leave no temporary file and no empty folder") {
  for (const int signal : {SIGHUP, SIGINT, SIGQUIT, SIGALRM, SIGTERM, SIGUSR1, SIGUSR2, SIGXCPU}) {
    TempFolder folder;
    const int status = EndBySignal(signal, [&](const auto& begun) {
      constexpr rlimit kNoCore = {};
      setrlimit(RLIMIT_CORE, &kNoCore);
      SignalCleanup::Install();
      OutputFolder output;
      if (output.Create(folder.file("a/b")) != "") _exit(1);
      TemporaryFile one(folder.path()), other(folder.file("a/b"));
      if (folder.count() == 2 && begun()) {
        for (;;) pause();
      }
    });
    CHECK(WIFSIGNALED(status));
    CHECK(WTERMSIG(status) == signal);
    CHECK(folder.count() == 0);
  }
}

TEST_CASE("file: a signal during concurrent writes leaves only complete files") {
  const Bytes bytes(300000, 7);
  for (int attempt = 0; attempt < 20; ++attempt) {
    TempFolder folder;
    const int status = EndBySignal(SIGTERM, [&](const auto& begun) {
      SignalCleanup::Install();
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
    CHECK(WIFSIGNALED(status));
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

}  // namespace
}  // namespace starfocus::file_test
