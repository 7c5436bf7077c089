// SPDX-License-Identifier: Apache-2.0
// Connects the controls of the page to the open photo and the viewer, and shows messages. The engine and the readers of
// files are loaded after the first picture is visible.

import {openDemo} from './demo.js';
import {filesOfDrop, findFiles, keepFiles} from './files.js';
import {insertSegments} from './jpeg.js';
import {fromHash, lens, resetLens, setRanges, showTexts, toHash} from './lens.js';
import {call} from './pixels.js';
import {toSentence} from './problem.js';
import {Viewer} from './viewer.js';

const PULL = 3000;         // duration of a focus pull, ms
const KEEP_DELAY = 300;    // time without changes before the address is updated, ms
const LARGE = 4e6;         // pixels of a photo that can be refocused before its depth is repaired

const get = id => document.getElementById(id);
const viewer = new Viewer(get('picture'));
const query = new URLSearchParams(location.search);

let current = null;        // the open photo: {photo, found, view}
let opening = null;        // AbortController of the photo that is being opened, or null
let repairing = null;      // AbortController of the repair of a large photo, or null
let tapped = null;         // point that was tapped while a photo was being opened
let isFull = false;        // true if a full picture is shown
let isSharp = true;        // true until the first refocusing
let pulling = null;        // AbortController of the focus pull, or null
let latest = null;         // request of Photo.refocus that was made last
let times = '', isPreviewing = false, isChanged = false, keepTimer = 0;
let kept = {};             // what the browser's history keeps: {key, near}

// ?threads=N in the address sets the number of threads, for tests and measurements.
const threads = query.has('threads') ? Number(query.get('threads')) : undefined;

/** Shows a status. If `more` is true, further changes follow soon, and screen readers wait for the last change. */
function say(text, more = false) {
  get('status').setAttribute('aria-busy', more);
  get('status').textContent = text;
}

function fail(error, name = current?.found.name ?? 'The picture') {
  console.warn(error);  // for developers
  get('error').textContent = toSentence(error, name);
  get('error').hidden = false;
  say('');
}

const chosen = name => document.querySelector(`input[name=${name}]:checked`).value;
const showLens = () => showTexts(current?.found.distances);

/** Writes the state of the lens to the address, and the key of the open files to the browser's history. */
function keepState() {
  clearTimeout(keepTimer);
  keepTimer = setTimeout(() => {
    const state = {...kept, show: chosen('show'), wipe: get('wipe').value};
    history.replaceState(state, '', isSharp ? location.pathname + location.search : `#${toHash()}`);
  }, KEEP_DELAY);
}

/** Returns a bitmap of the picture for the viewer. Full pictures go to the worker, which encodes downloads. */
function toBitmap(picture) {
  if (picture.shift > 0) return picture.toImageBitmap();
  const {data, width, height} = picture, {width: across, height: down} = viewer.canvas;
  return call('show', {data, width, height, across, down}, [data.buffer]);
}

/** Shows a picture of a request, unless there is a newer request. */
async function showPicture(picture, request) {
  const {shift, milliseconds, blocks} = picture, bitmap = await toBitmap(picture);
  if (request !== latest) return;
  viewer.showPicture(bitmap, blocks);
  isFull = shift === 0;
  get('error').hidden = true;
  const time = `${milliseconds.toFixed(milliseconds < 10 ? 1 : 0)} ms`;
  times = shift > 0 ? `Preview at 1/${2 ** shift}: ${time}` : `${times.replace(/ · .*/, '')} · Full picture: ${time}`;
  say(times, shift > 0);
}

function showProgress(done, total) {
  say(`${times.replace(/ · .*/, '')} · Full picture: ${Math.round(100 * done / total)} %`, true);
}

/** Returns a request for the picture of the lens. A newer request cancels this one. */
function request() {
  isSharp = isFull = false;
  const options = {onProgress: showProgress}, blocks = chosen('show') === 'blocks';
  return latest = current.photo.refocus({...lens(), blocks}, options);
}

/** Shows the picture of the lens. While the preview of an earlier lens is computed, only notes the change, because
 *  cancelled previews would never be shown while a slider moves. */
async function refocus() {
  showLens();
  keepState();
  if (!current || opening) return;
  if (isPreviewing) {
    isChanged = true;
    return;
  }
  const {photo} = current;
  isPreviewing = true;
  isChanged = false;
  try {
    const pictures = request();
    for await (const picture of pictures) {
      isPreviewing = false;
      await showPicture(picture, pictures);
      if (isChanged) return refocus();
    }
  } catch (error) {
    if (photo === current?.photo && !opening) fail(error);
  } finally {
    isPreviewing = false;
  }
}

