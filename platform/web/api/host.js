// SPDX-License-Identifier: Apache-2.0
// Starts workers. The functions for browsers are defined here; node.js replaces them by functions for node.

import source from 'worker-source';

let address;  // blob URL of the worker's source; valid as long as the page

const browser = {
  /** True if memory can be shared with workers, which requires a page that is cross-origin isolated. */
  canShare: () => globalThis.crossOriginIsolated === true,

  countCores: () => globalThis.navigator?.hardwareConcurrency ?? 1,

  /** Starts the engine's worker and returns {post, terminate, ref}. `file` is the address of worker.js, or undefined
   *  for the source in this module. */
  start(file, onMessage, onError) {
    if (typeof Worker !== 'function') throw new Error('there are no workers here');
    if (!file) address ??= URL.createObjectURL(new Blob([source], {type: 'text/javascript'}));
    const worker = new Worker(file ?? address);
    worker.onmessage = event => onMessage(event.data);
    worker.onerror = event => {
      event.preventDefault?.();
      onError(event.message || 'its script could not be loaded, or the Content-Security-Policy forbids it (worker-src)');
    };
    return {
      post: (message, transfer) => worker.postMessage(message, transfer),
      terminate: () => worker.terminate(),
      ref() {}
    };
  }
};

export let host = browser;

/** Replaces the functions for browsers. */
export function setHost(other) {
  host = other;
}
