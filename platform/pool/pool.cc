// SPDX-License-Identifier: Apache-2.0
// Implements starfocus/pool.h with POSIX threads. The pool calls no function of the C++ run time,
// so C programs can link the library starfocus_pool.
#include "starfocus/pool.h"

#include <pthread.h>
#include <sched.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "platform/pool/big_cores.h"
#include "platform/pool/quota.h"

namespace {

// Time in ns for which a thread polls before it sleeps. The polling time is longer than the pause
// of the engine between two batches of jobs, but short enough to waste little processor time.
constexpr int64_t kPatience = 100000;

int64_t Now() {
  timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return int64_t{now.tv_sec} * 1000000000 + now.tv_nsec;
}

// Polls `ready` until it returns true, for at most kPatience.
template <class Ready>
void LookFor(const Ready& ready) {
  const int64_t end = Now() + kPatience;
  while (!ready() && Now() < end) sched_yield();
}

// Locks a mutex in the constructor and unlocks it in the destructor.
class Lock {
 public:
  explicit Lock(pthread_mutex_t* mutex) : mutex_(mutex) { pthread_mutex_lock(mutex_); }
  ~Lock() { pthread_mutex_unlock(mutex_); }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  pthread_mutex_t* const mutex_;
};

// The arguments of a call of starfocus_pool_run.
struct Batch {
  starfocus_job job;
  void* data;
  int32_t count;
};

struct Thread {
  starfocus_pool* pool;
  pthread_t id;
  int32_t worker;
};

}  // namespace

// Batches of jobs follow each other within microseconds, which is less than the time to wake a
// thread. A thread without work therefore polls for kPatience and yields to other threads before it
// sleeps.
struct starfocus_pool {
  int32_t threads = 0;  // Number of started threads.
  Thread started[STARFOCUS_MAX_WORKERS - 1];
  starfocus::CoreSet cores;  // Cores that the threads run on; empty: any core.

  pthread_mutex_t turn = PTHREAD_MUTEX_INITIALIZER;  // Mutex that a caller holds during its batch.
  Batch batch = {nullptr, nullptr, 0};
  // Number of jobs of the batch that no thread has taken. A thread that has taken a job may read
  // `batch` until the thread decrements `undone`.
  std::atomic<int32_t> left{0};
  std::atomic<int32_t> undone{0};  // Number of jobs of the batch that are not done.
  std::atomic<int32_t> stop{0};    // Set to 1 when the threads must end.

  // A thread that is about to sleep first sets `idle` or `waiting` and then checks `left`, `undone`
  // and `stop` again. The function starfocus_pool_run sets `left` before it checks `idle`, and Work
  // decrements `undone` before it checks `waiting`. This order of writes and checks ensures that no
  // wake-up is lost.
  std::atomic<int32_t> idle{0};     // Number of threads that wait for `wake`.
  std::atomic<int32_t> waiting{0};  // Set to 1 while the caller waits for `finished`.
  pthread_mutex_t sleep = PTHREAD_MUTEX_INITIALIZER;  // Mutex of `wake` and `finished`.
  pthread_cond_t wake = PTHREAD_COND_INITIALIZER;
  pthread_cond_t finished = PTHREAD_COND_INITIALIZER;

  bool IsCalled() const { return left > 0 || stop != 0; }
  bool IsDone() const { return undone == 0; }
};

