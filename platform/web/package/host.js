// SPDX-License-Identifier: Apache-2.0
// Hides the differences between browsers and node: reading files, starting workers, and exchanging messages with
// workers.

const inNode = typeof process === 'object' && process.release?.name === 'node';

/** Returns the bytes of a file of this package. */
export async function readFile(name) {
  const url = new URL(`./${name}`, import.meta.url);
  if (inNode) return (await import('node:fs/promises')).readFile(url);
  const response = await fetch(url);
  if (!response.ok) throw new Error(`Cannot load ${url}: the server returned status ${response.status}.`);
  return response.arrayBuffer();
}

/** Starts a worker that runs worker.js. */
export async function startWorker() {
  if (inNode) {
    const {Worker} = await import('node:worker_threads');
    return new Worker(new URL('./worker.js', import.meta.url));
  }
  return new Worker(new URL('./worker.js', import.meta.url), {type: 'module'});
}

/** Returns the port through which a worker exchanges messages with its parent. */
export async function parentOfWorker() {
  return inNode ? (await import('node:worker_threads')).parentPort : self;
}

/** Calls onMessage with each message from the other side, and onError with an error message if the other side fails. */
export function listen(port, onMessage, onError = () => {}) {
  if (inNode) {
    port.on('message', onMessage);
    port.on('error', error => onError(error.message));
    return;
  }
  port.onmessage = event => onMessage(event.data);
  port.onerror = event => onError(event.message ?? 'A worker of starfocus could not be loaded.');
}

/** True if memory can be shared with workers: in node, and in pages that are cross-origin isolated. */
export const canShare = inNode || globalThis.crossOriginIsolated === true;

/** Returns the number of cores that the system reports. */
export async function countCores() {
  if (inNode) return (await import('node:os')).cpus().length;
  return navigator.hardwareConcurrency ?? 1;
}
