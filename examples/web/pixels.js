// SPDX-License-Identifier: Apache-2.0
// Calls the functions of pixels_worker.js, heic.js and segmenter.js.

let worker = null, lastId = 0;
const waiting = new Map();

function start() {
  worker = new Worker(new URL('pixels_worker.js', import.meta.url));
  worker.onmessage = ({data: {id, result, error}}) => {
    const {resolve, reject} = waiting.get(id);
    waiting.delete(id);
    if (error === undefined) resolve(result);
    else reject(new Error(error));
  };
  worker.onerror = () => {
    for (const {reject} of waiting.values()) reject(new Error('A part of the page could not be loaded. Reload the page.'));
    waiting.clear();
    worker = null;
  };
}

/** Calls the function `name` of the worker, and resolves with its result. `transfer` are objects that move to the
 *  worker. */
export function call(name, values, transfer = []) {
  if (!worker) start();
  return new Promise((resolve, reject) => {
    waiting.set(++lastId, {resolve, reject});
    worker.postMessage({id: lastId, name, values}, transfer);
  });
}

/** Sends a message to a new worker, and resolves with the result. The worker ends after its answer, or if the signal is
 *  aborted, so that its memory is freed. The error of a failure begins with `problem`. */
function ask(script, message, problem, signal) {
  const asked = new Worker(new URL(script, import.meta.url));
  return new Promise((resolve, reject) => {
    asked.onmessage = ({data: {result, error}}) => {
      if (error === undefined) resolve(result);
      else reject(new Error(`${problem}: ${error}.`));
    };
    asked.onerror = () => reject(new Error(`${problem}: a part of the page failed.`));
    signal?.addEventListener('abort', () => reject(signal.reason));
    asked.postMessage(message);
  }).finally(() => asked.terminate());
}

/** Decodes a HEIC file, as read() of heic.js. Resolves with null if the site has no decoder. */
export const decodeHeic = file => ask('heic.js', file, `${file.name} cannot be decoded`);

/** Finds the person in a photo, a Blob or an ImageBitmap. Resolves with the matte, a grey PNG file. */
export const segment = (photo, name, signal) => ask('segmenter.js', photo, `No person was found in ${name}`, signal);

/** Returns true if the site has a segmenter. */
export const hasSegmenter = () => fetch('segmenter/package.json', {method: 'HEAD'}).then(({ok}) => ok, () => false);
