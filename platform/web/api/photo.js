// SPDX-License-Identifier: Apache-2.0
// openPhoto of starfocus.d.ts: a photo with its depth, or a light field, that is refocused with one call per lens.

import {checkFields, expect, StarfocusError} from './errors.js';
import {CALL, ENGINE, LENS} from './fields.js';
import {checkPositions, isBytes, isDepth} from './light_field.js';
import {checkMatteOptions, checkMatteSize} from './matte.js';
import {Refocusing} from './refocusing.js';
import {checkEngine, Refocuser} from './refocuser.js';
import {WorkerCalls} from './worker_calls.js';

const OPTIONS = {
  ...ENGINE, ...CALL, near: 'any', blur: 'number', disparity: 'boolean', repair: 'boolean', positions: 'any', matte: 'any',
  floor: 'boolean'
};
const VIEWS = [1, 5, 9, 17];
const MAX_BLUR = 128;      // pixels, STARFOCUS_MAX_BLUR
const MAX_DISPARITY = 499; // pixels; STARFOCUS_MAX_DISPARITY without REPAIR_MARGIN
const REPAIR_MARGIN = 1;   // pixels that a repair may add to each end of the disparity range
const BLUR_MARGIN = 1.01;  // factor of maxBlur, so that a focus at an end of the range is valid in spite of rounding
const F_STOP = 1.8;        // default f-stop of photos; light fields have the default 1

// Blur radius at f/1 of the farthest point if the nearest point is in focus, divided by the diagonal: a lens of 50 mm on
// full frame, whose diagonal is 43.2666 mm, if the nearest point is 1.5 m away and the farthest infinitely far. The
// program has the same default.
const BLUR = 50 / 43.2666 * 50 / 1000 / 2 / 1.5;

const PREVIEWS = 3;
const UNITS = 64;  // steps of disparities per pixel

/** Returns pixels in memory, with one value or 3 or 4 bytes per pixel for depth and mattes, and 3 or 4 bytes for
 *  pictures. */
function checkPixels({data, width, height}, what) {
  const isMap = what === 'depth' || what === 'matte', channels = data.length / (width * height);
  expect(isMap ? isDepth(data) : isBytes(data), `${what}.data`,
         `${isMap ? 'a Float32Array, a Uint16Array, ' : ''}a Uint8Array or a Uint8ClampedArray`, data);
  expect(Number.isInteger(width) && width > 0, `${what}.width`, 'an integer above 0', width, 'RANGE');
  expect(Number.isInteger(height) && height > 0, `${what}.height`, 'an integer above 0', height, 'RANGE');
  const counts = isMap ? isBytes(data) ? [1, 3, 4] : [1] : [3, 4];
  expect(counts.includes(channels), `${what}.data`, `${width} x ${height} x ${counts.join(' or ')} values`, data.length, 'RANGE');
  return {data, width, height, channels};
}

/** Converts a picture to a value that can be sent to the worker: a Blob, an ImageBitmap or {data, width, height}. */
export async function toSendable(source, what) {
  if (typeof Blob === 'function' && source instanceof Blob) return source;
  if (source?.data !== undefined) return checkPixels(source, what);
  const isElement = typeof source?.width === 'number' && typeof globalThis.createImageBitmap === 'function';
  expect(isElement, what, 'a Blob, ImageData, ImageBitmap, image, canvas or {data, width, height}', source);
  try {
    if (source.decode) await source.decode();  // an image that may still be loading
    return await createImageBitmap(source, {colorSpaceConversion: 'none', premultiplyAlpha: 'none'});
  } catch (error) {
    throw new StarfocusError('DECODE', `${what}: ${error.message}`, {field: what});
  }
}

