// SPDX-License-Identifier: Apache-2.0
// A worker with an engine, and the calls that wait for it. Calls run one at a time. This module sends the calls, reports
// progress, cancels calls, and settles the promises of the calls with the worker's answers.

import {StarfocusError} from './errors.js';
import {host} from './host.js';

const PROGRESS_INTERVAL = 50;  // ms

/** Value of the option `stops` for calls that the worker can cancel only with shared memory. */
export const UNSHARED = 'unshared';

/** Returns the reason of an aborted signal. Old browsers have no reasons. */
const reasonOf = signal => signal.reason ?? new DOMException('The call was aborted.', 'AbortError');

export class WorkerCalls {
  #worker = null;
  #file;
  #calls = [];  // calls without an answer; the worker runs the first of them
  #lastId = 0;
  #failure = null;  // error of all calls after close() or after the worker failed
  #shared = null;   // memory shared with the worker: id of the call to cancel, finished rows, number of rows

  /** Returns the values of the call 'open' for another worker, which replaces a worker that had an engine; or null. */
  reopen = null;

  /** `file` is the address of worker.js, or undefined. */
  constructor(file) {
    this.#file = file;
  }

  /** Sends a call to the worker, and resolves with the worker's answer. `options` are {signal, onProgress, transfer,
   *  stops}. If the signal is aborted, the promise rejects at once. If `stops` is true, the worker cannot cancel the
   *  call, so the worker is ended, and the next call starts another worker. `stops` may also be UNSHARED. */
  call(name, values, options = {}) {
    return new Promise((resolve, reject) => {
      const {signal} = options;
      if (this.#failure) return reject(this.#failure);
      if (signal?.aborted) return reject(reasonOf(signal));
      const call = this.#make(name, values, {...options, resolve, reject});
      call.abort = () => this.#cancel(call, reasonOf(signal));
      signal?.addEventListener('abort', call.abort);
      this.#calls.push(call);
      if (this.#calls.length === 1) this.#send();
    });
  }

  #make(name, values, options) {
    return {id: ++this.#lastId, name, values, transfer: [], settled: false, ...options};
  }

  /** Ends the worker. Calls without an answer, and all later calls, reject with `error`. */
  end(error) {
    this.#failure ??= error;
    this.#stop();
    const calls = this.#calls;
    this.#calls = [];
    for (const call of calls) this.#settle(call, () => call.reject(this.#failure));
  }

  #stop() {
    this.#worker?.terminate();
    this.#worker = this.#shared = null;
  }

  #start() {
    const fail = message => this.end(new StarfocusError(
        'WORKER', `The worker of starfocus failed: ${message}. With a Content-Security-Policy that forbids blob: ` +
            'workers, serve starfocus/worker and pass its address as the option worker.'));
    try {
      this.#worker = host.start(this.#file, message => this.#hear(message), fail);
    } catch (error) {
      fail(error.message);
    }
    if (this.#worker && this.reopen) this.#calls.unshift(this.#makeOpen());
  }

  /** Returns the call that creates the engine of another worker. If it fails, the call that waits for it rejects. */
  #makeOpen() {
    return this.#make('open', this.reopen(), {
      resolve: ({shared}) => this.shared = shared,
      reject: error => {
        this.#stop();
        const waiting = this.#calls[1];
        if (!waiting) return;
        this.#settle(waiting, () => waiting.reject(error));
        this.#calls.splice(1, 1);
      }
    });
  }

  /** Shows the memory in which the worker reports its progress, or null if memory is not shared. */
  set shared(shared) {
    this.#shared = shared && new Int32Array(shared.memory.buffer, shared.address, 3);
  }

  #send() {
    if (this.#calls.length === 0) return this.#worker?.ref(false);
    if (!this.#worker) this.#start();
    const [call] = this.#calls;
    if (!this.#worker) return;
    this.#worker.ref(true);
    if (call.onProgress && this.#shared) {
      this.#shared.fill(0, 1);
      call.timer = setInterval(() => this.#report(call, this.#shared[1], this.#shared[2]), PROGRESS_INTERVAL);
    }
    try {
      this.#worker.post({id: call.id, name: call.name, values: call.values}, call.transfer);
    } catch (error) {
      this.#finish(call, () => call.reject(new StarfocusError('ARGUMENT', `${call.name}: ${error.message}`)));
    }
  }

  /** Rejects a call at once. A waiting call is removed, and the worker is asked to end a running call. */
  #cancel(call, reason) {
    const runs = call === this.#calls[0], stops = call.stops === UNSHARED ? !this.#shared : call.stops;
    this.#settle(call, () => call.reject(reason));
    if (!runs || stops) this.#calls = this.#calls.filter(other => other !== call);
    if (!runs) return;
    if (stops) {
      this.#stop();
      return this.#send();
    }
    if (this.#shared) Atomics.store(this.#shared, 0, call.id);
    this.#worker?.post({cancel: call.id});
  }

  #report(call, done, total) {
    if (call.settled || !(total > 0)) return;
    const fail = error => this.#cancel(call, error);
    try {
      Promise.resolve(call.onProgress?.(done, total)).catch(fail);
    } catch (error) {
      fail(error);
    }
  }

  #hear({id, result, error, progress}) {
    const [call] = this.#calls;
    if (call?.id !== id) return;
    if (progress) return this.#report(call, ...progress);
    this.#finish(call, () => error ? call.reject(new StarfocusError(error.code, error.message, error))
                                   : call.resolve(result));
  }

  /** Settles the running call and sends the next call. */
  #finish(call, settle) {
    this.#settle(call, settle);
    this.#calls = this.#calls.filter(other => other !== call);
    this.#send();
  }

  #settle(call, settle) {
    clearInterval(call.timer);
    call.signal?.removeEventListener('abort', call.abort);
    if (!call.settled) settle();
    call.settled = true;
  }
}
