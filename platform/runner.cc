// SPDX-License-Identifier: Apache-2.0
#include "platform/runner.h"

#include <algorithm>
#include <chrono>
#include <new>
#include <system_error>
#include <utility>

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
  } catch (const std::bad_alloc&) {
    // The same where there is no memory for a thread.
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

// An exception must not leave a thread of the pool, nor the batch while others work on it.
void ThreadRunner::RunJob(int32_t index, int32_t worker) {
  if (failed_) return;
  try {
    batch_.job(batch_.data, index, worker);
  } catch (...) {
    const std::lock_guard<std::mutex> lock(sleep_);
    if (failure_ == nullptr) failure_ = std::current_exception();
    failed_ = true;
  }
}

// The batch is done and its turn still held.
void ThreadRunner::Rethrow() {
  if (!failed_) return;
  failed_ = false;
  std::rethrow_exception(std::exchange(failure_, nullptr));
}

void ThreadRunner::Work(int32_t worker) {
  int32_t left = left_;
  while (left > 0) {
    if (!left_.compare_exchange_weak(left, left - 1)) continue;
    RunJob(batch_.count - left, worker);
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
  if (!done()) {
    std::unique_lock<std::mutex> lock(self->sleep_);
    self->waiting_ = true;
    self->finished_.wait(lock, done);
    self->waiting_ = false;
  }
  self->Rethrow();
  return 0;
}

int HardwareWorkers() {
  const unsigned threads = std::thread::hardware_concurrency();
  return std::clamp(static_cast<int>(threads), 1, int{SF_MAX_WORKERS});
}

}  // namespace starfocus
