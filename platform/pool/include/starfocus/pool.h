/* SPDX-License-Identifier: Apache-2.0 */
/* starfocus: a pool of threads for those who have none of their own. C ABI; a library by itself
 * (starfocus_pool, CMake starfocus::pool), which needs POSIX threads and nothing of the engine.
 *
 *   sf_pool* pool = sf_pool_create(0);
 *   config.max_workers = sf_pool_workers(pool);
 *   ...
 *   callbacks.runner = sf_pool_run;
 *   callbacks.runner_data = pool;
 *   sf_set_callbacks(engine, &callbacks);
 *   sf_refocus(engine, &params, &light_field, &out, NULL);
 *   sf_pool_destroy(pool);
 */
#ifndef STARFOCUS_POOL_H_
#define STARFOCUS_POOL_H_

#include "starfocus/starfocus.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Threads that wait for jobs, among them whoever calls sf_pool_run. */
typedef struct sf_pool sf_pool;

/** The cores that are worth a worker here: those that this process may run on and, where the system
 *  tells (Linux: cpu_capacity, else cpuinfo_max_freq), at least half as strong as the strongest or
 *  clocked at three quarters of the fastest; in [1, SF_MAX_WORKERS]. A stripe of a picture is done
 *  when its last job is, so that a small core costs more time than it saves. */
SF_API int32_t sf_pool_cores(void);

/** Makes a pool of `workers`, the caller of sf_pool_run included, so that one thread less is
 *  started; 0 or less: sf_pool_cores(), more than SF_MAX_WORKERS: that many. Where the system tells
 *  which cores are the big ones, and there are enough of them, threads run on those alone; the
 *  caller's thread stays as it is. Where the system refuses a thread there are fewer workers. Null
 *  when there is no memory. */
SF_API sf_pool* sf_pool_create(int32_t workers);

/** Workers of the pool: what sf_config.max_workers must be at least. */
SF_API int32_t sf_pool_workers(const sf_pool* pool);

/** An sf_runner, whose runner_data is the pool: calls the job with every index in [0, count) and
 *  returns when all are done, 0; not 0 for a null pool or job or a negative count. The caller is
 *  worker 0. Calls from several threads take turns; a job must not call it with the same pool.
 *  Threads that have nothing to do look for more for a tenth of a millisecond and then sleep. */
SF_API int sf_pool_run(void* pool, sf_job job, void* job_data, int32_t count);

/** Ends the threads and frees the pool, in which no call may be running; null: nothing happens. */
SF_API void sf_pool_destroy(sf_pool* pool);

#ifdef __cplusplus
}
#endif

#endif /* STARFOCUS_POOL_H_ */
