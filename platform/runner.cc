#include "platform/runner.h"

#include <algorithm>
#include <chrono>
#include <system_error>

namespace starfocus {
namespace {

// Longer than the engine's own work between two batches, shorter than a thread may waste.
constexpr std::chrono::microseconds kPatience(100);

// Looks for `ready` until it is true or patience ends.
template <class Ready>
void LookFor(const Ready& ready) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!ready() && std::chrono::steady_clock::now() < end) std::this_thread::yield();
}

}  // namespace

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
    std::lock_guard<std::mutex> lock(sleep_);
    stop_ = true;
  }
  wake_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void ThreadRunner::Work(int32_t worker) {
  int32_t left = left_;
  while (left > 0) {
    if (!left_.compare_exchange_weak(left, left - 1)) continue;
    batch_.job(batch_.data, batch_.count - left, worker);
    if (--undone_ == 0 && waiting_) {
      // The caller is asleep, or will look again once it has the lock.
      { std::lock_guard<std::mutex> lock(sleep_); }
      finished_.notify_one();
    }
    left = left_;
  }
}

void ThreadRunner::Serve(int32_t worker) {
  const auto called = [this] { return IsCalled(); };
  while (!stop_) {
    LookFor(called);
    if (!IsCalled()) {
      std::unique_lock<std::mutex> lock(sleep_);
      ++idle_;
      wake_.wait(lock, called);
      --idle_;
    }
    Work(worker);
  }
}

int ThreadRunner::Run(void* runner_data, sf_job job, void* job_data, int32_t count) {
  if (runner_data == nullptr || job == nullptr || count < 0) return 1;
  ThreadRunner* self = static_cast<ThreadRunner*>(runner_data);
  std::lock_guard<std::mutex> turn(self->turn_);
  self->batch_ = {job, job_data, count};
  self->undone_ = count;
  self->left_ = count;
  if (count > 1 && self->idle_ > 0) {
    { std::lock_guard<std::mutex> lock(self->sleep_); }
    self->wake_.notify_all();
  }
  self->Work(0);
  const auto done = [self] { return self->IsDone(); };
  LookFor(done);
  if (done()) return 0;
  std::unique_lock<std::mutex> lock(self->sleep_);
  self->waiting_ = true;
  self->finished_.wait(lock, done);
  self->waiting_ = false;
  return 0;
}

int HardwareWorkers() {
  const unsigned threads = std::thread::hardware_concurrency();
  return std::clamp(static_cast<int>(threads), 1, int{SF_MAX_WORKERS});
}

}  // namespace starfocus
