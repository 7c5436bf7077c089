// SPDX-License-Identifier: Apache-2.0
// Messages of a worker in node. port.js has the same functions for browsers.

import {parentPort, Worker, workerData} from 'node:worker_threads';

export const post = (message, transfer = []) => parentPort.postMessage(message, transfer);

export function listen(onMessage) {
  parentPort.on('message', onMessage);
}

export function startHelper(message) {
  return new Promise((resolve, reject) => {
    const helper = new Worker(workerData.source, {eval: true, workerData});
    helper.once('message', resolve);
    helper.once('error', reject);
    helper.postMessage(message);
  });
}