async function focusAt(point) {
  if (!point) return;
  pulling?.abort();
  if (opening || !current) {
    tapped = point;
    return say('This point is focused as soon as the engine is ready.', true);
  }
  try {
    get('focus').value = await current.photo.focusAt(point);
  } catch (error) {
    return fail(error);
  }
  await refocus();
}

/** Recognizes files, as open() of open.js. */
async function recognize(files) {
  const {open} = await import('./open.js');
  return open(files);
}

/** Loads the engine. */
const engine = () => import('./starfocus/starfocus.js');

/** Starts the engine for the photo `found`. */
async function start(found, options, signal) {
  const {openPhoto} = await engine();
  const image = found.images.length > 1 ? found.images : found.images[0];
  return openPhoto(image, found.depth, {
    ...found.options, threads, signal,
    onProgress: (done, total) => say(`Preparing the depth: ${Math.round(100 * done / total)} %`, true), ...options
  });
}

/** Replaces the open photo. */
function take(photo, found) {
  repairing?.abort();
  repairing = null;
  if (current) current.photo.close();
  current = {photo, found, view: null};
  setRanges(photo);
  showLens();
  get('swap').disabled = Boolean(found.options.disparity);
  kept.near = found.options.near;
  const {version, threads} = photo;
  get('engine').textContent = `starfocus ${version}, ${threads} ${threads === 1 ? 'thread' : 'threads'}.`;
  if (chosen('show') === 'depth') showDepth();
}

/** Repairs the depth of a large photo that is already open without a repair, and then replaces it. */
async function repair(found) {
  const {signal} = repairing = new AbortController();
  try {
    const photo = await start(found, {onProgress: undefined}, signal);
    if (signal.aborted || opening) return photo.close();
    take(photo, found);
    if (!isSharp) refocus();
  } catch {
    // The photo remains open without the repair.
  }
}

/** Opens the photo that `find` returns, and then calls `afterwards`. On failure, the previous photo remains open. */
async function openWith(find, afterwards = () => {}) {
  pulling?.abort();
  if (!opening && current) current.view = {state: viewer.state, isSharp};
  opening?.abort();
  const mine = opening = new AbortController(), {signal} = mine;
  let name;
  say('Opening.', true);
  try {
    const found = await find();
    signal.throwIfAborted();
    name = found.name;
    if (found.bitmap) viewer.showPhoto(found.bitmap);
    else viewer.showSharp();
    const isLarge = !found.options.disparity && viewer.width * viewer.height > LARGE;
    const photo = await start(found, isLarge ? {repair: false} : {}, signal);
    signal.throwIfAborted();
    opening = null;
    isFull = false;
    isSharp = true;
    get('error').hidden = true;
    take(photo, found);
    if (!found.isAgain) resetLens(found.options.disparity);
    showLens();
    say(`Opened: ${found.name}, ${photo.width} x ${photo.height}. Tap to focus.`);
    afterwards();
    if (isLarge) repair(found);
    keepState();
    if (tapped) focusAt(tapped);
    tapped = null;
  } catch (error) {
    if (!signal.aborted) stay(error, name);
  }
}

/** Shows the reason of a failure, and shows the previous photo again. */
function stay(error, name) {
  opening = tapped = null;
  fail(error, name);
  if (current?.view) {
    viewer.state = current.view.state;
    isSharp = current.view.isSharp;
  }
  say(current ? `Still open: ${current.found.name}.` : 'Nothing is open.');
}

const demo = afterwards => openWith(() => openDemo(bitmap => {
  viewer.showPhoto(bitmap);
  say('Loading the rest of the demo.', true);
  engine().catch(() => {});  // start() reports failures
}), afterwards);

/** Opens files of the user, and keeps them for the return to the page. */
function openFiles(files) {
  const key = `${Date.now()}-${Math.random()}`;
  return openWith(async () => recognize(await files), async () => {
    kept = {key};
    keepFiles(key, await files);
  });
}

/** Opens the photo again with the other end of its depth as the near end. */
async function swap() {
  if (!current || opening) return;
  const {found, photo} = current, near = photo.near === 'bright' ? 'dark' : 'bright';
  const wasSharp = isSharp;
  await openWith(() => ({...found, bitmap: null, isAgain: true, options: {...found.options, near}, distances: null}),
                 () => wasSharp || refocus());
}

