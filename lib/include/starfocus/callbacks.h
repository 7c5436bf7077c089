/* SPDX-License-Identifier: Apache-2.0 */
/* starfocus: functions of the caller that the engine calls. Part of starfocus.h. They must return:
 * no exception and no longjmp may leave them. */
#ifndef STARFOCUS_CALLBACKS_H_
#define STARFOCUS_CALLBACKS_H_

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A job of the engine: call it with every index in [0, count) exactly once. `worker` is in
 *  [0, max_workers); two jobs that run at the same time must have different workers. A call that
 *  breaks this does nothing, and the engine's call then returns STARFOCUS_ERROR_RUNNER. */
typedef void (*starfocus_job)(void* job_data, int32_t index, int32_t worker);

/** Runs a set of jobs, in any order (the longest come first), and returns when all are done; 0 for
 *  success. Never called with count 0. Jobs that it has left running are waited for, and those it
 *  has left out are no longer run: both are STARFOCUS_ERROR_RUNNER. */
typedef int (*starfocus_runner)(void* runner_data, starfocus_job job, void* job_data,
                                int32_t count);

/** Receives the number of finished rows, of `rows`. Returns 0 to continue, anything else to cancel:
 * the call then returns STARFOCUS_ERROR_CANCELLED as soon as all of its threads have stopped, and
 * the function is not called again. The output is unspecified then; the engine is as before the
 * call (of streams see starfocus_stream_pull). Within a call rows_done never decreases and ends at
 * `rows`. The function is called at every job and after approximately every 500,000 samples, a
 * fraction of a millisecond on a desktop: by the thread of the call or, with a runner, by any
 * thread that runs a job, but never by two at a time. It must not call anything with the same
 * engine or memory. */
typedef int (*starfocus_progress)(void* data, int32_t rows_done, int32_t rows);

/** A clock in nanoseconds, from any start; called from the runner's threads. */
typedef uint64_t (*starfocus_clock)(void);

/** A block of STARFOCUS_MODE_BLOCK as it was refocused. */
typedef struct starfocus_block {
  int32_t x, y;   /**< top left corner in the picture, pixels */
  int32_t width;  /**< pixels; less than the side at the right edge of the picture */
  int32_t height; /**< pixels; less than the side at the bottom edge of the picture */
  int32_t layer;  /**< L: rendered at 1 / 2^L of the size */
  int32_t n;      /**< N; 0: no views but the centre */
} starfocus_block;

/** Is told of each block, by the thread of the call, before the block is refocused. */
typedef void (*starfocus_block_visitor)(void* data, const starfocus_block* block);

/** The caller's functions, each of which may be null, and the data that each receives. */
typedef struct starfocus_callbacks {
  starfocus_runner runner;     /**< runs the jobs of a call; null: the calling thread runs them one
                             after the other as worker 0 */
  void* runner_data;           /**< passed to runner */
  starfocus_progress progress; /**< receives the finished rows of the picture, region or preview */
  void* progress_data;         /**< passed to progress */
  starfocus_clock clock;       /**< fills the times of starfocus_report; null: they stay 0 */
  starfocus_block_visitor on_block; /**< receives each block of a refocusing */
  void* on_block_data;              /**< passed to on_block */
} starfocus_callbacks;

#ifdef __cplusplus
}
#endif

#endif /* STARFOCUS_CALLBACKS_H_ */
