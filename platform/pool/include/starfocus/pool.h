/* SPDX-License-Identifier: Apache-2.0 */
/* starfocus: a pool of threads for those who have none of their own. C ABI; a library by itself
 * (starfocus_pool, CMake starfocus::pool), which needs POSIX threads and nothing of the engine.
 *
 *   starfocus_pool* pool = starfocus_pool_create(0);
 *   config.max_workers = starfocus_pool_workers(pool);
 *   ...
 *   callbacks.runner = starfocus_pool_run;
 *   callbacks.runner_data = pool;
 *   starfocus_set_callbacks(engine, &callbacks);
 *   starfocus_refocus(engine, &params, &light_field, &out, NULL);
 *   starfocus_pool_destroy(pool);
 */
#ifndef STARFOCUS_POOL_H_
#define STARFOCUS_POOL_H_

#include "starfocus/starfocus.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Threads that wait for jobs, among them whoever calls starfocus_pool_run. */
typedef struct starfocus_pool starfocus_pool;

/** The cores that are worth a worker here: those that this process may run on and, where the system
 *  tells (Linux: cpu_capacity, else cpuinfo_max_freq), at least half as strong as the strongest or
 *  clocked at three quarters of the fastest; in [1, STARFOCUS_MAX_WORKERS]. A stripe of a picture
 * is done when its last job is, so that a small core costs more time than it saves. */
STARFOCUS_API int32_t starfocus_pool_cores(void);

/** Makes a pool of `workers`, the caller of starfocus_pool_run included, so that one thread less is
 *  started; 0 or less: starfocus_pool_cores(), more than STARFOCUS_MAX_WORKERS: that many. Where
 * the system tells which cores are the big ones, and there are enough of them, threads run on those
 * alone; the caller's thread stays as it is. Where the system refuses a thread there are fewer
 * workers. Null when there is no memory. */
STARFOCUS_API starfocus_pool* starfocus_pool_create(int32_t workers);

/** Workers of the pool: what starfocus_config.max_workers must be at least. */
STARFOCUS_API int32_t starfocus_pool_workers(const starfocus_pool* pool);

/** A starfocus_runner, whose runner_data is the pool: calls the job with every index in [0, count)
 * and returns when all are done, 0; not 0 for a null pool or job or a negative count. The caller is
 *  worker 0. Calls from several threads take turns; a job must not call it with the same pool.
 *  Threads that have nothing to do look for more for a tenth of a millisecond and then sleep. */
STARFOCUS_API int starfocus_pool_run(void* pool, starfocus_job job, void* job_data, int32_t count);

/** Ends the threads and frees the pool, in which no call may be running; null: nothing happens. */
STARFOCUS_API void starfocus_pool_destroy(starfocus_pool* pool);

#ifdef __cplusplus
}
#endif

#endif /* STARFOCUS_POOL_H_ */
