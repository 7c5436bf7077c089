/* SPDX-License-Identifier: Apache-2.0 */
/** @file
 * The library starfocus_pool (CMake: starfocus::pool): a thread pool for callers that have no
 * thread pool. starfocus_pool requires POSIX threads, but does not link the engine.
 *
 * @code
 * starfocus_pool* pool = starfocus_pool_create(0);
 * config.max_workers = starfocus_pool_workers(pool);
 * // ... create the engine ...
 * starfocus_callbacks callbacks = {0};
 * callbacks.runner = starfocus_pool_run;
 * callbacks.runner_data = pool;
 * starfocus_set_callbacks(engine, &callbacks);
 * starfocus_refocus(engine, &params, &light_field, &out, NULL);
 * starfocus_pool_destroy(pool);
 * @endcode
 */
#ifndef STARFOCUS_POOL_H_
#define STARFOCUS_POOL_H_

#include "starfocus/starfocus.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A pool of threads. */
typedef struct starfocus_pool starfocus_pool;

/** Returns the number of cores that this process may use and that are fast enough for a worker. On
 *  Linux, the scheduler affinity and the quota of the control groups limit the cores. A fast core
 *  has at least half the capacity of the strongest core (cpu_capacity), or 3/4 of the highest clock
 *  frequency (cpuinfo_max_freq). A stripe is finished only when its last job is done, so a slow
 *  core would cost more time than it saves.
 *  @return number of cores, [1, STARFOCUS_MAX_WORKERS] */
STARFOCUS_API int32_t starfocus_pool_cores(void);

/** Creates a pool. On systems with big and small cores, the threads run only on the big cores if
 *  the system has a big core for each worker. Free the pool with starfocus_pool_destroy.
 *  @param workers number of workers, at most STARFOCUS_MAX_WORKERS; 0 or less:
 *         starfocus_pool_cores(). The caller of starfocus_pool_run is one of the workers, so a
 *         pool of n workers starts n - 1 threads. The pool has fewer workers if the system
 *         cannot start all threads
 *  @return the pool, or null if memory could not be allocated */
STARFOCUS_API starfocus_pool* starfocus_pool_create(int32_t workers);

/** Returns the number of workers, for starfocus_config.max_workers.
 *  @param pool pool
 *  @return number of workers of the pool; 0 for a null pool */
STARFOCUS_API int32_t starfocus_pool_workers(const starfocus_pool* pool);

/** Runs jobs on the threads of a pool. starfocus_pool_run has the type starfocus_runner. The
 *  calling thread is worker 0. If several threads call starfocus_pool_run with one pool, the calls
 *  take turns. A job must not call starfocus_pool_run with its own pool. An idle thread polls for
 *  new jobs for a tenth of a millisecond and then sleeps.
 *  @param pool the pool, as starfocus_callbacks.runner_data
 *  @param job called with every index in [0, count)
 *  @param job_data first argument of `job`
 *  @param count number of jobs
 *  @return 0 when all jobs are done; another value for a null pool, a null job or a negative count
 */
STARFOCUS_API int starfocus_pool_run(void* pool, starfocus_job job, void* job_data, int32_t count);

/** Ends the threads and frees the pool. No call of starfocus_pool_run with this pool may be
 *  running.
 *  @param pool pool; no-op if null */
STARFOCUS_API void starfocus_pool_destroy(starfocus_pool* pool);

#ifdef __cplusplus
}
#endif

#endif /* STARFOCUS_POOL_H_ */