async function showDepth() {
  if (!current || viewer.hasDepth) return;
  const {photo} = current, map = await photo.disparity();
  if (photo === current?.photo) viewer.setDepth({...map, low: photo.focusMin, high: photo.focusMax});
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

async function pull() {
  if (pulling) return pulling.abort();
  if (!current || opening) return;
  pulling = new AbortController();
  get('pull').setAttribute('aria-pressed', 'true');
  try {
    await moveFocus(pulling.signal);
    await refocus();
  } catch (error) {
    if (!opening) fail(error);
  } finally {
    pulling = null;
    get('pull').setAttribute('aria-pressed', 'false');
  }
}

/** Returns the picture as a JPEG: the sharp photo, or the full picture. */
async function toJpeg({images: [file]}) {
  if (isSharp) return call('encode', {file});
  if (!isFull) {
    const pictures = request();
    await showPicture(await pictures, pictures);
  }
  return call('encode', {});
}

async function download() {
  if (!current || opening) return;
  const {found} = current, link = document.createElement('a');
  try {
    link.href = URL.createObjectURL(insertSegments(await toJpeg(found), found.kept));
  } catch (error) {
    return fail(error);
  }
  link.download = `${found.stem}-refocused.jpg`;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}

/** Handles keys: arrow keys move the cross, in larger steps with Shift. Enter and the space bar focus at the cross.
 *  Escape hides the cross. */
function onKey(event) {
  const {width, height} = viewer, step = Math.max(1, Math.round(width / 128)) * (event.shiftKey ? 8 : 1);
  const moves = {ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step]};
  const at = viewer.cross ?? {x: width >> 1, y: height >> 1};
  if (moves[event.key]) {
    const [x, y] = moves[event.key];
    viewer.cross = {
      x: Math.max(0, Math.min(width - 1, at.x + x)),
      y: Math.max(0, Math.min(height - 1, at.y + y))
    };
    say(`Cross at ${Math.round(100 * viewer.cross.x / width)} % from the left, ` +
        `${Math.round(100 * viewer.cross.y / height)} % from the top.`);
  } else if (event.key === 'Enter' || event.key === ' ') {
    focusAt(at);
  } else if (event.key === 'Escape') {
    viewer.cross = null;
  } else {
    return;
  }
  event.preventDefault();
}

function setShow(value) {
  viewer.show = value;
  keepState();
  if (value === 'depth') showDepth();
  if (value === 'blocks') refocus();
}

function setWipe() {
  viewer.wipe = get('wipe').value / 100;
  showLens();
  keepState();
}

function connectFiles() {
  for (const [button, input] of [['open-files', 'files'], ['open-folder', 'folder']]) {
    get(button).addEventListener('click', () => get(input).click());
    get(input).addEventListener('change', () => {
      const files = [...get(input).files];
      get(input).value = '';
      if (files.length) openFiles(files);
    });
  }
  addEventListener('dragover', event => {
    event.preventDefault();
    document.body.classList.add('dropping');
  });
  addEventListener('dragleave', () => document.body.classList.remove('dropping'));
  addEventListener('drop', event => {
    event.preventDefault();
    document.body.classList.remove('dropping');
    openFiles(filesOfDrop(event.dataTransfer));
  });
}

function connect() {
  viewer.canvas.addEventListener('click', event => {
    viewer.cross = null;
    focusAt(viewer.toPixel(event));
  });
  viewer.canvas.addEventListener('keydown', onKey);
  for (const id of ['focus', 'f-stop', 'highlights', 'shape']) {
    get(id).addEventListener('input', () => {
      pulling?.abort();
      refocus();
    });
  }
  for (const radio of document.querySelectorAll('input[name=show]')) {
    radio.addEventListener('change', () => setShow(radio.value));
  }
  get('wipe').addEventListener('input', setWipe);
  get('pull').addEventListener('click', pull);
  get('swap').addEventListener('click', swap);
  get('download').addEventListener('click', download);
  get('open-demo').addEventListener('click', () => {
    kept = {};
    demo();
  });
  get('controls').addEventListener('submit', event => event.preventDefault());
  addEventListener('hashchange', () => {
    if (fromHash(location.hash)) refocus();
  });
  connectFiles();
}

/** Opens the files that were open when the user left the page, or else the demo. */
async function begin() {
  const {show = 'picture', wipe = 0, key, near} = history.state ?? {};
  const restore = () => {
    if (fromHash(location.hash)) refocus();
    setShow(show);
  };
  document.querySelector(`input[name=show][value=${show}]`).checked = true;
  viewer.show = show;
  get('wipe').value = wipe;
  viewer.wipe = wipe / 100;
  fromHash(location.hash);
  showLens();
  const files = key ? await findFiles(key) : null;
  if (!files) return demo(restore);
  kept = {key, near};
  await openWith(async () => {
    const found = await recognize(files), isOther = near !== undefined && near !== found.options.near;
    return isOther ? {...found, options: {...found.options, near}, distances: null} : found;
  }, restore);
}

connect();
begin();
