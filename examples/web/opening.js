// SPDX-License-Identifier: Apache-2.0
// Opens the demo and files, and replaces the open photo. The engine and the readers of files are loaded after the first
// picture is visible.

import {openDemo} from './demo.js';
import {keepOpened} from './files.js';
import {resetLens, setRanges} from './lens.js';
import {chosen, fail, get, say, state, viewer} from './page.js';
import {hasSegmenter, segment} from './pixels.js';
import {focusAt, refocus, showDepth, showLens, stop} from './pictures.js';
import {keepState} from './visit.js';

const LARGE = 4e6;  // pixels of a photo that can be refocused before its depth is repaired

let repairing = null;  // AbortController of the repair of a large photo, or null

// ?threads=N in the address sets the number of threads, for tests and measurements.
const query = new URLSearchParams(location.search);
const threads = query.has('threads') ? Number(query.get('threads')) : undefined;

/** Recognizes the opened files, as open() of open.js. */
export async function recognize(opened) {
  const {open} = await import('./open.js');
  return open(opened);
}

/** Loads the engine. */
const engine = () => import('./starfocus/starfocus.js');

/** Starts the engine for the photo `found`. Returns null if the photo has no depth, its stored matte cannot be used, and the
 *  site has a segmenter. */
async function start(found, options, signal) {
  const {estimateDisparity, openPhoto} = await engine();
  const image = found.images.length > 1 ? found.images : found.images[0];
  const call = {
    threads, signal, onProgress: (done, total) => say(`Preparing the depth: ${Math.round(100 * done / total)} %`, true), ...options
  };
  if (found.images.length > 1) found.depth ??= await estimateDisparity(found.images, {...call, positions: found.options.positions});
  try {
    return await openPhoto(image, found.depth ?? undefined, {...found.options, ...call});
  } catch (error) {
    if (!found.storesMatte || !/^matte/.test(error.field)) throw error;
    if (!found.depth && !await hasSegmenter()) throw error;
    signal.throwIfAborted();
    found.options.matte = undefined;
    return found.depth && openPhoto(image, found.depth, {...found.options, ...call});
  }
}

/** Shows the version of the engine, the number of threads, a sentence about the depth, and a note about the open photo. */
function showEngine({version, threads: count}, depth = '') {
  const gain = state.current.found.hasGain ? ' The gain map of the photo is dropped, because pictures have 8 bits.' : '';
  get('engine').textContent = `starfocus ${version}, ${count} ${count === 1 ? 'thread' : 'threads'}.${depth}${gain}`;
}

/** Replaces the open photo. `isRough` is true if its depth is not repaired yet. */
function take(photo, found, isRough = false) {
  state.current?.photo.close();
  state.current = {photo, found, isRough, view: null};
  setRanges(photo);
  showLens();
  get('swap').disabled = Boolean(found.options.disparity) || !found.depth;
  showEngine(photo, isRough ? ' The depth is being repaired.' : '');
  viewer.setDepth(null);
  if (chosen('show') === 'depth') showDepth();
}

/** Repairs the depth of the open photo, and then replaces the photo. */
async function repair() {
  const {photo: rough, found} = state.current, {signal} = repairing = new AbortController();
  try {
    take(await start(found, {onProgress: undefined}, signal), found);
    if (!state.isSharp) refocus();
  } catch (error) {
    if (signal.aborted) return;
    console.warn(error);  // for developers
    showEngine(rough, ' The depth could not be repaired.');
  }
}

/** Opens the photo that `find` returns, and then calls `afterwards`. `find` receives a signal, which is aborted if
 *  another photo is opened meanwhile. On failure, the previous photo remains open. */
