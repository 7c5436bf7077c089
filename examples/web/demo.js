// SPDX-License-Identifier: Apache-2.0
// Loads the demo: five views of a ray-traced scene and their disparities. toolchains/site/web makes the files.

import {call} from './pixels.js';
import {checkPicture} from './problem.js';

const SIDE_VIEWS = ['+1.0_+0.0', '-1.0_+0.0', '+0.0_+1.0', '+0.0_-1.0'];
const ATTEMPTS = 3;

/** Loads a file of the demo. Mobile networks lose connections, so failed transfers are repeated. */
async function load(name, attempt = 1) {
  try {
    const response = await fetch(`demo/${encodeURIComponent(name)}`);
    // In Chromium on a busy machine, blob() of a response that the page preloads may never end.
    if (response.ok) return new Blob([await response.arrayBuffer()]);
    throw new Error(`Cannot load ${name} of the demo: the server returned status ${response.status}.`);
  } catch (error) {
    if (!(error instanceof TypeError)) throw error;
    if (attempt < ATTEMPTS) return load(name, attempt + 1);
    throw new Error(`Cannot load ${name} of the demo: the connection failed.`);
  }
}

const loadView = position => load(`view_${position}.jpg`);
const loadScale = async () => JSON.parse(await (await load('disparity.json')).text());

/** Loads the demo, and returns what open() of open.js returns. Loads the centre view first, and passes the view to
 *  `onCentre` while the other files are loaded. */
export async function openDemo(onCentre) {
  const centre = await loadView('+0.0_+0.0');
  const others = Promise.all([load('disparity.png'), loadScale(), ...SIDE_VIEWS.map(loadView)]);
  others.catch(() => {});  // handled below
  onCentre(await checkPicture(centre, 'The centre view of the demo'));
  const [codes, scale, ...views] = await others;
  return {
    name: 'the demo, a light field of 5 views', stem: 'demo', images: [centre, ...views], bitmap: null,
    depth: await call('disparities', {file: codes, ...scale}), options: {disparity: true}, distances: null, kept: []
  };
}
