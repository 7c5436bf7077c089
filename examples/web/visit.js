// SPDX-License-Identifier: Apache-2.0
// Keeps the lens in the address of the page, and the key of the opened files in the browser's history.

import {toHash} from './lens.js';
import {chosen, get, state} from './page.js';

const DELAY = 300;  // time without changes before the address is updated, ms

let timer = 0;

/** Writes the state of the page to the address and to the browser's history. */
export function keepState() {
  clearTimeout(timer);
  timer = setTimeout(() => {
    if (!state.current) return;
    const {key, options: {near}} = state.current.found;
    history.replaceState({key, near, show: chosen('show'), wipe: get('wipe').value}, '',
                         state.isSharp ? location.pathname + location.search : `#${toHash()}`);
  }, DELAY);
}
