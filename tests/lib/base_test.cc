// SPDX-License-Identifier: Apache-2.0
// Tests the progress and the cancellation of calls, the run-time checks of the table in fixed.h,
// and the conversions between codes and light.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <thread>
#include <vector>

#include "lib/base/fixed.h"
#include "lib/base/jobs.h"
#include "lib/base/transfer.h"
#include "simd/kernels.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/refocused.h"
#include "tests/support/transfer_curve.h"

namespace starfocus::base_test {
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

constexpr starfocus::FixedRange kRange = {"test", -2, 3};

#ifdef STARFOCUS_CHECK_RANGES
int told = 0;
int64_t last = 0;

void Remember(const starfocus::FixedRange& range, int64_t value) {
  CHECK(range.name == kRange.name);
  ++told;
  last = value;
}

TEST_CASE("ranges: only a value outside its range is reported") {
  starfocus::on_range_failure = Remember;
  const int16_t values[] = {-2, 3, 4, 0};
  starfocus::CheckAll(kRange, values, 4);
  CHECK(told == 1);
  CHECK(last == 4);
  CHECK(starfocus::Checked(kRange, -3) == -3);
  CHECK(told == 2);
  starfocus::on_range_failure = nullptr;
}
#else
TEST_CASE("ranges: a build without range checks reports nothing") {
  static_assert(starfocus::Checked(kRange, 4) == 4);
  const int16_t values[] = {-3, 4};
  starfocus::CheckAll(kRange, values, 2);
}
#endif

constexpr starfocus_transfer kTransfers[] = {STARFOCUS_TRANSFER_SRGB, STARFOCUS_TRANSFER_NONE};

uint8_t CodeOf(int light, starfocus_transfer transfer) {
  const auto level = int16_t(light);
  uint8_t code = 0;
  starfocus::simd::ReferenceKernels().Encode(&level, 1, starfocus::TransferOf(transfer), &code);
  return code;
}

TEST_CASE("transfer: the light of every code follows the curve and converts back to the code") {
  for (const starfocus_transfer transfer : kTransfers) {
    const starfocus::simd::Encoding& tables = starfocus::TransferOf(transfer);
    for (int code = 0; code < 256; ++code) {
      CAPTURE(code);
      CHECK(std::fabs(tables.light[code] - 128 * test::LightOf(code, transfer)) <= 0.5001);
      CHECK(CodeOf(tables.light[code], transfer) == code);
      if (code > 0) CHECK(tables.light[code] - tables.light[code - 1] >= 8);
    }
    CHECK(tables.light[0] == 0);
    CHECK(tables.light[255] == starfocus::kLightWhite);
  }
}

TEST_CASE("transfer: every level of light is rounded to the nearest code") {
  for (const starfocus_transfer transfer : kTransfers) {
    for (int light = 0; light <= starfocus::kLightWhite; ++light) {
      const double exact = test::CodeOf(light / 128.0, transfer);
      if (std::fabs(CodeOf(light, transfer) - exact) > 0.5 + 1e-9) {
        CAPTURE(light);
        CHECK(int(CodeOf(light, transfer)) == doctest::Approx(exact));
      }
    }
  }
}

}  // namespace
}  // namespace starfocus::base_test
