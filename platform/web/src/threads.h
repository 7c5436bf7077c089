/* SPDX-License-Identifier: Apache-2.0 */
/* The engine's runner on Web Workers: instances of this module on one shared memory. */
#ifndef STARFOCUS_PLATFORM_WEB_SRC_THREADS_H_
#define STARFOCUS_PLATFORM_WEB_SRC_THREADS_H_

#include "starfocus/starfocus.h"

/* Says how many helpers there will be, before the first run. A run waits until all of them have
 * come. */
void SetHelpers(int32_t helpers);

/* Takes part in all runs as that worker, in [1, helpers]; never returns. */
void Help(int32_t worker);

/* A starfocus_runner: the calling thread is worker 0. */
int RunOnWorkers(void* data, starfocus_job job, void* job_data, int32_t count);

#endif /* STARFOCUS_PLATFORM_WEB_SRC_THREADS_H_ */
