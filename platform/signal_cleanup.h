// SPDX-License-Identifier: Apache-2.0
// Removes temporary files and ends child processes if a signal ends the program.
#ifndef STARFOCUS_PLATFORM_SIGNAL_CLEANUP_H_
#define STARFOCUS_PLATFORM_SIGNAL_CLEANUP_H_

#include <signal.h>

namespace starfocus {

// An entry in the list of cleanups that the signal handler runs. The owner must remove the entry
// before the entry is destroyed.
class SignalCleanup {
 public:
  // Locks the list. The thread that holds the lock blocks signals, so the signal handler may wait
  // for the lock.
  class Turn {
   public:
    Turn();
    ~Turn();
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;

    // Returns the signals that were blocked before.
    const sigset_t& before() const { return before_; }

   private:
    sigset_t before_;
  };

  // Adds the entry. The handler calls `clean` with `data`; `clean` may call only functions that are
  // safe in a signal handler.
  void Add(const Turn&, void (*clean)(const void* data), const void* data);
  void Remove(const Turn&);
  bool is_listed() const { return clean_ != nullptr; }

  // Installs handlers for SIGINT, SIGTERM and other signals that end a program. The handlers run
  // the cleanups of all threads and end the program. Signals that the process ignores remain
  // ignored.
  static void Install();

  // Restores the default handlers and empties the list, in a child process whose parent process
  // cleans up.
  static void Uninstall(const Turn&);

 private:
  static void CleanAllAndEnd(int signal);

  void (*clean_)(const void*) = nullptr;
  const void* data_ = nullptr;
  // neighbours in the list
  SignalCleanup *next_ = nullptr, *previous_ = nullptr;
};

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_SIGNAL_CLEANUP_H_
