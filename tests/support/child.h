// SPDX-License-Identifier: Apache-2.0
// Runs child processes that are ended by a signal.
#ifndef STARFOCUS_TESTS_SUPPORT_CHILD_H_
#define STARFOCUS_TESTS_SUPPORT_CHILD_H_

#include <doctest/doctest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

namespace starfocus {

// Starts a process that calls `work`. Sends `signal` to the process as soon as `work` has reported
// its start, and returns the exit status of the process.
template <class Work>
int EndBySignal(int signal, const Work& work) {
  int ends[2];
  REQUIRE(pipe(ends) == 0);
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    ::signal(signal, SIG_DFL);  // The parent may ignore the signal, as nohup does.
    work([&] { return write(ends[1], "x", 1) == 1; });
    _exit(0);
  }
  char byte = 0;
  REQUIRE(read(ends[0], &byte, 1) == 1);
  REQUIRE(kill(child, signal) == 0);
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  close(ends[0]);
  close(ends[1]);
  return status;
}

}  // namespace starfocus

#endif  // STARFOCUS_TESTS_SUPPORT_CHILD_H_
