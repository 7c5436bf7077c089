// SPDX-License-Identifier: Apache-2.0
// Tests the process that decodes files: limits of time and memory, crashes, and what it may do.
#include "platform/helper/helper.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cmath>
#include <cstdlib>
#include <mutex>
#include <new>
#include <optional>
#include <thread>
#include <tuple>
#include <utility>

#include "platform/clock.h"
#include "platform/helper/decoder_threads.h"
#include "tests/support/error_line.h"

namespace starfocus::helper_test {
namespace {

constexpr HelperLimits kLimits = {uint64_t{1} << 30, 1, 20, 10};

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
  samples.is_wide = samples.is_alpha = samples.larger_is_nearer = true;
  const Result<Samples> sent = Confined<Samples>("map", [&] { return Result<Samples>(samples); });
  REQUIRE(sent);
  CHECK(std::tuple(sent->map.width, sent->map.height, sent->largest) ==
        std::tuple(700, 500, 65535));
  CHECK((sent->is_wide && sent->is_alpha && sent->larger_is_nearer));
  REQUIRE(sent->map.values.size() == 350000);
  CHECK(std::isnan(sent->map.values[349998]));
  CHECK(sent->map.values[349999] == -2.5F);
  const Result<bool> failed =
      Confined<bool>("map", [&] { return Result<bool>(Expected("map", "a", "b")); });
  CHECK(failed.error().line() == "map: expected a, found b");
  CHECK(failed.error().kind() == ErrorKind::kInput);
}

TEST_CASE("helper: a picture of 16 bits arrives unchanged, and wrong properties are rejected") {
  if (!HasHelpers()) return;
  using Deep = std::optional<DeepImage>;
  const auto send = [](Deep deep) {
    Deep received = DeepImage(1, 1, 3);
    const Error error = RunHelper(
        "photo.exr", kLimits, [] {},
        [&](Channel* channel) {
          Pass(channel, channel->direction() == Direction::kSend ? &deep : &received);
        });
    return std::pair(error.line(), received);
  };
  DeepImage image(700, 300, 4);
  for (size_t k = 0; k < image.samples.size(); ++k) image.samples[k] = static_cast<uint16_t>(k);
  image.is_half = true;
  image.transfer = STARFOCUS_TRANSFER_HLG;
  const auto [error, received] = send(image);
  CHECK(error.empty());
  REQUIRE(received);
  CHECK(std::tuple(received->width, received->height, received->channels, received->is_half,
                   received->transfer) == std::tuple(700, 300, 4, true, STARFOCUS_TRANSFER_HLG));
  CHECK(received->samples == image.samples);
  CHECK_FALSE(send({}).second);
  for (const int channels : {-1, 2, 5}) {
    image.channels = channels;
    CHECK(!send(image).first.empty());
  }
  image.channels = 4;
  image.transfer = 4;
  CHECK(!send(image).first.empty());
}

TEST_CASE("helper: files, networks, programs and other processes are out of reach") {
  if (!HasHelpers()) return;
  const char* const arguments[] = {"/bin/true", nullptr};
  const int file = open("/dev/null", O_RDONLY);
  // No open file of the program is left but the channel.
  CHECK(Attempt({[&] { return lseek(file, 0, SEEK_CUR) >= 0; },
                 [] { return write(STDERR_FILENO, "", 0) >= 0; }}) == std::vector<int>(2, EBADF));
  close(file);
  CHECK(ErrorOf([] { std::thread([] {}).join(); }) == "");  // threads may start
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

TEST_CASE("helper: a decoder that crashes or exceeds a limit causes one error") {
  if (!HasHelpers()) return;
  const std::string crash =
      "photo.jpg: expected a file that can be decoded, found one that makes the decoder crash (";
  CHECK(ErrorOf([] { std::abort(); }) == crash + "Aborted)");
  CHECK(ErrorOf([] { raise(SIGKILL); }) == crash + "Killed)");
  CHECK(ErrorOf([] { _exit(0); }) == crash + "it sent no whole result)");
  const auto close_all = [] {
    for (int file = 0; file < 1024; ++file) close(file);
    sleep(100);
  };
  CHECK(ErrorOf(close_all) == crash + "it sent no whole result)");
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

// Runs `misbehave` with the channel of a helper process that should send a picture. Returns the
// error. No process may remain.
std::string ErrorOfPart(const HelperLimits& limits,
                        const std::function<void(Channel*)>& misbehave) {
  const Error error = RunHelper(
      "photo.jpg", limits, [] {},
      [&](Channel* channel) {
        if (channel->direction() == Direction::kSend) return misbehave(channel);
        Image picture;
        Pass(channel, &picture);
      });
  CHECK(waitpid(-1, nullptr, WNOHANG) == -1);
  CHECK(errno == ECHILD);
  return error.line();
}

// Sends the size of a picture, and the number of its samples.
void SendSize(int width, int height, uint64_t samples, Channel* channel) {
  channel->Value(&width);
  channel->Value(&height);
  channel->Value(&samples);
}

// Sends a picture at 100 bytes a second after its size.
void Trickle(Channel* channel) {
  SendSize(1000, 1000, 3000000, channel);
  for (char byte = 0;; usleep(10000)) {
    channel->Value(&byte);
    channel->Flush();
  }
}

void Compute(double nanoseconds) {
  for (const double end = ThreadNanoseconds() + nanoseconds; ThreadNanoseconds() < end;) continue;
}

// Sends part after part of a result for a longer time than the idle limit.
void Pretend(Channel* channel) {
  for (;; usleep(5000)) {
    Compute(3e6);
    channel->Flush();
  }
}

// Computes for 0.3 s, and sends a picture.
void Work(Channel* channel) {
  Compute(3e8);
  Image picture(3000, 100);
  Pass(channel, &picture);
}

void UseUpMemory() {
  while (mmap(nullptr, size_t{1} << 24, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) !=
         MAP_FAILED) {
  }
}

TEST_CASE("helper: a decoder without progress causes one error within the limit") {
  if (!HasHelpers()) return;
  constexpr uint64_t kMuch = uint64_t{1} << 30;
  constexpr HelperLimits kIdle = {kMuch, 5, 20, 0.2}, kSmall = {uint64_t{1} << 28, 5, 20, 0.1};
  const std::string decoded = "photo.jpg: expected a file that can be decoded";
  const std::string idle = decoded + ", found one whose decoder makes no progress for 0.2 seconds";
  const std::string slow = decoded + " within 0.3 seconds, found one that takes longer";
  const std::string memory = "photo.jpg: out of memory, cannot read it";
  const auto freeze = [](Channel*) {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, nullptr);
    for (;;) sleep(100);
  };
  const auto lock = [](Channel*) {
    std::mutex mutex;
    mutex.lock();
    std::thread([&] { mutex.lock(); }).join();
  };
  const auto starve = [](Channel*) {
    UseUpMemory();
    sleep(100);
  };
  const auto crash = [](Channel*) {
    UseUpMemory();
    std::abort();
  };
  const struct {
    std::string what;
    std::function<void(Channel*)> misbehave;
    HelperLimits limits;
    std::string error;
    double least_seconds;
  } rows[] = {
      {"sleeps", [](Channel*) { sleep(100); }, kIdle, idle, 0.2},
      {"waits for a lock", lock, kIdle, idle, 0.2},
      {"stops itself", [](Channel*) { raise(SIGSTOP); }, kIdle, idle, 0.2},
      {"ignores signals and sleeps", freeze, kIdle, idle, 0.2},
      {"trickles", Trickle, kIdle, idle, 0.2},
      {"pretends to work", Pretend, {kMuch, 5, 0.3, 0.2}, slow, 0.3},
      {"computes and sends for longer than the idle limit", Work, {kMuch, 5, 20, 0.1}, "", 0.3},
      {"waits because its memory is used up", starve, kSmall, memory, 0},
      {"crashes because its memory is used up", crash, kSmall, memory, 0}};
  for (const auto& row : rows) {
    CAPTURE(row.what);
    const double start = Seconds();
    CHECK(ErrorOfPart(row.limits, row.misbehave) == row.error);
    CHECK(Seconds() - start >= row.least_seconds);
    CHECK(Seconds() - start < 6);
  }
}

TEST_CASE("helper: time in which the program is stopped or busy does not count") {
  if (!HasHelpers()) return;
  const Error error = RunHelper(
      "photo.jpg", {uint64_t{1} << 30, 5, 0.4, 0.2}, [] {},
      [](Channel* channel) {
        Image first(2000, 2000), second(2000, 2000);
        Pass(channel, &first);
        if (channel->direction() == Direction::kReceive) usleep(500000);
        Pass(channel, &second);
      });
  CHECK(error.line() == "");
}

TEST_CASE("helper: a size that contradicts itself is rejected before memory for it is allocated") {
  if (!HasHelpers()) return;
  const auto lie = [](int width, int height, uint64_t count) {
    return ErrorOfPart({uint64_t{1} << 30, 5, 20, 5}, [=](Channel* channel) {
      SendSize(width, height, count, channel);
      std::vector<uint8_t> flood(1 << 20);
      while (channel->is_sound()) channel->Value(&(flood[0] = 0)), channel->Block(&flood);
    });
  };
  rusage before, after;
  getrusage(RUSAGE_SELF, &before);
  for (const auto& one : {std::tuple{65535, 65535, uint64_t{1} << 30},
                          {-1, -1, 3},
                          {-3, -2, 18},
                          {0, 5, 0},
                          {0, 0, 18},
                          {1, 0, 0},
                          {4, 2, 18},
                          {20000, 20000, uint64_t{1200000000}},
                          {10, 10, uint64_t{1} << 30},
                          {10, 10, ~uint64_t{0}},
                          {10, 10, 299},
                          {INT_MIN, INT_MIN, 0},
                          {INT_MAX, INT_MAX, 1}}) {
    CAPTURE(std::get<0>(one));
    CAPTURE(std::get<1>(one));
    CHECK(std::apply(lie, one) ==
          "photo.jpg: expected a file that can be decoded, found one that makes the decoder crash "
          "(it sent no whole result)");
  }
  getrusage(RUSAGE_SELF, &after);
  CHECK(after.ru_maxrss - before.ru_maxrss < 64 * 1024);
}

TEST_CASE("helper: a decoder uses no more processors than threads") {
  if (!HasHelpers()) return;
  const int before = DecoderThreads();
  for (const int threads : {1, 2}) {
    SetDecoderThreads(threads);
    int processors = 0;
    const Error error = RunHelper(
        "photo.jpg", kLimits,
        [&] {
          cpu_set_t set;
          processors = sched_getaffinity(0, sizeof(set), &set) == 0 ? CPU_COUNT(&set) : -1;
        },
        [&](Channel* channel) { channel->Value(&processors); });
    CHECK(error.line() == "");
    CHECK(processors >= 1);
    CHECK(processors <= threads);
  }
  SetDecoderThreads(before);
}

}  // namespace
}  // namespace starfocus::helper_test