/** Returns the range of disparities, and the conversion of depth values to disparities. */
function chooseRange({low, high, brightIsNear}, size, {near, blur = BLUR, disparity = false}) {
  if (!(high > low) && !disparity) {
    throw new StarfocusError('NOT_FINITE', 'depth: all values are equal, so there is nothing to focus on.', {field: 'depth'});
  }
  if (disparity) {
    expect(low <= high, 'depth', 'a map with finite disparities', 'none', 'NOT_FINITE');
    expect(low >= -MAX_DISPARITY && high <= MAX_DISPARITY, 'depth', `disparities within +-${MAX_DISPARITY}`,
           -low > high ? low : high, 'DISPARITY');
    return {low, high, near: 'bright'};
  }
  const bright = near === undefined ? brightIsNear : near === 'bright';
  const most = Math.min(blur * Math.hypot(size.width, size.height), MAX_DISPARITY);
  const order = {zero: bright ? low : high, factor: (bright ? most : -most) / (high - low), most};
  return {low: 0, high: most, order, near: bright ? 'bright' : 'dark'};
}

/** Returns the range of disparities of a photo with a matte and without depth. The background has disparity 0. */
function chooseSurfaces({width, height}, {blur = BLUR, floor = false}) {
  const nearest = Math.min(blur * Math.hypot(width, height), MAX_DISPARITY), high = Math.floor(UNITS * nearest + 0.5) / UNITS;
  return {low: 0, high, surfaces: {subject: high, floor}, near: 'bright'};
}

/** Returns the values that move to the worker. */
export const toTransfer = sources => sources.filter(source => typeof ImageBitmap === 'function' && source instanceof ImageBitmap);

/** Checks that all views have the same size, and returns this size. */
export function checkSizes(sizes) {
  const [{width, height}] = sizes;
  sizes.forEach((size, index) => expect(size.channels === sizes[0].channels, `image[${index}]`,
                                        `${sizes[0].channels} bytes per pixel, as image[0] has`, size.channels, 'RANGE'));
  sizes.forEach((size, index) => expect(size.width === width && size.height === height, `image[${index}]`,
                                        `${width} x ${height} pixels, as image[0] has`, `${size.width} x ${size.height}`, 'RANGE'));
  return {width, height};
}

export class Photo {
  #refocuser;
  #widest;        // largest aperture whose blur the engine allows
  #fStop;         // default f-stop
  #latest = null; // AbortController of the last request

  constructor(refocuser, {width, height, low, high, near, widest, isPhoto, subjectFocus}) {
    this.#refocuser = refocuser;
    this.#widest = widest;
    this.#fStop = Math.max(isPhoto ? F_STOP : 1, 1 / widest);
    Object.assign(this, {width, height, focusMin: low, focusMax: high, near, fStopMin: Math.max(1, 1 / widest), subjectFocus});
  }

  get threads() {
    return this.#refocuser.threads;
  }

  get version() {
    return this.#refocuser.version;
  }

  focusAt(point) {
    return this.#refocuser.focusAt(point);
  }

  disparity() {
    return this.#refocuser.disparity();
  }

