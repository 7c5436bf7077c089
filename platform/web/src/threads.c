/* SPDX-License-Identifier: Apache-2.0 */
#include "platform/web/src/threads.h"

/* The current set of jobs. The fields job, data and count change only while no helper reads these
 * fields: after the end of a set, and before the announcement of the next set. */
static struct {
  starfocus_job job;
  void* data;
  int32_t count;
  int32_t next;    /* smallest index of a job that is not taken */
  int32_t busy;    /* number of helpers that have not finished the set */
  int32_t sets;    /* number of sets so far; incrementing it announces a set */
  int32_t helpers; /* number of helpers */
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
