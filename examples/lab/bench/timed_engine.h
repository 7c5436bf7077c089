// SPDX-License-Identifier: Apache-2.0
// Creates an engine and its memory for refocusing one light field repeatedly. Used by the bench
// programs.
#ifndef STARFOCUS_EXAMPLES_LAB_BENCH_TIMED_ENGINE_H_
#define STARFOCUS_EXAMPLES_LAB_BENCH_TIMED_ENGINE_H_

#include <memory>
#include <new>
#include <string>

#include "examples/lab/bench/field.h"
#include "examples/lab/bench/row.h"
#include "examples/lab/bench/stopwatch.h"
#include "platform/result.h"
#include "platform/runner.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"

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
  std::unique_ptr<ThreadRunner> pool;  // thread pool for several workers; null for one worker
  starfocus::Params params;
  test::Report report;
  Image picture;
};

// Returns the starfocus_mode with this name, or -1 if the name is unknown.
int ModeOf(const std::string& name);

// Creates an engine for a task, focus and aperture. Returns a one-line error on failure.
Error Prepare(const Field& field, const Task& task, double focus, double aperture,
              TimedEngine* timed);

// Refocuses once. `elapsed` receives the time that starfocus_refocus takes.
Error RunOnce(const Field& field, const Task& task, TimedEngine* timed, Elapsed* elapsed);

}  // namespace starfocus::bench

#endif  // STARFOCUS_EXAMPLES_LAB_BENCH_TIMED_ENGINE_H_
