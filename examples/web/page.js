// SPDX-License-Identifier: Apache-2.0
// The elements, the messages and the state of the page, which its other modules share.

import {toSentence} from './problem.js';
import {Viewer} from './viewer.js';

export const get = id => document.getElementById(id);

/** Returns the value of the chosen radio button. */
export const chosen = name => document.querySelector(`input[name=${name}]:checked`).value;

export const viewer = new Viewer(get('picture'));

export const state = {
  current: null,   // the open photo: {photo, found, isRough, view}
  offered: null,   // the photo without depth that is shown instead: {found, view}, or null
  opening: null,   // AbortController of the photo that is being opened, or null
  tapped: null,    // point that was tapped while a photo was being opened
  isSharp: true,   // true until the first refocusing
  isFull: false    // true if a full picture is shown
};

/** Shows a status. If `more` is true, further changes follow soon, and screen readers wait for the last change. */
export function say(text, more = false) {
  get('status').setAttribute('aria-busy', more);
  get('status').textContent = text;
}

/** Shows an error, unless the call was only cancelled or its photo was replaced. */
export function fail(error, name = state.current?.found.name ?? 'The picture') {
  if (error.name === 'AbortError' || error.code === 'CLOSED') return;
  console.warn(error);  // for developers
  get('error').textContent = toSentence(error, name);
  get('error').hidden = false;
  say('');
}
