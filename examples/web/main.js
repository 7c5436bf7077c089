// SPDX-License-Identifier: Apache-2.0
// Connects the controls of the page, and opens the first photo.

import {filesOfDrop, findOpened} from './files.js';
import {fromHash} from './lens.js';
import {demo, findPerson, openFiles, openWith, recognize, swap, withNear} from './opening.js';
import {get, say, viewer} from './page.js';
import {changeLens, download, focusAt, pull, refocus, showDepth, showLens} from './pictures.js';
import {keepState} from './visit.js';

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
    const point = viewer.toPixel(event);
    viewer.cross = null;
    if (point) focusAt(point);
  });
  viewer.canvas.addEventListener('keydown', onKey);
  for (const id of ['focus', 'f-stop', 'highlights', 'shape']) get(id).addEventListener('input', changeLens);
  for (const radio of document.querySelectorAll('input[name=show]')) {
    radio.addEventListener('change', () => setShow(radio.value));
  }
  get('wipe').addEventListener('input', setWipe);
  get('pull').addEventListener('click', pull);
  get('swap').addEventListener('click', swap);
  get('download').addEventListener('click', download);
  get('find-person').addEventListener('click', findPerson);
  get('open-demo').addEventListener('click', () => demo());
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
  const kept = key ? await findOpened(key) : null;
  if (!kept) return demo(restore);
  await openWith(async () => {
    const found = {...await recognize(kept), key};
    return near === undefined ? found : withNear(found, near);
  }, restore);
}

connect();
begin();
