/* SPDX-License-Identifier: Apache-2.0 */
/* Runner of the engine on Web Workers. Each worker is an instance of the module, and all instances
 * share one memory. The worker that makes the calls is worker 0; the others are helpers. */
#ifndef STARFOCUS_PLATFORM_WEB_SRC_THREADS_H_
#define STARFOCUS_PLATFORM_WEB_SRC_THREADS_H_

#include "starfocus/starfocus.h"

/* Sets the number of helpers. Must be called before the first run. A run completes only after every
 * helper has taken part. */
void SetHelpers(int32_t helpers);

/* Runs jobs of all runs as worker `worker`, in [1, helpers]. Called by a helper. Never returns. */
void Help(int32_t worker);

/* A starfocus_runner. The calling thread is worker 0; `data` is ignored. Returns 0. */
int RunOnWorkers(void* data, starfocus_job job, void* job_data, int32_t count);

#endif /* STARFOCUS_PLATFORM_WEB_SRC_THREADS_H_ */
