#include "platform/runner.h"

#include <algorithm>
#include <system_error>

namespace starfocus {

ThreadRunner::ThreadRunner(int workers) {
  const int limit = std::clamp(workers, 1, int{SF_MAX_WORKERS});
  threads_.reserve(size_t(limit));
  try {
    for (int32_t worker = 1; worker < limit; ++worker) {
      threads_.emplace_back([this, worker] { Serve(worker); });
    }
  } catch (const std::system_error&) {
    // Fewer threads than asked for only cost time.
  }
}

ThreadRunner::~ThreadRunner() {
  {
    std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
  }
  wake_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void ThreadRunner::Work(std::unique_lock<std::mutex>* lock, int32_t worker) {
  while (batch_.next < batch_.count) {
    const int32_t index = batch_.next++;
    lock->unlock();
    // `job` and `data` stay as they are until this index is counted as done.
    batch_.job(batch_.data, index, worker);
    lock->lock();
    if (++batch_.done == batch_.count) finished_.notify_all();
  }
}

void ThreadRunner::Serve(int32_t worker) {
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;) {
    wake_.wait(lock, [this] { return stop_ || batch_.next < batch_.count; });
    if (stop_) return;
    Work(&lock, worker);
  }
}

int ThreadRunner::Run(void* runner_data, sf_job job, void* job_data, int32_t count) {
  if (runner_data == nullptr || job == nullptr || count < 0) return 1;
  ThreadRunner* self = static_cast<ThreadRunner*>(runner_data);
  std::lock_guard<std::mutex> turn(self->turn_);
  std::unique_lock<std::mutex> lock(self->mutex_);
  self->batch_ = {job, job_data, count, 0, 0};
  if (count > 1) self->wake_.notify_all();
  self->Work(&lock, 0);
  self->finished_.wait(lock, [self] { return self->batch_.done == self->batch_.count; });
  return 0;
}

int HardwareWorkers() {
  const unsigned threads = std::thread::hardware_concurrency();
  return std::clamp(static_cast<int>(threads), 1, int{SF_MAX_WORKERS});
}

}  // namespace starfocus
