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
  #params;
  #blocks;
  #options;
  #settle;      // sets the highlights before the first picture
  #superseded = new AbortController();
  #signal;      // aborted by the caller or by a newer request
  #full = null; // promise of the full picture

  constructor(refocuser, {params, blocks, options, settle}) {
    this.#refocuser = refocuser;
    this.#params = params;
    this.#blocks = blocks;
    this.#options = options;
    this.#settle = settle;
    this.#signal = this.#superseded.signal;
    options.signal?.addEventListener('abort', () => this.#superseded.abort(options.signal.reason), {once: true});
    if (options.signal?.aborted) this.#superseded.abort(options.signal.reason);
  }

  /** Cancels this request in favour of a newer one. */
  supersede() {
    this.#superseded.abort();
  }

  async #preview() {
    await this.#settle();
    const shift = shifts.get(this.#refocuser) ?? 2;
    const picture = await this.#refocuser.preview({...this.#params, shift, signal: this.#signal});
    adapt(this.#refocuser, shift, picture.milliseconds);
    return picture;
  }

  async #finish() {
    await this.#settle();
    return this.#refocuser.refocus({
      ...this.#params, blocks: this.#blocks, signal: this.#signal, onProgress: this.#options.onProgress
    });
  }

  async* [Symbol.asyncIterator]() {
    try {
      yield await this.#preview();
      yield await (this.#full ??= this.#finish());
    } catch (error) {
      // A newer request ends the iteration without an error.
      if (!this.#signal.aborted || this.#options.signal?.aborted) throw error;
    }
  }

  then(resolve, reject) {
    return (this.#full ??= this.#finish()).then(resolve, reject);
  }

  catch(reject) {
    return this.then(undefined, reject);
  }

  finally(settled) {
    return this.then().finally(settled);
  }
}
