// SPDX-License-Identifier: Apache-2.0
#include "platform/helper/helper.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <new>
#include <thread>

#include "tests/support/error_line.h"

namespace starfocus::helper_test {
namespace {

constexpr HelperLimits kLimits = {uint64_t{1} << 30, 1};

bool HasHelpers() {
  ConfineDecoders();
  return DecodersAreConfined();
}

void PassNothing(Channel*) {}

// Runs `work` in a helper process that sends nothing, and returns the error.
std::string ErrorOf(const std::function<void()>& work, const HelperLimits& limits = kLimits) {
  return RunHelper("photo.jpg", limits, work, PassNothing).line();
}

// Returns the values of errno after each attempt, from a helper process.
std::vector<int> Attempt(const std::vector<std::function<bool()>>& attempts) {
  std::vector<int> codes(attempts.size(), -1);
  const Error error = RunHelper(
      "attempts", kLimits,
      [&] {
        for (size_t i = 0; i < attempts.size(); ++i) codes[i] = attempts[i]() ? 0 : errno;
      },
      [&](Channel* channel) { channel->List(&codes, [&](int* code) { channel->Value(code); }); });
  REQUIRE(error.line() == "");
  return codes;
}

TEST_CASE("helper: the result of a decoder arrives unchanged") {
  if (!HasHelpers()) return;
  Samples samples;
  samples.map = {700, 500, std::vector<float>(350000, NAN)};  // more than a part of a block
  samples.map.values[349999] = -2.5F;
  samples.largest = 65535;
  samples.larger_is_nearer = true;
  const Result<Samples> sent = Confined<Samples>("map", [&] { return Result<Samples>(samples); });
  REQUIRE(sent);
  CHECK(sent->map.width == 700);
  CHECK(sent->map.height == 500);
  REQUIRE(sent->map.values.size() == 350000);
  CHECK(std::isnan(sent->map.values[349998]));
  CHECK(sent->map.values[349999] == -2.5F);
  CHECK(sent->largest == 65535);
  CHECK(sent->larger_is_nearer);
  const Result<bool> failed =
      Confined<bool>("map", [&] { return Result<bool>(Expected("map", "a", "b")); });
  CHECK(failed.error().line() == "map: expected a, found b");
  CHECK(failed.error().kind() == ErrorKind::kInput);
}

TEST_CASE("helper: files, networks, programs and other processes are out of reach") {
  if (!HasHelpers()) return;
  const char* const arguments[] = {"/bin/true", nullptr};
  const std::vector<int> codes = Attempt({
      [] { return open("/dev/null", O_RDONLY) >= 0; },
      [] { return socket(AF_INET, SOCK_STREAM, 0) >= 0; },
      [] { return socket(AF_UNIX, SOCK_STREAM, 0) >= 0; },
      [&] { return execv("/bin/true", const_cast<char**>(arguments)) == 0; },
      [] { return kill(getppid(), 0) == 0; },
      [] { return fork() >= 0; },
      [] {
        return mmap(nullptr, 4096, PROT_READ | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) !=
               MAP_FAILED;
      },
      [] { return unlink("/nonexistent/file") == 0 || errno == ENOENT; },
  });
  CHECK(codes == std::vector<int>(8, EPERM));
}

TEST_CASE("helper: a confined program reads files, but starts no programs and uses no networks") {
  if (!HasHelpers()) return;
  const pid_t child = fork();
  if (child == 0) {
    ConfineProgram();
    const char* const arguments[] = {"/bin/true", nullptr};
    bool right = open("/dev/null", O_RDONLY) >= 0;
    right = right && socket(AF_INET, SOCK_STREAM, 0) < 0 && errno == EPERM;
    right = right && execv("/bin/true", const_cast<char**>(arguments)) < 0 && errno == EPERM;
    right = right && ErrorOf([] {}).empty();  // helper processes start as before
    _exit(right ? 5 : 6);
  }
  int status = 0;
  CHECK(waitpid(child, &status, 0) == child);
  CHECK(WEXITSTATUS(status) == 5);
}

TEST_CASE("helper: no open file of the program is left but the channel") {
  if (!HasHelpers()) return;
  const int file = open("/dev/null", O_RDONLY);
  const std::vector<int> codes = Attempt({[&] { return lseek(file, 0, SEEK_CUR) >= 0; },
                                          [] { return write(STDERR_FILENO, "", 0) >= 0; }});
  CHECK(codes == std::vector<int>(2, EBADF));
  close(file);
}

TEST_CASE("helper: decoders may start threads") {
  if (!HasHelpers()) return;
  CHECK(ErrorOf([] { std::thread([] {}).join(); }) == "");
}

TEST_CASE("helper: a decoder that crashes or exceeds a limit causes one error") {
  if (!HasHelpers()) return;
  const std::string crash =
      "photo.jpg: expected a file that can be decoded, found one that makes the decoder crash (";
  CHECK(ErrorOf([] { std::abort(); }) == crash + "Aborted)");
  CHECK(ErrorOf([] { raise(SIGKILL); }) == crash + "Killed)");
  CHECK(ErrorOf([] { _exit(0); }) == crash + "it sent no whole result)");
  volatile bool forever = true;
  CHECK(ErrorOf([&] {
          while (forever) continue;
        }) ==
        "photo.jpg: expected a file that can be decoded within 1 seconds of processor time, found "
        "one that takes longer");
  CHECK(ErrorOf([] { std::vector<char>(size_t{2} << 30).back() = 1; }) ==
        "photo.jpg: out of memory, cannot read it");
  CHECK(ErrorOf([] { throw std::length_error("length"); }) ==
        "photo.jpg: expected no internal error, found length");
}

TEST_CASE("helper: results that contradict themselves are rejected") {
  if (!HasHelpers()) return;
  const auto send = [](Image image) {
    return Confined<Image>("photo.jpg", [&] { return Result<Image>(image); }).error().line();
  };
  Image image(3, 2);
  CHECK(send(image) == "");
  image.width = 4;
  const std::string expected =
      "photo.jpg: expected a file that can be decoded, found one that makes the decoder crash (it "
      "sent no whole result)";
  CHECK(send(image) == expected);
  image.width = -3;
  image.height = -2;
  CHECK(send(image) == expected);
  image.width = image.height = 0;
  CHECK(send(image) == expected);
}

}  // namespace
}  // namespace starfocus::helper_test
