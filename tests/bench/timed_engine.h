// SPDX-License-Identifier: Apache-2.0
// An engine with its memory, ready to refocus one picture again and again.
#ifndef STARFOCUS_TESTS_BENCH_TIMED_ENGINE_H_
#define STARFOCUS_TESTS_BENCH_TIMED_ENGINE_H_

#include <memory>
#include <new>
#include <string>

#include "platform/result.h"
#include "platform/runner.h"
#include "tests/bench/field.h"
#include "tests/bench/row.h"
#include "tests/bench/stopwatch.h"

namespace starfocus::bench {

struct FreeAligned {
  void operator()(void* memory) const {
    ::operator delete (memory, std::align_val_t{STARFOCUS_ALIGNMENT});
  }
};

struct TimedEngine {
  std::unique_ptr<void, FreeAligned> workspace;
  size_t workspace_bytes = 0;
  starfocus_engine* engine = nullptr;
  std::unique_ptr<ThreadRunner> pool;  // null for one worker
  starfocus_params params;
  starfocus_report report = {};
  Image picture;
};

// The starfocus_mode of a name; -1 when it is none.
int ModeOf(const std::string& name);

// Makes an engine for task, focus and aperture. Errors are lines.
Error Prepare(const Field& field, const Task& task, double focus, double aperture,
              TimedEngine* timed);

// Refocuses once; *elapsed is the time inside starfocus_refocus.
Error RunOnce(const Field& field, const Task& task, TimedEngine* timed, Elapsed* elapsed);

}  // namespace starfocus::bench

#endif  // STARFOCUS_TESTS_BENCH_TIMED_ENGINE_H_