export async function openWith(find, afterwards = () => {}) {
  stop();
  const before = state.current ?? state.offered, {isSharp} = state;
  if (!state.opening && before) before.view = {state: viewer.state, isSharp};
  state.opening?.abort();
  repairing?.abort();
  const {signal} = state.opening = new AbortController();
  let name;
  get('offer').hidden = true;
  say('Opening.', true);
  try {
    const found = await find(signal);
    signal.throwIfAborted();
    name = found.name;
    if (found.bitmap) viewer.showPhoto(found.bitmap);
    else viewer.showSharp();
    const isLarge = found.depth && !found.options.disparity && viewer.width * viewer.height > LARGE;
    const photo = found.isFlat ? null : await start(found, isLarge ? {repair: false} : {}, signal);
    if (!photo) return offer(found);
    Object.assign(state, {opening: null, offered: null, isFull: false, isSharp: true});
    get('error').hidden = true;
    take(photo, found, isLarge);
    finish(found, afterwards);
  } catch (error) {
    if (!signal.aborted) stay(error, name);
  }
}

/** Sets the lens of a photo that was opened, and focuses on a point that was tapped meanwhile, or else on the subject of
 *  a matte. */
function finish(found, afterwards) {
  const {photo, isRough} = state.current, {tapped} = state, {subjectFocus} = photo;
  if (!found.isAgain) resetLens(found.options.disparity, subjectFocus);
  showLens();
  say(`Opened: ${found.name}, ${photo.width} x ${photo.height}. Tap to focus.`);
  afterwards();
  if (isRough) repair();
  keepState();
  state.tapped = null;
  if (tapped) focusAt(tapped);
  else if (subjectFocus !== undefined && state.isSharp && !found.isAgain) refocus();
}

/** Shows a photo without depth, which replaces the open photo, and offers to find the person in it. */
function offer(found) {
  state.current?.photo.close();
  Object.assign(state, {opening: null, current: null, offered: {found, view: null}, tapped: null, isSharp: true});
  get('error').hidden = true;
  get('swap').disabled = true;
  showOffer();
}

function showOffer() {
  get('offer').hidden = false;
  say(`${state.offered.found.file.name} has no depth.`);
}

/** Shows the reason of a failure, and shows the previous photo again. */
function stay(error, name) {
  const {current, offered} = state, before = current ?? offered;
  state.opening = state.tapped = null;
  fail(error, name);
  if (!before) return say('Nothing is open.');
  viewer.state = before.view.state;
  state.isSharp = before.view.isSharp;
  if (offered) return showOffer();
  if (chosen('show') === 'depth') showDepth();
  if (current.isRough) repair();
  say(`Still open: ${current.found.name}.`);
}

/** Opens the demo. */
export const demo = afterwards => openWith(signal => openDemo(bitmap => {
  signal.throwIfAborted();
  viewer.showPhoto(bitmap);
  say('Loading the rest of the demo.', true);
  engine().catch(() => {});  // start() reports failures
}), afterwards);

/** Opens the files that `find` returns for open() of open.js, and keeps them for the return to the page. */
function openKept(find) {
  const key = `${Date.now()}-${Math.random()}`;
  let opened;
  return openWith(async signal => {
    opened = await find(signal);
    return {...await recognize(opened), key};
  }, () => keepOpened(key, opened));
}

/** Opens files, an array or a promise of an array. */
export const openFiles = files => openKept(async () => ({files: await files}));

/** Finds the person in the photo without depth that is shown, and opens the photo with this matte. */
export function findPerson() {
  const {images: [image], stem, file} = state.offered.found;
  return openKept(async signal => {
    say('Loading the segmenter, and finding the person.', true);
    const matte = new File([await segment(image, file.name, signal)], `${stem}-matte.png`);
    return {files: [file], matte};
  });
}

/** Returns `found` with this near end. Its distances are known only for the near end that the file states. */
export function withNear(found, near) {
  const {options, distances, stated = {near: options.near, distances}} = found;
  return {...found, stated, options: {...options, near}, distances: near === stated.near ? stated.distances : null};
}

/** Opens the photo again with the other end of its depth as the near end. */
export async function swap() {
  if (!state.current || state.opening) return;
  const {found, photo} = state.current, near = photo.near === 'bright' ? 'dark' : 'bright', {isSharp} = state;
  await openWith(() => ({...withNear(found, near), bitmap: null, isAgain: true}), () => isSharp || refocus());
}
