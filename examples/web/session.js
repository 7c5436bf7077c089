// SPDX-License-Identifier: Apache-2.0
// A session owns the refocuser of one open light field. Only the last request counts. While requests arrive, the
// session computes previews. After the last request, the session computes the full picture, which a new request
// cancels.

import {createRefocuser, Shape} from './starfocus/starfocus.js';

const SHAPES = {
  'soft': {shape: Shape.FALL_OFF},
  'disc': {shape: Shape.DISC},
  'pentagon': {shape: Shape.POLYGON, blades: 5},
  'hexagon': {shape: Shape.POLYGON, blades: 6, curvature: 0.5, rotation: 17.5},
  'ring': {shape: Shape.RING},
  'cats-eye': {shape: Shape.DISC, catsEye: 0.75}
};
const LARGEST_BLUR = 128;
const LARGEST_SHIFT = 3;
const FIRST_SHIFT = 2;

// If a preview takes longer than FRAME, the next preview is smaller. If a preview takes less than FRAME / 4, the next
// preview is larger.
const FRAME = 16;  // ms
const PULL = 3000;  // duration of a focus pull, ms

export class Session {
  #refocuser;
  #field;
  #options;
  #lens;
  #highlightsChanged = false;
  #asked = false;
  #working = null;
  #full = null;  // AbortController of the full picture, or null
  #shift = FIRST_SHIFT;
  #closed = false;

  /** Opens a light field of open.js. `options` are {onPicture(picture, {shift, milliseconds}), onProgress(share),
   *  engine}, where `engine` contains additional options of createRefocuser. */
  static async open(field, lens, options) {
    const session = new Session();
    session.#field = field;
    session.#options = options;
    session.#lens = lens;
    const span = Math.max(field.high - field.low, 1 / 64);
    session.widest = Math.min(1, LARGEST_BLUR / span);
    session.#refocuser = await createRefocuser({
      width: field.width, height: field.height, views: field.views.length, disparityMin: field.low,
      disparityMax: field.high, maxBlur: Math.min(LARGEST_BLUR, span), previews: LARGEST_SHIFT, fillUnknown: true,
      shapes: true, highlights: lens.highlights, ...options.engine
    });
    try {
      await session.#refocuser.prepare(field.views, field.depth);
      // The first preview is slower than later previews. Compute a preview here, so that the first tap is fast.
      await session.#refocuser.preview({...session.#params(lens), shift: FIRST_SHIFT});
    } catch (error) {
      session.close();
      throw error;
    }
    return session;
  }

  get engine() {
    return this.#refocuser;
  }

  /** Returns the disparity to focus at for a pixel of the picture. */
  focusAt({x, y}) {
    const {width, height, depth} = this.#field;
    return this.#refocuser.focusAt(Math.floor(x * depth.width / width), Math.floor(y * depth.height / height));
  }

  /** Requests a picture with the lens {focus, stops, highlights, shape, blocks}. `stops` is the number of f-stops below
   *  the widest aperture. Resolves when all requests are finished. */
  refocus(lens) {
    this.#highlightsChanged ||= lens.highlights !== this.#lens.highlights;
    this.#lens = lens;
    this.#asked = true;
    this.#full?.abort();
    this.#working ??= this.#work().finally(() => this.#working = null);
    return this.#working;
  }

  /** Moves the focus from its current value to the nearest point, to the farthest point, and back. Stops early if the
   *  signal is aborted. */
  async pull(lens, signal, onFocus) {
    const {low, high} = this.#field, stops = [lens.focus, high, low, lens.focus], start = performance.now();
    await this.#working;
    for (let share = 0; share < 1 && !signal.aborted && !this.#closed;) {
      share = Math.min(1, (performance.now() - start) / PULL);
      const leg = Math.min(2, Math.floor(3 * share)), part = (1 - Math.cos(Math.PI * (3 * share - leg))) / 2;
      const focus = stops[leg] + part * (stops[leg + 1] - stops[leg]);
      await this.#preview({...lens, focus});
      onFocus(focus);
      await new Promise(requestAnimationFrame);
    }
  }

  close() {
    this.#closed = true;
    this.#full?.abort();
    this.#refocuser?.close();
  }

  #params({focus, stops, shape}) {
    return {focus, aperture: this.widest * 2 ** (-stops / 2), ...SHAPES[shape]};
  }

  async #work() {
    while (this.#asked) {
      this.#asked = false;
      if (this.#highlightsChanged) {
        this.#highlightsChanged = false;
        await this.#refocuser.configure({highlights: this.#lens.highlights});
      }
      await this.#preview(this.#lens);
      if (!this.#asked) await this.#finish(this.#lens);
    }
  }

  async #preview(lens) {
    const shift = this.#shift;
    const picture = await this.#refocuser.preview({...this.#params(lens), shift});
    const {milliseconds} = picture;
    this.#options.onPicture(picture, {shift, milliseconds});
    if (milliseconds > FRAME && shift < LARGEST_SHIFT) this.#shift = shift + 1;
    if (milliseconds < FRAME / 4 && shift > 1) this.#shift = shift - 1;
  }

  async #finish(lens) {
    const {signal} = this.#full = new AbortController();
    try {
      const picture = await this.#refocuser.refocus({
        ...this.#params(lens), blocks: lens.blocks, signal,
        onProgress: (done, rows) => this.#options.onProgress(done / rows)
      });
      this.#options.onPicture(picture, {shift: 0, milliseconds: picture.milliseconds});
    } catch (error) {
      if (!signal.aborted) throw error;
    }
  }
}
