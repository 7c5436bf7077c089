// SPDX-License-Identifier: Apache-2.0
// Refocuses the open photo with the lens of the controls, and shows and downloads the pictures.

import {insertSegments} from './jpeg.js';
import {lens, showTexts} from './lens.js';
import {chosen, fail, get, say, state, viewer} from './page.js';
import {call} from './pixels.js';
import {keepState} from './visit.js';

const PULL = 3000;     // duration of a focus pull, ms

let latest = null;     // {pictures, stop}: request of Photo.refocus whose pictures are shown, and its AbortController
let previewing = null; // request whose preview is being computed, or null
let isChanged = false; // true if the lens has changed since that request
let pulling = null;    // AbortController of the focus pull, or null
let times = '';        // status of the last preview

export const showLens = () => showTexts(state.current?.found.distances);

/** Returns a bitmap of the picture for the viewer. Full pictures go to the worker, which encodes downloads. */
function toBitmap(picture) {
  if (picture.shift > 0) return picture.toImageBitmap();
  const {data, width, height} = picture, {width: across, height: down} = viewer.canvas;
  return call('show', {data, width, height, across, down}, [data.buffer]);
}

/** Shows a picture of a request, unless there is a newer request. */
async function showPicture(picture, pictures) {
  const {shift, milliseconds, blocks} = picture, bitmap = await toBitmap(picture);
  if (pictures !== latest?.pictures) return;
  viewer.showPicture(bitmap, blocks);
  state.isFull = shift === 0;
  get('error').hidden = true;
  const time = `${milliseconds.toFixed(milliseconds < 10 ? 1 : 0)} ms`;
  if (shift > 0) times = `Preview at 1/${2 ** shift}: ${time}`;
  say(shift > 0 ? times : `${times} · Full picture: ${time}`, shift > 0);
}

function showProgress(done, total) {
  say(`${times} · Full picture: ${Math.round(100 * done / total)} %`, true);
}

/** Returns a request for the picture of the lens. A newer request cancels this one. */
function request() {
  state.isSharp = state.isFull = false;
  const stop = new AbortController(), options = {onProgress: showProgress, signal: stop.signal};
  const pictures = state.current.photo.refocus({...lens(), blocks: chosen('show') === 'blocks'}, options);
  latest = {pictures, stop};
  return pictures;
}

/** Cancels the running request and the focus pull. Their pictures are not shown. */
export function stop() {
  pulling?.abort();
  latest?.stop.abort();
  latest = null;
}

/** Shows the picture of the lens. While the preview of an earlier lens is computed, only notes the change, because
 *  cancelled previews would never be shown while a slider moves. */
export async function refocus() {
  showLens();
  keepState();
  if (!state.current || state.opening) return;
  isChanged = previewing !== null;
  if (isChanged) return;
  let pictures;
  try {
    pictures = previewing = request();
    for await (const picture of pictures) {
      previewing = null;
      await showPicture(picture, pictures);
      if (isChanged) break;
    }
  } catch (error) {
    fail(error);
  }
  if (previewing === pictures) previewing = null;
  if (isChanged && !previewing) await refocus();
}

/** Focuses on a point of the photo. */
export async function focusAt(point) {
  if (state.offered && !state.opening) return say('This photo has no depth: first find the person.');
  if (state.opening || !state.current) {
    state.tapped = point;
    return say('This point is focused as soon as the engine is ready.', true);
  }
  stop();  // the engine would find the focus only after the running picture
  const {photo} = state.current;
  try {
    get('focus').value = await photo.focusAt(point);
  } catch (error) {
    return photo === state.current.photo ? fail(error) : focusAt(point);  // its repaired photo has replaced the photo
  }
  await refocus();
}

export async function showDepth() {
  if (!state.current || state.opening || viewer.hasDepth) return;
  const {photo} = state.current;
  try {
    const map = await photo.disparity();
    if (photo !== state.current.photo || state.opening) return;
    viewer.setDepth({...map, low: photo.focusMin, high: photo.focusMax});
  } catch (error) {
    fail(error);
  }
}

/** Moves the focus from its current value to the nearest point, to the farthest point, and back. */
async function moveFocus(signal) {
  const slider = get('focus'), first = Number(slider.value), begin = performance.now();
  const stops = [first, Number(slider.max), Number(slider.min), first];
  for (let share = 0; share < 1 && !signal.aborted;) {
    share = Math.min(1, (performance.now() - begin) / PULL);
    const leg = Math.min(2, Math.floor(3 * share)), part = (1 - Math.cos(Math.PI * (3 * share - leg))) / 2;
    slider.value = stops[leg] + part * (stops[leg + 1] - stops[leg]);
    showLens();
    const pictures = request(), {value} = await pictures[Symbol.asyncIterator]().next();
    if (value) await showPicture(value, pictures);
    await new Promise(requestAnimationFrame);
  }
}

/** Starts or stops the focus pull. */
export async function pull() {
  if (pulling) return pulling.abort();
  if (!state.current || state.opening) return;
  pulling = new AbortController();
  get('pull').setAttribute('aria-pressed', 'true');
  try {
    await moveFocus(pulling.signal);
    await refocus();
  } catch (error) {
    fail(error);
  } finally {
    pulling = null;
    get('pull').setAttribute('aria-pressed', 'false');
  }
}

/** Refocuses after a control of the lens was moved, which ends the focus pull. */
export function changeLens() {
  pulling?.abort();
  return refocus();
}

/** Computes and shows the full picture, with a second attempt if the repaired photo replaces the photo meanwhile. */
async function showFull() {
  const {photo} = state.current, pictures = request();
  try {
    await showPicture(await pictures, pictures);
  } catch (error) {
    if (photo === state.current.photo) throw error;
    await showFull();
  }
}

/** Returns the picture as a JPEG: the sharp photo, or the full picture. */
async function toJpeg({images: [file]}) {
  if (state.isSharp) return call('encode', {file});
  if (!state.isFull) await showFull();
  return call('encode', {});
}

export async function download() {
  if (!state.current || state.opening) return;
  const {found} = state.current, link = document.createElement('a');
  try {
    link.href = URL.createObjectURL(insertSegments(await toJpeg(found), found.kept));
  } catch (error) {
    return fail(error);
  }
  link.download = `${found.stem}-refocused.jpg`;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}
