// SPDX-License-Identifier: Apache-2.0
// Calls the functions of pixels_worker.js and heic.js.

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

/** Decodes a HEIC file, as read() of heic.js. The memory of the decoder is freed with its worker. Resolves with null if
 *  the site has no decoder. */
export function decodeHeic(file) {
  const decoder = new Worker(new URL('heic.js', import.meta.url));
  return new Promise((resolve, reject) => {
    decoder.onmessage = ({data: {result, error}}) => {
      if (error === undefined) resolve(result);
      else reject(new Error(`${file.name} cannot be decoded: ${error}.`));
    };
    decoder.onerror = () => reject(new Error(`${file.name} cannot be decoded: the decoder failed.`));
    decoder.postMessage(file);
  }).finally(() => decoder.terminate());
}
