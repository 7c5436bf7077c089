// SPDX-License-Identifier: Apache-2.0
#include "lib/base/jobs.h"

#include <doctest/doctest.h>

#include <thread>
#include <vector>

namespace starfocus::jobs_test {
namespace {

// Records the calls of the progress function and returns a fixed answer.
struct Caller {
  std::vector<int32_t> done;
  int answer = 0;

  static int Progress(void* data, int32_t rows_done, int32_t) {
    Caller& self = *static_cast<Caller*>(data);
    self.done.push_back(rows_done);
    return self.answer;
  }
};

TEST_CASE("cancel: progress is called every half a million samples, for steps of any size") {
  for (const int64_t at_once : {1, 1000, 1 << 19, 1 << 25}) {
    CAPTURE(at_once);
    Caller caller;
    CallProgress watch;
    watch.SetProgress(Caller::Progress, &caller);
    watch.Begin(0, 10);
    CancelToken cancel(&watch);
    constexpr int64_t kWork = 1 << 26;
    for (int64_t work = 0; work < kWork; work += at_once) {
      if (!cancel.Spend(at_once)) FAIL("Spend returned false, but the callback did not cancel");
    }
    const int64_t most = at_once > 1 << 19 ? at_once : 1 << 19;
    const auto asked = int64_t(caller.done.size());
    CHECK(2 * most * asked >= kWork);
    constexpr int64_t kOften = kWork >> 19;
    CHECK(asked <= kOften);
  }
}

TEST_CASE(
    "cancel: cancellation stops all workers of the current call, but does not affect the next "
    "call") {
  Caller caller;
  caller.answer = 1;
  CallProgress watch;
  watch.SetProgress(Caller::Progress, &caller);
  watch.Begin(0, 10);
  CancelToken one(&watch), other(&watch);
  CHECK(one.Spend(1));
  CHECK(!one.Spend(1 << 20));
  CHECK(!one.Spend(0));
  CHECK(!other.Spend(1 << 20));
  CHECK(!watch.Ask());
  CHECK(watch.IsCancelled());
  CHECK(caller.done.size() == 1);
  caller.answer = 0;
  watch.SetProgress(Caller::Progress, &caller);
  watch.Begin(0, 10);
  CHECK(!watch.IsCancelled());
  CHECK(one.Spend(0));
  CHECK(other.Spend(1 << 20));
}

TEST_CASE("cancel: work continues without a progress function") {
  CallProgress watch;
  CancelToken nobody, watched(&watch);
  for (int i = 0; i < 3; ++i) {
    CHECK(nobody.Spend(1 << 25));
    CHECK(watched.Spend(1 << 25));
    CHECK(GoesOn(nullptr, 1 << 25));
  }
}

// Reports work from another thread during a call of the progress function.
struct Nested {
  CallProgress* watch;
  int calls = 0;
  bool other = false;  // return value of CallProgress::Ask in the other thread

  static int Progress(void* data, int32_t, int32_t) {
    Nested& self = *static_cast<Nested*>(data);
    if (++self.calls > 1) return 1;
    std::thread([&self] { self.other = self.watch->Ask(); }).join();
    return 0;
  }
};

TEST_CASE("progress: while one thread runs the callback, Ask returns true in other threads") {
  CallProgress watch;
  Nested nested{&watch};
  watch.SetProgress(Nested::Progress, &nested);
  watch.Begin(0, 10);
  CHECK(watch.Ask());
  CHECK(nested.other);
  CHECK(nested.calls == 1);
  CHECK(!watch.Ask());
  CHECK(nested.calls == 2);
}

TEST_CASE(
    "progress: in each part of a call, the reported rows grow in proportion to the finished jobs") {
  Caller caller;
  CallProgress watch;
  watch.SetProgress(Caller::Progress, &caller);
  watch.Begin(0, 100);
  for (int part = 0; part < 3; ++part) {
    watch.SetPart(part, 3);
    watch.BeginJobs(4);
    for (int job = 0; job < 4; ++job) {
      watch.Ask();
      watch.CountJob();
    }
  }
  watch.SetRows(100);
  watch.Ask();
  CHECK(caller.done == std::vector<int32_t>{0, 8, 16, 24, 33, 41, 49, 57, 66, 74, 83, 91, 100});
}

}  // namespace
}  // namespace starfocus::jobs_test