namespace {

// Takes and runs jobs until no jobs are left. Wakes the caller of starfocus_pool_run after the last
// job.
void Work(starfocus_pool* pool, int32_t worker) {
  int32_t left = pool->left;
  while (left > 0) {
    if (!pool->left.compare_exchange_weak(left, left - 1)) continue;
    pool->batch.job(pool->batch.data, pool->batch.count - left, worker);
    if (--pool->undone == 0 && pool->waiting != 0) {
      // The caller of starfocus_pool_run either sleeps, or holds the mutex and checks `undone`
      // before it sleeps. Locking the mutex waits until the caller has checked `undone`, so the
      // caller cannot miss the signal.
      { const Lock lock(&pool->sleep); }
      pthread_cond_signal(&pool->finished);
    }
    left = pool->left;
  }
}

void* Serve(void* data) {
  const Thread& thread = *static_cast<const Thread*>(data);
  starfocus_pool* const pool = thread.pool;
  if (pool->cores.Count() > 0) starfocus::RunOn(pool->cores);
  while (pool->stop == 0) {
    LookFor([pool] { return pool->IsCalled(); });
    if (!pool->IsCalled()) {
      const Lock lock(&pool->sleep);
      ++pool->idle;
      while (!pool->IsCalled()) pthread_cond_wait(&pool->wake, &pool->sleep);
      --pool->idle;
    }
    Work(pool, thread.worker);
  }
  return nullptr;
}

void WaitForAll(starfocus_pool* pool) {
  LookFor([pool] { return pool->IsDone(); });
  if (pool->IsDone()) return;
  const Lock lock(&pool->sleep);
  pool->waiting = 1;
  while (!pool->IsDone()) pthread_cond_wait(&pool->finished, &pool->sleep);
  pool->waiting = 0;
}

int32_t Clamp(int64_t value) {
  if (value < 1) return 1;
  return value > STARFOCUS_MAX_WORKERS ? STARFOCUS_MAX_WORKERS : static_cast<int32_t>(value);
}

int32_t CountCores(const starfocus::CoreSet& big) {
  const int count = big.Count();
  const int32_t cores = Clamp(count > 0 ? count : sysconf(_SC_NPROCESSORS_ONLN));
  const int quota = starfocus::QuotaCores("/proc/self/cgroup", "/sys/fs/cgroup");
  return quota > 0 && quota < cores ? quota : cores;
}

}  // namespace

int32_t starfocus_pool_cores(void) { return CountCores(starfocus::BigCores()); }

starfocus_pool* starfocus_pool_create(int32_t workers) {
  void* const memory = std::malloc(sizeof(starfocus_pool));
  if (memory == nullptr) return nullptr;
  starfocus_pool* const pool = new (memory) starfocus_pool();
  const starfocus::CoreSet big = starfocus::BigCores();
  const int32_t wanted = workers <= 0 ? CountCores(big) : Clamp(workers);
  if (wanted <= big.Count()) pool->cores = big;
  for (int32_t worker = 1; worker < wanted; ++worker) {
    Thread& thread = pool->started[pool->threads];
    thread.pool = pool;
    thread.worker = worker;
    if (pthread_create(&thread.id, nullptr, Serve, &thread) != 0) break;
    ++pool->threads;
  }
  return pool;
}

int32_t starfocus_pool_workers(const starfocus_pool* pool) {
  return pool == nullptr ? 0 : pool->threads + 1;
}

int starfocus_pool_run(void* data, starfocus_job job, void* job_data, int32_t count) {
  if (data == nullptr || job == nullptr || count < 0) return 1;
  starfocus_pool* const pool = static_cast<starfocus_pool*>(data);
  const Lock turn(&pool->turn);
  pool->batch = {job, job_data, count};
  pool->undone = count;
  pool->left = count;
  if (count > 1 && pool->idle > 0) {
    { const Lock lock(&pool->sleep); }
    pthread_cond_broadcast(&pool->wake);
  }
  Work(pool, 0);
  WaitForAll(pool);
  return 0;
}

void starfocus_pool_destroy(starfocus_pool* pool) {
  if (pool == nullptr) return;
  {
    const Lock lock(&pool->sleep);
    pool->stop = 1;
  }
  pthread_cond_broadcast(&pool->wake);
  for (int32_t thread = 0; thread < pool->threads; ++thread) {
    pthread_join(pool->started[thread].id, nullptr);
  }
  pthread_mutex_destroy(&pool->turn);
  pthread_mutex_destroy(&pool->sleep);
  pthread_cond_destroy(&pool->wake);
  pthread_cond_destroy(&pool->finished);
  pool->~starfocus_pool();
  std::free(pool);
}
