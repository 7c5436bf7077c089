// SPDX-License-Identifier: Apache-2.0
// One request of Photo.refocus: an async iterable of a preview and the full picture, and a promise of the full picture.

// If a preview takes longer than FRAME, the next preview is smaller. If a preview takes less than FRAME / 4, the next
// preview is larger.
const FRAME = 16;  // ms
const SMALLEST = 3, LARGEST = 1;  // shifts of previews

const shifts = new WeakMap();  // shift of the next preview of a Refocuser

function adapt(refocuser, shift, milliseconds) {
  if (milliseconds > FRAME && shift < SMALLEST) shifts.set(refocuser, shift + 1);
  if (milliseconds < FRAME / 4 && shift > LARGEST) shifts.set(refocuser, shift - 1);
}

export class Refocusing {
  #refocuser;
  #lens;
  #options;
  #full = null;  // promise of the full picture

  /** `options` are {signal, onProgress, superseded}. A newer request aborts the AbortController `superseded`. */
  constructor(refocuser, lens, options) {
    this.#refocuser = refocuser;
    this.#lens = lens;
    this.#options = options;
  }

  /** Calls `compute`. While it runs, the caller's signal also aborts this request. */
  async #run(compute) {
    const {signal, superseded} = this.#options, abort = () => superseded.abort(signal.reason);
    if (signal?.aborted) abort();
    signal?.addEventListener('abort', abort);
    try {
      return await compute(superseded.signal);
    } finally {
      signal?.removeEventListener('abort', abort);
    }
  }

  #preview() {
    return this.#run(async signal => {
      const {blocks, ...lens} = this.#lens, shift = shifts.get(this.#refocuser) ?? 2;
      const picture = await this.#refocuser._refocus({...lens, shift}, {signal});
      adapt(this.#refocuser, shift, picture.milliseconds);
      return picture;
    });
  }

  #finish() {
    return this.#full ??= this.#run(
        signal => this.#refocuser._refocus({...this.#lens, shift: 0}, {signal, onProgress: this.#options.onProgress}));
  }

  async* [Symbol.asyncIterator]() {
    try {
      yield await this.#preview();
      yield await this.#finish();
    } catch (error) {
      // A newer request ends the iteration without an error.
      if (!this.#options.superseded.signal.aborted || this.#options.signal?.aborted) throw error;
    }
  }

  then(resolve, reject) {
    return this.#finish().then(resolve, reject);
  }

  catch(reject) {
    return this.then(undefined, reject);
  }

  finally(settled) {
    return this.then().finally(settled);
  }
}
