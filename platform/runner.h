// A pool of persistent threads behind the engine's sf_runner callback.
#ifndef STARFOCUS_PLATFORM_RUNNER_H_
#define STARFOCUS_PLATFORM_RUNNER_H_

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

#include "starfocus/starfocus.h"

namespace starfocus {

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
  // must not call it again.
  static int Run(void* runner_data, sf_job job, void* job_data, int32_t count);

 private:
  struct Batch {
    sf_job job;
    void* data;
    int32_t count;
    int32_t next;
    int32_t done;
  };

  void Serve(int32_t worker);
  void Work(std::unique_lock<std::mutex>* lock, int32_t worker);

  std::mutex turn_;   // held for a whole batch
  std::mutex mutex_;  // guards everything below
  std::condition_variable wake_;
  std::condition_variable finished_;
  Batch batch_ = {nullptr, nullptr, 0, 0, 0};
  bool stop_ = false;
  std::vector<std::thread> threads_;
};

// Workers the machine can run at once, in [1, SF_MAX_WORKERS].
int HardwareWorkers();

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_RUNNER_H_
