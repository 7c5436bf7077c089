// SPDX-License-Identifier: Apache-2.0
#include "platform/signal_cleanup.h"

#include <sched.h>

#include <atomic>
#include <cerrno>

namespace starfocus {
namespace {

// Signals of users and systems that end a program. Profilers need SIGPROF for themselves.
constexpr int kSignals[] = {SIGHUP, SIGINT, SIGQUIT, SIGALRM, SIGTERM, SIGUSR1, SIGUSR2, SIGXCPU};

std::atomic<bool> taken{false};    // Spin lock of the list.
SignalCleanup* entries = nullptr;  // head of the list

void Take() {
  while (taken.exchange(true)) sched_yield();
}

}  // namespace

SignalCleanup::Turn::Turn() {
  sigset_t all;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before_);
  Take();
}

SignalCleanup::Turn::~Turn() {
  taken = false;
  const int error = errno;
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  errno = error;
}

void SignalCleanup::Add(const Turn&, void (*clean)(const void*), const void* data) {
  clean_ = clean;
  data_ = data;
  next_ = entries;
  if (next_ != nullptr) next_->previous_ = this;
  entries = this;
}

void SignalCleanup::Remove(const Turn&) {
  (previous_ != nullptr ? previous_->next_ : entries) = next_;
  if (next_ != nullptr) next_->previous_ = previous_;
  *this = {};
}

// Runs all cleanups and ends the program. Never unlocks the list, so that waiting threads stay
// blocked until the program ends.
void SignalCleanup::CleanAllAndEnd(int number) {
  Take();
  for (const SignalCleanup* entry = entries; entry != nullptr; entry = entry->next_) {
    entry->clean_(entry->data_);
  }
  signal(number, SIG_DFL);
  sigset_t only;
  sigemptyset(&only);
  sigaddset(&only, number);
  raise(number);
  pthread_sigmask(SIG_UNBLOCK, &only, nullptr);
}

void SignalCleanup::Install() {
  for (const int number : kSignals) {
    struct sigaction action = {};
    if (sigaction(number, nullptr, &action) != 0 || action.sa_handler == SIG_IGN) continue;
    action = {};
    action.sa_handler = CleanAllAndEnd;
    // Block other signals during the handler, because a second handler would wait forever for the
    // lock of the first handler.
    sigfillset(&action.sa_mask);
    sigaction(number, &action, nullptr);
  }
}

void SignalCleanup::Uninstall(const Turn&) {
  entries = nullptr;
  for (const int number : kSignals) {
    struct sigaction action = {};
    if (sigaction(number, nullptr, &action) != 0 || action.sa_handler != CleanAllAndEnd) continue;
    signal(number, SIG_DFL);
  }
}

}  // namespace starfocus