  refocus(lens, options = {}) {
    checkFields('refocus', lens, {...LENS, fStop: 'number', highlights: 'number', blocks: 'boolean'}, ['focus']);
    checkFields('refocus', options, CALL);
    const {fStop = this.#fStop, highlights = 1, ...rest} = lens;
    const {focus, aperture = Math.min(this.#widest, 1 / fStop)} = lens;
    expect(fStop >= this.fStopMin, 'fStop', `at least ${this.fStopMin}`, fStop, 'RANGE');
    expect(highlights >= 1 && highlights <= 64, 'highlights', '1 to 64', highlights, 'RANGE');
    expect(focus >= this.focusMin - REPAIR_MARGIN && focus <= this.focusMax + REPAIR_MARGIN, 'focus',
           `${this.focusMin} to ${this.focusMax}`, focus, 'RANGE');
    this.#latest?.abort();
    this.#latest = new AbortController();
    return new Refocusing(this.#refocuser, {...rest, aperture, highlights}, {...options, superseded: this.#latest});
  }

  close() {
    this.#latest?.abort();
    this.#refocuser.close();
  }

  async [Symbol.asyncDispose ?? Symbol.for('Symbol.asyncDispose')]() {
    this.close();
  }

  [Symbol.dispose ?? Symbol.for('Symbol.dispose')]() {
    this.close();
  }
}

/** Computes pictures that are not shown, because the first pictures of a worker take several times as long. */
async function warmUp(refocuser, {width, height, low, high, signal}) {
  const focus = (low + high) / 2, side = 256;
  await refocuser.preview({focus, shift: 2, signal});
  const region = {x: Math.max(0, (width - side) >> 1), y: Math.max(0, (height - side) >> 1),
                  width: Math.min(side, width), height: Math.min(side, height)};
  await refocuser.refocus({focus, region, signal});
}

/** Returns the range of disparities of decoded pictures, and checks the sizes of the depth and the matte. */
function measurePhoto({depth, matte}, size, options) {
  const {width, height} = size;
  if (matte) checkMatteSize(matte, size);
  if (!depth) return chooseSurfaces(size, options);
  const range = chooseRange(depth, size, options);
  expect(depth.width <= width && depth.height <= height, 'depth',
         `at most ${width} x ${height} pixels, the size of the picture`, `${depth.width} x ${depth.height}`, 'RANGE');
  return range;
}

/** Checks the options of openPhoto. */
function checkOptions(images, hasDepth, options) {
  checkFields('openPhoto', options, OPTIONS);
  checkEngine(options);
  checkMatteOptions(options, hasDepth);
  const {near, blur, disparity, positions} = options;
  expect([undefined, 'bright', 'dark'].includes(near), 'near', `'bright' or 'dark'`, near);
  expect(blur === undefined || blur > 0 && blur <= 1, 'blur', 'more than 0, at most 1', blur, 'RANGE');
  if (positions) checkPositions(positions, images.length);
  else expect(VIEWS.includes(images.length), 'image', 'one picture, or 5, 9 or 17 views', images.length, 'RANGE');
  expect(images.length === 1 || hasDepth, 'depth', 'a map for several views', undefined);
  expect(images.length === 1 || disparity, 'disparity', 'true for several views', disparity, 'RANGE');
}

/** Decodes the pictures in the worker. Returns their sizes and the range of the depth. */
async function decode(calls, {images, depth, hasDepth}, {matte, disparity, signal}) {
  const views = await Promise.all(images.map((view, index) => toSendable(view, index ? `image[${index}]` : 'image')));
  const pictures = {};
  if (hasDepth) pictures.depth = await toSendable(depth, 'depth');
  if (matte !== undefined) pictures.matte = await toSendable(matte, 'matte');
  return calls.call('decode', {views, ...pictures, disparity},
                    {signal, stops: true, transfer: toTransfer([...views, ...Object.values(pictures)])});
}

export async function openPhoto(image, depth, options = {}) {
  if (depth?.matte !== undefined && arguments.length === 2) return openPhoto(image, undefined, depth);
  const images = Array.isArray(image) ? image : [image], hasDepth = depth !== undefined || options?.matte === undefined;
  checkOptions(images, hasDepth, options);
  const {threads, worker, signal, onProgress, disparity = false, repair = hasDepth && !disparity, positions} = options;
  const calls = new WorkerCalls(worker);
  try {
    const found = await decode(calls, {images, depth, hasDepth}, options);
    const {width, height} = checkSizes(found.sizes), range = measurePhoto(found, {width, height}, options);
    const margin = repair ? REPAIR_MARGIN : 0;
    const largest = BLUR_MARGIN * (range.high - range.low + 2 * REPAIR_MARGIN + 1 / UNITS), maxBlur = Math.min(MAX_BLUR, largest);
    const refocuser = await Refocuser.start({
      width, height, views: images.length, positions, disparityMin: range.low - margin, disparityMax: range.high + margin, maxBlur,
      previews: PREVIEWS, fillUnknown: true, shapes: true, threads
    }, {calls, signal});
    const {subjectFocus} = await refocuser._prepare({depth: {order: range.order}, surfaces: range.surfaces, repair}, {signal, onProgress});
    await warmUp(refocuser, {width, height, signal, ...range});
    return new Photo(refocuser, {width, height, widest: maxBlur / largest, isPhoto: !disparity, subjectFocus, ...range});
  } catch (error) {
    calls.end(error);
    throw error;
  }
}
