// SPDX-License-Identifier: Apache-2.0
// The controls of the lens: their values, their texts, and their form in the address of the page.

import {get} from './page.js';

const PHOTO_F_STOP = 1.8, LIGHT_FIELD_F_STOP = 1;  // defaults
// Lenses of Photo.refocus. The numbers are values of Shape; this module does not import the engine, which loads later.
const SHAPES = {
  'soft': {shape: 0},
  'disc': {shape: 1},
  'pentagon': {shape: 2, blades: 5},
  'hexagon': {shape: 2, blades: 6, curvature: 0.5, rotation: 17.5},
  'ring': {shape: 3},
  'cats-eye': {shape: 1, catsEye: 0.75}
};
// Words for the focus, from far to near.
const WORDS = ['farthest', 'far', 'rather far', 'in the middle', 'rather near', 'near', 'nearest'];

const number = id => Number(get(id).value);
const fStop = () => Math.max(smallestFStop, 2 ** (number('f-stop') / 2));
let smallestFStop = 1;  // of the open photo
const highlights = () => 2 ** number('highlights');

/** Focus as a fraction of the way from the farthest to the nearest point. */
function focusShare() {
  const {min, max} = get('focus');
  return Number(max) > Number(min) ? (number('focus') - min) / (max - min) : 0;
}

/** Returns a distance with two digits. */
const toMetres = distance => distance < 1000 ? `${Number(distance.toPrecision(2))} m away` : 'very far away';

/** Returns the focus in metres if the distances of the photo are known, and in words otherwise. */
function focusText(distances) {
  const share = focusShare();
  if (distances) return toMetres(1 / (distances.far + share * (distances.near - distances.far)));
  return WORDS[share <= 0.01 ? 0 : share >= 0.99 ? 6 : 1 + Math.min(4, Math.floor(share * 5))];
}

/** Returns the lens for Photo.refocus. */
export function lens() {
  return {focus: number('focus'), fStop: fStop(), highlights: highlights(), ...SHAPES[get('shape').value]};
}

/** Shows the values of the sliders, and passes them to screen readers. `distances` is {far, near} in 1 / metre, or
 *  null. */
export function showTexts(distances) {
  const texts = {
    'focus': focusText(distances),
    'f-stop': `f/${fStop().toFixed(1)}`,
    'highlights': highlights() === 1 ? 'as in the photo' : `${highlights().toFixed(1)} times white`,
    'wipe': `${get('wipe').value} % before`
  };
  for (const [id, text] of Object.entries(texts)) {
    get(`${id}-value`).textContent = text;
    get(id).setAttribute('aria-valuetext', text);
  }
}

/** Sets the ranges of the sliders for a photo of openPhoto. */
export function setRanges({focusMin, focusMax, fStopMin}) {
  const share = focusShare();
  Object.assign(get('focus'), {min: focusMin, max: focusMax});
  get('focus').value = focusMin + share * (focusMax - focusMin);
  smallestFStop = fStopMin;
  get('f-stop').min = Math.floor(20 * Math.log2(fStopMin)) / 10;
}

/** Sets the f-stop to its default, and the focus to the middle or to the subject. */
export function resetLens(isLightField, subjectFocus) {
  const {min, max} = get('focus');
  get('focus').value = subjectFocus ?? (Number(min) + Number(max)) / 2;
  get('f-stop').value = 2 * Math.log2(isLightField ? LIGHT_FIELD_F_STOP : PHOTO_F_STOP);
}

/** Returns the state of the lens as it appears in the address. */
export function toHash() {
  return new URLSearchParams({
    focus: focusShare().toFixed(4), f: fStop().toFixed(2), shape: get('shape').value, highlights: highlights().toFixed(2)
  }).toString();
}

/** Sets the controls to the state in an address. Returns false if the address has no state. Unknown and wrong values
 *  are ignored. */
export function fromHash(hash) {
  const state = new URLSearchParams(hash.replace(/^#/, ''));
  const read = name => state.has(name) ? Number(state.get(name)) : NaN;
  const focus = read('focus'), f = read('f'), bright = read('highlights'), {min, max} = get('focus');
  if (focus >= 0 && focus <= 1) get('focus').value = Number(min) + focus * (max - min);
  if (f >= 1) get('f-stop').value = 2 * Math.log2(f);
  if (bright >= 1) get('highlights').value = Math.log2(bright);
  if (Object.hasOwn(SHAPES, state.get('shape') ?? '')) get('shape').value = state.get('shape');
  return focus >= 0 && focus <= 1;
}
