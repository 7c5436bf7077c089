// SPDX-License-Identifier: Apache-2.0
// Implements starfocus.d.ts for browsers and node. The engine runs in a worker (worker.js). This module checks the
// arguments of calls, sends the calls to the worker one at a time, and settles the promises of the calls with the
// worker's answers.

import {canShare, countCores, listen, startWorker} from './host.js';
import {checkCoverage, checkViews, readDepth} from './light_field.js';

export const Mode = {FRAME: 0, BENCHMARK: 1, BLOCK: 2, BLUR: 3};
export const Renderer = {AUTO: 0, LINE_SCAN: 1, SLICES: 2};
export const Shape = {FALL_OFF: 0, DISC: 1, POLYGON: 2, RING: 3};
export const Transfer = {SRGB: 0, NONE: 1};

const MAX_WORKERS = 64;
const PROGRESS_INTERVAL = 50;  // ms

// Options that cannot change after creation, because they determine the size or the contents of a prepared light field.
const FIXED = ['width', 'height', 'views', 'disparityMin', 'disparityMax', 'previews', 'maxLayer', 'transfer'];

/** See starfocus.d.ts. */
export class StarfocusError extends Error {
  constructor(message, status, field) {
    super(message);
    this.name = 'StarfocusError';
    this.status = status;
    this.field = field;
  }
}

class Refocuser {
  #worker;
  #calls = [];  // calls without an answer; the worker runs the first of them
  #lastId = 0;
  #failure = null;
  #shared = null;  // memory shared with the worker: id of the call to cancel, finished rows, number of rows
  #config;

  constructor(worker, config) {
    this.#worker = worker;
    this.#config = config;
    listen(worker, message => this.#hear(message), message => this.#fail(message));
  }

  async open(options) {
    const opened = await this.#call('open', options);
    const {shared} = opened;
    if (shared) this.#shared = new Int32Array(shared.memory.buffer, shared.address, 3);
    this.version = opened.version;
    this.threads = options.threads;
    return this;
  }

  async prepare(views, depth, {signal, coverage, transfer = false} = {}) {
    const {pixels, pixelBytes} = checkViews(views, this.#config);
    const map = readDepth(depth, this.#config);
    checkCoverage(coverage, this.#config);
    const given = [...pixels, ...(map.data === (depth?.data ?? depth) ? [map.data] : []),
                   ...(coverage ? [coverage] : [])];
    const buffers = transfer ? [...new Set(given.map(array => array.buffer))] : [];
    return this.#call('prepare', {views: pixels, pixelBytes, depth: map, coverage}, {signal}, buffers);
  }

  async configure(values) {
    const fixed = FIXED.find(name => name in values);
    if (fixed) throw new TypeError(`configure: '${fixed}' stays as it was when the refocuser was made.`);
    return this.#call('configure', values);
  }

  async preview(params = {}) {
    const {shift = 1, signal, ...rest} = params;
    if (![1, 2, 3].includes(shift)) throw new TypeError(`preview: expected a shift of 1, 2 or 3, found ${shift}.`);
    return this.#call('refocus', {shift, ...rest}, {signal});
  }

  refocus(params = {}) {
    const {signal, onProgress, ...rest} = params;
    const watched = Boolean(signal || onProgress);
    return this.#call('refocus', {shift: 0, watched, ...rest}, {signal, onProgress});
  }

  async focusAt(x, y) {
    if ((x | 0) !== x || (y | 0) !== y) throw new TypeError(`focusAt: expected whole numbers, found ${x}, ${y}.`);
    return this.#call('focusAt', {x, y});
  }

  close() {
    this.#fail('The refocuser was closed.');
    this.#worker.terminate();
  }

  #call(name, values, {signal, onProgress} = {}, transfer = []) {
    return new Promise((resolve, reject) => {
      if (this.#failure) return reject(new Error(this.#failure));
      if (signal?.aborted) return reject(signal.reason);
      const call = {id: ++this.#lastId, name, values, transfer, resolve, reject, signal, onProgress};
      call.abort = () => this.#cancel(call);
      signal?.addEventListener('abort', call.abort);
      this.#calls.push(call);
      if (this.#calls.length === 1) this.#send();
    });
  }

  #send() {
    const [call] = this.#calls;
    if (!call) return;
    const {id, name, values, transfer} = call;
    if (call.onProgress && this.#shared) {
      call.timer = setInterval(() => this.#tell(call), PROGRESS_INTERVAL);
    }
    try {
      this.#worker.postMessage({id, name, values}, transfer);
    } catch (error) {  // an argument that cannot be cloned
      this.#end(call, () => call.reject(error));
    }
  }

  /** Removes a call that has not started, or asks the worker to cancel a running call. */
  #cancel(call) {
    if (call !== this.#calls[0]) return this.#end(call, () => call.reject(call.signal.reason));
    if (this.#shared) Atomics.store(this.#shared, 0, call.id);
    this.#worker.postMessage({cancel: call.id});
  }

  #tell(call) {
    const [, done, rows] = this.#shared;
    if (rows > 0) call.onProgress(done, rows);
  }

  #hear({id, result, error, progress}) {
    const [call] = this.#calls;
    if (call?.id !== id) return;
    if (progress) return call.onProgress?.(...progress);
    this.#end(call, () => {
      if (!error) return call.resolve(result);
      if (error.cancelled && call.signal?.aborted) return call.reject(call.signal.reason);
      call.reject(error.status ? new StarfocusError(error.message, error.status, error.field)
                               : new TypeError(error.message));
    });
  }

  #end(call, settle) {
    const first = call === this.#calls[0];
    clearInterval(call.timer);
    this.#calls = this.#calls.filter(other => other !== call);
    call.signal?.removeEventListener('abort', call.abort);
    settle();
    if (first) this.#send();
  }

  #fail(message) {
    this.#failure ??= message;
    for (const call of this.#calls) {
      clearInterval(call.timer);
      call.signal?.removeEventListener('abort', call.abort);
      call.reject(new Error(this.#failure));
    }
    this.#calls = [];
  }
}

export async function createRefocuser(options) {
  const {threads, ...config} = options ?? {};
  if (threads !== undefined && !(Number.isInteger(threads) && threads >= 1 && threads <= MAX_WORKERS)) {
    throw new TypeError(`createRefocuser: expected 1 to ${MAX_WORKERS} threads, found ${threads}.`);
  }
  const workers = canShare ? threads ?? Math.min(await countCores(), MAX_WORKERS) : 1;
  const refocuser = new Refocuser(await startWorker(), config);
  try {
    return await refocuser.open({config, threads: workers});
  } catch (error) {
    refocuser.close();
    throw error;
  }
}
