// SPDX-License-Identifier: Apache-2.0
// Entry of the package for node: starfocus.js with workers of node:worker_threads.

import os from 'node:os';
import {Worker} from 'node:worker_threads';
import source from 'worker-source';

import {_setHost} from './starfocus.js';

_setHost({
  canShare: () => true,
  countCores: () => os.availableParallelism?.() ?? os.cpus().length,
  start(file, onMessage, onError) {  // `file` is a script for browsers
    const worker = new Worker(source, {eval: true, workerData: {source}});
    worker.on('message', onMessage);
    worker.on('error', error => onError(error.message));
    worker.unref();
    return {
      post: (message, transfer) => worker.postMessage(message, transfer),
      terminate: () => void worker.terminate(),
      ref: busy => busy ? worker.ref() : worker.unref()
    };
  }
});

export * from './starfocus.js';
