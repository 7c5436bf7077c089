// SPDX-License-Identifier: Apache-2.0
// Connects the controls of the page to the session and the viewer, and shows messages.

import {fetchDemo, filesOfDrop, open} from './open.js';
import {decode} from './pixels.js';
import {Session} from './session.js';
import {Viewer} from './viewer.js';

const get = id => document.getElementById(id);
const viewer = new Viewer(get('picture'));
const query = new URLSearchParams(location.search);

let session = null, field = null, opening = 0, times = '', pulling = null;

// ?threads=N in the address sets the number of threads, for tests and measurements.
const engine = {threads: query.has('threads') ? Number(query.get('threads')) : undefined};

/** Shows a status. If `more` is true, further changes follow soon, and screen readers wait for the last change. */
function say(text, more = false) {
  get('status').setAttribute('aria-busy', more);
  get('status').textContent = text;
}

function fail(error) {
  get('error').textContent = error.message;
  get('error').hidden = false;
  say('');
}

const chosen = name => document.querySelector(`input[name=${name}]:checked`).value;

function lens() {
  return {
    focus: Number(get('focus').value),
    stops: Number(get('f-stop').value),
    highlights: 2 ** Number(get('highlights').value),
    shape: get('shape').value,
    blocks: chosen('show') === 'blocks'
  };
}

/** Shows the values of the sliders, and passes them to screen readers. */
function label() {
  const texts = {
    'focus': `disparity ${Number(get('focus').value).toFixed(1)}`,
    'f-stop': `f/${(1.4 * 2 ** (get('f-stop').value / 2)).toFixed(1)}`,
    'highlights': `${(2 ** get('highlights').value).toFixed(1)} times white`,
    'wipe': `${get('wipe').value} % before`
  };
  for (const [id, text] of Object.entries(texts)) {
    get(`${id}-value`).textContent = text;
    get(id).setAttribute('aria-valuetext', text);
  }
}

function showPicture(picture, {shift, milliseconds}) {
  viewer.showPicture(picture);
  const time = `${milliseconds.toFixed(milliseconds < 10 ? 1 : 0)} ms`;
  times = shift > 0 ? `Preview at 1/${2 ** shift}: ${time}` : `${times.replace(/ · .*/, '')} · Full picture: ${time}`;
  say(times, shift > 0);
}

function showProgress(share) {
  say(`${times.replace(/ · .*/, '')} · Full picture: ${Math.round(100 * share)} %`, true);
}

async function refocus() {
  label();
  if (!session) return;
  try {
    await session.refocus(lens());
  } catch (error) {
    if (session) fail(error);
  }
}

async function focusAt(point) {
  if (!session || !point) return;
  pulling?.abort();
  try {
    get('focus').value = await session.focusAt(point);
  } catch (error) {
    return fail(error);
  }
  await refocus();
}

/** Shows a light field and creates its session. If another light field is opened meanwhile, the session is closed. */
async function take(next) {
  const turn = ++opening;
  session?.close();
  session = null;
  field = next;
  viewer.showField(field);
  const focus = get('focus');
  [focus.min, focus.max] = [field.low, field.high];
  focus.value = (field.low + field.high) / 2;
  label();
  const opened = await Session.open(field, lens(), {onPicture: showPicture, onProgress: showProgress, engine});
  if (turn !== opening) return opened.close();
  session = opened;
  const {version, threads} = session.engine;
  get('engine').textContent = `starfocus ${version}, ${threads} ${threads === 1 ? 'thread' : 'threads'}.`;
  say(`Opened: ${field.name}, ${field.width} x ${field.height}. Tap to focus.`);
}

/** Opens the light field that `find` resolves to. If `find` fails, the current light field remains open. */
async function openWith(find) {
  get('error').hidden = true;
  pulling?.abort();
  say('Opening.');
  try {
    await take(await find());
  } catch (error) {
    fail(error);
    say(session ? `Still open: ${field.name}.` : 'Nothing is open.');
  }
}

function openDemo() {
  return openWith(async () => {
    const files = fetchDemo();
    files.forEach(file => file.catch(() => {}));
    viewer.showView(await decode(await files[0]));
    const demo = await open(await Promise.all(files));
    return {...demo, name: `the demo, a ${demo.name}`};
  });
}

async function pull() {
  if (pulling) return pulling.abort();
  if (!session) return;
  pulling = new AbortController();
  get('pull').setAttribute('aria-pressed', 'true');
  try {
    await session.pull(lens(), pulling.signal, focus => {
      get('focus').value = focus;
      label();
    });
    await refocus();
  } catch (error) {
    fail(error);
  } finally {
    pulling = null;
    get('pull').setAttribute('aria-pressed', 'false');
  }
}

async function download() {
  if (!field) return;
  const link = document.createElement('a');
  link.href = URL.createObjectURL(await viewer.toJpeg());
  link.download = 'starfocus.jpg';
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}

/** Handles keys: arrow keys move the cross, in larger steps with Shift. Enter and the space bar focus at the cross.
 *  Escape hides the cross. */
function onKey(event) {
  const step = event.shiftKey ? 64 : 8, {width, height} = viewer.canvas;
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
  radio.addEventListener('change', () => {
    viewer.show = radio.value;
    if (radio.value === 'blocks') refocus();
  });
}
get('wipe').addEventListener('input', () => {
  viewer.wipe = get('wipe').value / 100;
  label();
});
get('pull').addEventListener('click', pull);
get('download').addEventListener('click', download);
get('open-demo').addEventListener('click', openDemo);
for (const [button, input] of [['open-files', 'files'], ['open-folder', 'folder']]) {
  get(button).addEventListener('click', () => get(input).click());
  get(input).addEventListener('change', () => {
    const files = [...get(input).files];
    get(input).value = '';
    if (files.length) openWith(() => open(files));
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
  const files = filesOfDrop(event.dataTransfer);
  openWith(async () => open(await files));
});
get('controls').addEventListener('submit', event => event.preventDefault());

label();
openDemo();
