// SPDX-License-Identifier: Apache-2.0
#include "examples/command_line/program.h"

#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <system_error>

#include "platform/console.h"
#include "platform/file.h"
#include "platform/helper/helper.h"
#include "platform/signal_cleanup.h"
#include "starfocus/starfocus.h"

namespace starfocus {
namespace {

// Returns true if no process reads the pipe of stdout any more, for example after `| head`.
bool IsReaderGone() {
  pollfd output = {STDOUT_FILENO, POLLOUT, 0};
  return poll(&output, 1, 0) == 1 && (output.revents & POLLERR) != 0;
}

// Flushes stdout. Returns an error if printed text could not be written. If the reader of a pipe is
// gone, ends the program without a message, as the signal does in programs that do not ignore it.
Error CheckPrinted() {
  const bool failed = std::ferror(stdout) != 0;
  errno = 0;
  if (std::fflush(stdout) == 0 && !failed) return {};
  if (errno == EPIPE || IsReaderGone()) {
    signal(SIGPIPE, SIG_DFL);
    raise(SIGPIPE);
  }
  const int reason = errno != 0 ? errno : EIO;
  return Cannot("write to", "standard output", {reason, std::generic_category()});
}

// Exit codes. Internal errors use the code EX_SOFTWARE of sysexits.h.
constexpr int kFailed = 1, kUsage = 2, kInternal = 70;

int Report(const char* name, const Error& error) {
  if (!error) return 0;
  if (!error.line().empty()) TellLine(std::string(name) + ": " + error.line());
  return error.kind() == ErrorKind::kInput   ? kFailed
         : error.kind() == ErrorKind::kUsage ? kUsage
                                             : kInternal;
}

}  // namespace

std::string VersionText(const std::string& name) {
  return name + " " + starfocus_version(nullptr) + " (" + starfocus_simd_target() + ")";
}

int RunProgram(const char* name, const std::function<Error()>& run) {
  signal(SIGPIPE, SIG_IGN);
  signal(SIGXFSZ, SIG_IGN);  // writing beyond a limit of file sizes then fails with an error
  signal(SIGCHLD, SIG_DFL);  // if the parent ignores it, the ends of child processes are lost
  SignalCleanup::Install();
  ConfineDecoders();
  try {
    Error error = run();
    if (!error) error = CheckPrinted();
    return Report(name, error);
  } catch (const std::bad_alloc&) {
    // This handler must not allocate memory, because memory has run out.
    std::fprintf(stderr, "%s: out of memory\n", name);
    return kFailed;
  } catch (const std::exception& exception) {
    return Report(name, Error::Internal("program", "no internal error", exception.what()));
  }
}

}  // namespace starfocus
