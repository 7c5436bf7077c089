/* SPDX-License-Identifier: Apache-2.0 */
#include "platform/web/src/threads.h"

/* The set of jobs that runs. Its first three fields change only while no helper looks at them:
 * after all have left a set, and before the next one is announced. */
static struct {
  starfocus_job job;
  void* data;
  int32_t count;
  int32_t next;    /* the next index that nobody has taken */
  int32_t busy;    /* helpers that have not left the set yet */
  int32_t sets;    /* how many there were: a new number announces a set */
  int32_t helpers; /* that take part */
} set;

static void TakeJobs(int32_t worker) {
  for (;;) {
    const int32_t index = __atomic_fetch_add(&set.next, 1, __ATOMIC_SEQ_CST);
    if (index >= set.count) return;
    set.job(set.data, index, worker);
  }
}

void SetHelpers(int32_t helpers) { set.helpers = helpers; }

void Help(int32_t worker) {
  int32_t seen = 0;
  for (;;) {
    int32_t sets;
    while ((sets = __atomic_load_n(&set.sets, __ATOMIC_SEQ_CST)) == seen) {
      __builtin_wasm_memory_atomic_wait32(&set.sets, seen, -1);
    }
    seen = sets;
    TakeJobs(worker);
    if (__atomic_sub_fetch(&set.busy, 1, __ATOMIC_SEQ_CST) == 0) {
      __builtin_wasm_memory_atomic_notify(&set.busy, 1);
    }
  }
}

int RunOnWorkers(void* data, starfocus_job job, void* job_data, int32_t count) {
  (void)data;
  set.job = job;
  set.data = job_data;
  set.count = count;
  __atomic_store_n(&set.next, 0, __ATOMIC_SEQ_CST);
  __atomic_store_n(&set.busy, set.helpers, __ATOMIC_SEQ_CST);
  __atomic_add_fetch(&set.sets, 1, __ATOMIC_SEQ_CST);
  __builtin_wasm_memory_atomic_notify(&set.sets, (uint32_t)set.helpers);
  TakeJobs(0);
  int32_t busy;
  while ((busy = __atomic_load_n(&set.busy, __ATOMIC_SEQ_CST)) != 0) {
    __builtin_wasm_memory_atomic_wait32(&set.busy, busy, -1);
  }
  return 0;
}
