// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>
#include <new>
#include <sstream>
#include <system_error>

#include "platform/helper/decoder_threads.h"
#include "platform/helper/helper.h"
#include "platform/helper/system_calls.h"
#include "platform/helper/watch.h"
#include "platform/signal_cleanup.h"

namespace starfocus {
namespace {

bool confined = false;  // set once by ConfineDecoders, and cleared in helper processes

// Exit code of a helper process whose memory does not suffice.
constexpr int kNoMemory = 71;

// Lowers a limit of this process. A lower limit that exists already stays.
void Limit(int resource, uint64_t value) {
  rlimit limit;
  if (getrlimit(static_cast<__rlimit_resource_t>(resource), &limit) != 0) return;
  limit.rlim_max = std::min(limit.rlim_max, static_cast<rlim_t>(value));
  limit.rlim_cur = std::min(limit.rlim_cur, limit.rlim_max);
  // At its limit of processor time, a process gets SIGXCPU, or SIGKILL if the limits are equal.
  if (resource == RLIMIT_CPU) ++limit.rlim_max;
  setrlimit(static_cast<__rlimit_resource_t>(resource), &limit);
}

// Returns the size of this process's address space in bytes.
uint64_t MappedBytes() {
  uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<uint64_t>(sysconf(_SC_PAGESIZE));
}

void CloseOthers(int file) {
  if (file > 0) close_range(0, static_cast<unsigned>(file) - 1, 0);
  close_range(static_cast<unsigned>(file) + 1, ~0U, 0);
}

// Gives up the rights of this process for good, except the right to write to `file`.
void GiveUpRights(int file, const HelperLimits& limits) {
  // 32-bit systems limit a process to 4 GiB anyway.
  if (sizeof(size_t) > 4) Limit(RLIMIT_AS, MappedBytes() + limits.bytes);
  CloseOthers(file);
  Limit(RLIMIT_CPU, limits.seconds);
  Limit(RLIMIT_FSIZE, 0);
  Limit(RLIMIT_NOFILE, 0);  // prevents files and sockets, even if the kernel has no filters
  RestrictSystemCalls();
}

// Ends a helper process that crashes or is told to end. If less memory is left than a thread needs,
// the lack of memory is the cause: libraries wait forever for threads that they could not start,
// and end the process if an allocation fails.
void EndOnSignal(int number) {
  constexpr size_t kThread = size_t{64} << 20;
  if (mmap(nullptr, kThread, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) == MAP_FAILED) {
    _exit(kNoMemory);
  }
  signal(number, SIG_DFL);
  raise(number);
}

// Runs in the helper process.
[[noreturn]] void Serve(int file, const HelperLimits& limits, const std::function<void()>& work,
                        const std::function<void(Channel*)>& pass, unsigned turn) noexcept {
  confined = false;
  std::set_new_handler([] { _exit(kNoMemory); });
  for (const int number : {SIGABRT, SIGSEGV, SIGBUS}) signal(number, EndOnSignal);
  try {
    UseDecoderThreads(turn);
    Channel channel(file, Direction::kSend);
    GiveUpRights(file, limits);
    std::string problem;
    try {
      work();
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& exception) {
      problem = exception.what();
    }
    channel.Block(&problem);
    if (problem.empty()) pass(&channel);
    channel.Flush();
    _exit(0);  // without the destructors and buffers of the program
  } catch (const std::bad_alloc&) {
    _exit(kNoMemory);
  }
}

// Runs in the program. Returns the error that the helper process sends.
Error Receive(const std::string& where, const std::function<void(Channel*)>& pass,
              Channel* channel) {
  try {
    std::string problem;
    channel->Block(&problem);
    if (!problem.empty()) return Error::Internal(where, "no internal error", problem);
    pass(channel);
    return {};
  } catch (const std::bad_alloc&) {
    return OutOfMemory(where, "read it");
  }
}

// Valgrind makes system calls in the process that it examines, which filters would forbid.
bool RunsUnderValgrind() {
  const char* preloaded = std::getenv("LD_PRELOAD");
  return preloaded != nullptr && std::strstr(preloaded, "/vgpreload_") != nullptr;
}

// Waits up to half a second for the end of the helper process. Returns true if it has ended.
bool Ends(pid_t helper, int* status) {
  constexpr timespec kStep = {0, 10'000'000};  // 10 ms
  for (int k = 0; k < 50; ++k) {
    if (waitpid(helper, status, WNOHANG) == helper) return true;
    nanosleep(&kStep, nullptr);
  }
  return false;
}

// Ends the helper process, which must not outlive its result. Returns its status, or 0 if it has
// not ended by itself. A helper process that exceeds a limit can report that its memory does not
// suffice (EndOnSignal).
int Finish(pid_t helper, const Channel& channel, Watch::End end) {
  int status = 0;
  if (end != Watch::End::kNone) kill(helper, SIGABRT);
  if ((end != Watch::End::kNone || channel.is_closed()) && Ends(helper, &status)) return status;
  kill(helper, SIGKILL);
  while (waitpid(helper, nullptr, 0) < 0 && errno == EINTR) {
  }
  return 0;
}

std::string SecondsText(double seconds) {
  std::ostringstream text;
  text << seconds << " seconds";
  return text.str();
}

Error TooSlow(const std::string& where, const std::string& limit) {
  return Expected(where, "a file that can be decoded within " + limit, "one that takes longer");
}

// Returns the reason why a helper process has sent no whole result.
Error Failure(const std::string& where, const HelperLimits& limits, Watch::End end, int status) {
  if (WIFEXITED(status) && WEXITSTATUS(status) == kNoMemory) return OutOfMemory(where, "read it");
  if (end == Watch::End::kNoProgress) {
    return Expected(where, "a file that can be decoded",
                    "one whose decoder makes no progress for " + SecondsText(limits.idle_seconds));
  }
  if (end == Watch::End::kTooLong) {
    return TooSlow(where, SecondsText(limits.wall_seconds));
  }
  const int number = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  if (number == SIGXCPU) {
    return TooSlow(where, SecondsText(limits.seconds) + " of processor time");
  }
  const std::string cause = number != 0 ? strsignal(number) : "it sent no whole result";
  return Expected(where, "a file that can be decoded",
                  "one that makes the decoder crash (" + cause + ")");
}

// Returns 0 in the helper process. The helper process ends if this thread ends.
pid_t Fork() {
  const pid_t program = getpid();
  const SignalCleanup::Turn turn;
  const pid_t helper = fork();
  if (helper != 0) return helper;
  SignalCleanup::Uninstall(turn);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != program) _exit(1);
  return 0;
}

}  // namespace

