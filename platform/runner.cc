// SPDX-License-Identifier: Apache-2.0
#include "platform/runner.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <new>

namespace starfocus {
namespace {

// A set of jobs, and the first exception that a job threw. Exceptions must not leave a thread of
// the pool.
struct Guarded {
  starfocus_job job;
  void* data;
  std::atomic<bool> failed{false};
  std::mutex mutex{};  // protects `failure`
  std::exception_ptr failure{};

  static void Run(void* guarded, int32_t index, int32_t worker) {
    Guarded& self = *static_cast<Guarded*>(guarded);
    if (self.failed) return;
    try {
      self.job(self.data, index, worker);
    } catch (...) {
      const std::lock_guard<std::mutex> lock(self.mutex);
      if (self.failure == nullptr) self.failure = std::current_exception();
      self.failed = true;
    }
  }
};

}  // namespace

ThreadRunner::ThreadRunner(int workers) : pool_(starfocus_pool_create(std::max(workers, 1))) {
  if (pool_ == nullptr) throw std::bad_alloc();
}

int ThreadRunner::Run(void* runner_data, starfocus_job job, void* job_data, int32_t count) {
  if (runner_data == nullptr || job == nullptr) return 1;
  Guarded guarded{job, job_data};
  const int status = starfocus_pool_run(static_cast<ThreadRunner*>(runner_data)->pool_.get(),
                                        Guarded::Run, &guarded, count);
  if (guarded.failure != nullptr) std::rethrow_exception(guarded.failure);
  return status;
}

}  // namespace starfocus
