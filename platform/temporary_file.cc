// SPDX-License-Identifier: Apache-2.0
#include "platform/temporary_file.h"

#include <sched.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>

namespace starfocus {
namespace {

constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};

std::atomic<bool> taken{false};  // Spin lock of the list of temporary files.
TemporaryFile* first = nullptr;  // Head of the list of temporary files.

void Take() {
  while (taken.exchange(true)) sched_yield();
}

}  // namespace

// Locks the list of temporary files. The thread that holds the lock blocks signals, so a signal
// handler may wait for the lock.
class TemporaryFile::Turn {
 public:
  Turn() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before_);
    Take();
  }
  ~Turn() {
    taken = false;
    const int error = errno;
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    errno = error;
  }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  sigset_t before_;
};

TemporaryFile::TemporaryFile(const std::string& folder) {
  static std::atomic<unsigned> counter{0};
  for (int attempt = 0; attempt < 100; ++attempt) {
    name_ = folder + "/.starfocus-" + std::to_string(getpid()) + "-" + std::to_string(counter++) +
            ".part";
    const Turn turn;
    file_ = std::fopen(name_.c_str(), "wbx");
    if (file_ == nullptr && errno == EEXIST) continue;
    if (file_ == nullptr) return;
    listed_ = true;
    next_ = first;
    if (next_ != nullptr) next_->previous_ = this;
    first = this;
    return;
  }
}

TemporaryFile::~TemporaryFile() {
  if (file_ != nullptr) std::fclose(file_);
  if (!listed_) return;
  const Turn turn;
  unlink(name_.c_str());
  Leave();
}

void TemporaryFile::Leave() {
  (previous_ != nullptr ? previous_->next_ : first) = next_;
  if (next_ != nullptr) next_->previous_ = previous_;
  listed_ = false;
}

bool TemporaryFile::MoveTo(const std::string& target) {
  std::FILE* file = file_;
  file_ = nullptr;
  // Flush to disk before renaming: after a power failure, the final name must not refer to an empty
  // file.
  const bool whole = std::fflush(file) == 0 && fsync(fileno(file)) == 0;
  if (std::fclose(file) != 0 || !whole) return false;
  const Turn turn;
  if (std::rename(name_.c_str(), target.c_str()) != 0) return false;
  Leave();
  return true;
}

// Removes all temporary files and ends the program. Never unlocks the list, so that waiting threads
// stay blocked until the program ends.
void TemporaryFile::RemoveAllAndEnd(int number) {
  Take();
  for (const TemporaryFile* file = first; file != nullptr; file = file->next_) {
    unlink(file->name_.c_str());
  }
  signal(number, SIG_DFL);
  sigset_t only;
  sigemptyset(&only);
  sigaddset(&only, number);
  raise(number);
  pthread_sigmask(SIG_UNBLOCK, &only, nullptr);
}

void TemporaryFile::RemoveOnSignals() {
  for (const int number : kSignals) {
    struct sigaction action = {};
    if (sigaction(number, nullptr, &action) != 0 || action.sa_handler == SIG_IGN) continue;
    action = {};
    action.sa_handler = RemoveAllAndEnd;
    // Block other signals during the handler, because a second handler would wait forever for the
    // lock of the first handler.
    sigfillset(&action.sa_mask);
    sigaction(number, &action, nullptr);
  }
}

}  // namespace starfocus