void ConfineDecoders() { confined = !RunsUnderValgrind(); }

void ConfineProgram() {
  if (confined) ForbidSystemCalls();
}

bool DecodersAreConfined() { return confined; }

Error RunHelper(const std::string& where, const HelperLimits& limits,
                const std::function<void()>& work, const std::function<void(Channel*)>& pass) {
  static std::atomic<unsigned> turn{0};
  int ends[2];
  const auto failed = [&] {
    return Cannot("start a process to decode", where, {errno, std::generic_category()});
  };
  if (pipe2(ends, O_CLOEXEC) != 0) return failed();
  fcntl(ends[1], F_SETPIPE_SZ, 1 << 20);  // fewer changes of the running process
  const unsigned its_turn = turn++;
  const pid_t helper = Fork();
  if (helper == 0) Serve(ends[1], limits, work, pass, its_turn);
  Error error = helper < 0 ? failed() : Error();
  close(ends[1]);
  Watch watch(ends[0], helper, limits);
  Channel channel(ends[0], Direction::kReceive,
                  [&](size_t received) { return watch.Wait(received); });
  if (!error) error = Receive(where, pass, &channel);
  close(ends[0]);
  if (helper < 0) return error;
  const int status = Finish(helper, channel, watch.end());
  return channel.is_sound() ? error : Failure(where, limits, watch.end(), status);
}

}  // namespace starfocus
