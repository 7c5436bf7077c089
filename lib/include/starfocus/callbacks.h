/* SPDX-License-Identifier: Apache-2.0 */
/** @file
 * Callbacks, which are functions of the caller that an engine calls. Part of starfocus.h.
 *
 * No exception and no longjmp may leave a callback.
 */
#ifndef STARFOCUS_CALLBACKS_H_
#define STARFOCUS_CALLBACKS_H_

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Function of the engine that runs one job of a set. The runner calls this function once with
 *  every index in [0, count). An invalid call of this function does nothing, and the API call that
 *  started the jobs returns STARFOCUS_ERROR_RUNNER.
 *  @param job_data pointer that the runner received
 *  @param index index of the job
 *  @param worker worker in [0, max_workers). Jobs that run at the same time must use different
 *         workers */
typedef void (*starfocus_job)(void* job_data, int32_t index, int32_t worker);

/** Runs a set of jobs in any order and returns when all jobs are done. Jobs with small indices take
 *  the longest time. If the runner returns before all jobs are done, the engine waits for running
 *  jobs and rejects jobs that start later. In this case, the engine's call returns
 *  STARFOCUS_ERROR_RUNNER.
 *  @param runner_data starfocus_callbacks.runner_data
 *  @param job function to call
 *  @param job_data first argument of `job`
 *  @param count number of jobs, > 0
 *  @return 0 for success; another value makes the engine's call return STARFOCUS_ERROR_RUNNER */
typedef int (*starfocus_runner)(void* runner_data, starfocus_job job, void* job_data,
                                int32_t count);

/** Receives the progress of a call and may cancel the call. The engine calls this callback at every
 *  job and about every 500,000 samples, which take a fraction of a millisecond on a desktop. With a
 *  runner, any thread that runs a job may call the callback, but only one thread at a time does so.
 *  The callback must not use the engine or the engine's memory.
 *
 *  After cancellation the callback is not called again, and the engine's call returns
 *  STARFOCUS_ERROR_CANCELLED as soon as all workers have stopped. The output of a cancelled call is
 *  unspecified, and the engine can be used again. For streams, see starfocus_stream_pull.
 *  @param data starfocus_callbacks.progress_data
 *  @param rows_done number of finished rows, which never decreases within a call and ends at
 *         `rows`. In functions that write a picture, except streams, the first `rows_done` rows of
 *         the output are complete and do not change again
 *  @param rows number of all rows
 *  @return 0 to continue; another value cancels the call */
typedef int (*starfocus_progress)(void* data, int32_t rows_done, int32_t rows);

/** Returns a time in nanoseconds since an arbitrary fixed moment. The threads of the runner call
 *  this function. */
typedef uint64_t (*starfocus_clock)(void);

/** A block of a picture, which is refocused with its own layer and number of views. */
typedef struct starfocus_block {
  int32_t x;      /**< Left column in the picture. */
  int32_t y;      /**< Top row in the picture. */
  int32_t width;  /**< Number of columns; may be less than `height` at the right edge. */
  int32_t height; /**< Number of rows; may be less than `width` at the bottom edge. */
  int32_t layer;  /**< Layer L: the block is rendered at 1 / 2^L of its size. */
  int32_t n; /**< N, the number of views along the aperture's radius; 0: only the centre view. */
} starfocus_block;

/** Receives each block before the block is refocused. The engine calls this function on the thread
 *  of the call.
 *  @param data starfocus_callbacks.on_block_data
 *  @param block the block, valid during the callback */
typedef void (*starfocus_block_visitor)(void* data, const starfocus_block* block);

/** Callbacks of an engine. Each function may be null. */
typedef struct starfocus_callbacks {
  starfocus_runner runner;     /**< Runs jobs; null: the calling thread runs them as worker 0. */
  void* runner_data;           /**< Passed to `runner`. */
  starfocus_progress progress; /**< Receives finished rows of the picture, region or preview. */
  void* progress_data;         /**< Passed to `progress`. */
  starfocus_clock clock; /**< Clock for the times in starfocus_report; if null, the times are 0. */
  starfocus_block_visitor on_block; /**< Receives each block before the block is refocused. */
  void* on_block_data;              /**< Passed to `on_block`. */
} starfocus_callbacks;

#ifdef __cplusplus
}
#endif

#endif /* STARFOCUS_CALLBACKS_H_ */
