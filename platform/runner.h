// SPDX-License-Identifier: Apache-2.0
// A pool of persistent threads behind the engine's sf_runner callback.
#ifndef STARFOCUS_PLATFORM_RUNNER_H_
#define STARFOCUS_PLATFORM_RUNNER_H_

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "starfocus/starfocus.h"

namespace starfocus {

// A batch follows the one before within microseconds, less than it takes to wake a thread, so who
// has nothing to do looks again for a while, giving way to other threads, before it sleeps.
class ThreadRunner {
 public:
  // `workers` in [1, SF_MAX_WORKERS]; the calling thread is worker 0, so workers - 1 threads are
  // started. With fewer threads than asked for (the system refused) work goes on with those.
  explicit ThreadRunner(int workers);
  ~ThreadRunner();
  ThreadRunner(const ThreadRunner&) = delete;
  ThreadRunner& operator=(const ThreadRunner&) = delete;

  int workers() const { return static_cast<int>(threads_.size()) + 1; }

  // The sf_runner; runner_data is the ThreadRunner. Calls from several threads take turns. A job
  // must not call it again. When a job throws, those not yet begun are left out and the first
  // exception is thrown here once no job runs any more; jobs of an engine do not throw.
  static int Run(void* runner_data, sf_job job, void* job_data, int32_t count);

 private:
  struct Batch {
    sf_job job;
    void* data;
    int32_t count;
  };

  void Serve(int32_t worker);
  void Work(int32_t worker);
  void RunJob(int32_t index, int32_t worker);
  void Rethrow();
  bool IsCalled() const { return left_ > 0 || stop_; }
  bool IsDone() const { return undone_ == 0; }

  std::mutex turn_;  // held for a whole batch
  Batch batch_ = {nullptr, nullptr, 0};
  // Jobs of the batch that nobody has taken. Whoever takes one may read batch_ until that job
  // counts as done.
  std::atomic<int32_t> left_{0};
  std::atomic<int32_t> undone_{0};
  std::atomic<bool> stop_{false};

  std::atomic<bool> failed_{false};
  std::exception_ptr failure_;  // of the batch

  // Who sleeps says so before the last look at the above; who changes that looks here afterwards.
  std::atomic<int32_t> idle_{0};      // threads at wake_
  std::atomic<bool> waiting_{false};  // the caller, at finished_
  std::mutex sleep_;                  // of both, and of failure_
  std::condition_variable wake_;
  std::condition_variable finished_;
  std::vector<std::thread> threads_;
};

// Workers the machine can run at once, in [1, SF_MAX_WORKERS].
int HardwareWorkers();

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_RUNNER_H_
