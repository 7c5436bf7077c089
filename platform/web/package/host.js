// SPDX-License-Identifier: Apache-2.0
// What browsers and node do differently: files, workers and their messages.

const inNode = typeof process === 'object' && process.release?.name === 'node';

/** Returns the bytes of a file of this package. */
export async function readFile(name) {
  const url = new URL(`./${name}`, import.meta.url);
  if (inNode) return (await import('node:fs/promises')).readFile(url);
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${url} cannot be loaded: the server says ${response.status}.`);
  return response.arrayBuffer();
}

/** Starts another worker.js. */
export async function startWorker() {
  if (inNode) {
    const {Worker} = await import('node:worker_threads');
    return new Worker(new URL('./worker.js', import.meta.url));
  }
  return new Worker(new URL('./worker.js', import.meta.url), {type: 'module'});
}

/** Returns what a worker exchanges messages with its parent by. */
export async function parentOfWorker() {
  return inNode ? (await import('node:worker_threads')).parentPort : self;
}

/** Calls onMessage with what the other side posts, and onError with a sentence if it fails. */
export function listen(port, onMessage, onError = () => {}) {
  if (inNode) {
    port.on('message', onMessage);
    port.on('error', error => onError(error.message));
    return;
  }
  port.onmessage = event => onMessage(event.data);
  port.onerror = event => onError(event.message ?? 'A worker of starfocus could not be loaded.');
}

/** Whether memory may be shared with workers: of pages, only those that are isolated. */
export const canShare = inNode || globalThis.crossOriginIsolated === true;

/** Returns the number of cores that the machine tells. */
export async function countCores() {
  if (inNode) return (await import('node:os')).cpus().length;
  return navigator.hardwareConcurrency ?? 1;
}
