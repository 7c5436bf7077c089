// SPDX-License-Identifier: Apache-2.0
// Converts the pictures that callers pass as mattes to one byte of alpha per sample, and finds the focus of the subject in
// the same operations as the program (examples/cli/refocus/default_focus.cc).

const GRAY = 8;      // largest difference of the channels of a grey pixel: JPEG files change colours
const SUBJECT = 128;       // least alpha of a sample that belongs to the subject
const SURE_SUBJECT = 192;  // least alpha of a sample whose disparity counts
const GRID = 256;          // rows and columns of the samples

function fail(field, expected, found, value) {
  throw Object.assign(new Error(`${field}: expected ${expected}, found ${found}.`), {code: 'RANGE', field, value});
}

/** Returns the alpha channel, or null if the picture is opaque everywhere. */
function alphaOf(data) {
  const alpha = Uint8Array.from({length: data.length / 4}, (_, i) => data[4 * i + 3]);
  return alpha.every(value => value === 255) ? null : alpha;
}

/** Returns the levels of a grey picture with `channels` bytes per pixel. */
function levelsOf(data, channels) {
  const levels = new Uint8Array(data.length / channels);
  for (let i = 0, at = 0; i < levels.length; ++i, at += channels) {
    const red = data[at];
    if (Math.abs(red - data[at + 1]) > GRAY || Math.abs(red - data[at + 2]) > GRAY) {
      fail('matte', 'alpha or grey levels', 'colours');
    }
    levels[i] = red;
  }
  return levels;
}

/** Returns the alpha of floats from 0 to 1. */
function alphaOfFloats(data) {
  const wrong = data.find(value => !(value >= 0 && value <= 1));
  if (wrong !== undefined) fail('matte.data', 'values from 0 to 1', wrong, wrong);
  return Uint8Array.from(data, value => value * 255 + 0.5);
}

function convert({data, channels}) {
  if (data instanceof Float32Array) return alphaOfFloats(data);
  if (data instanceof Uint16Array) return Uint8Array.from(data, value => value / 257 + 0.5);
  if (channels === 1) return data;
  return channels === 4 && alphaOf(data) || levelsOf(data, channels);
}

/** Returns the matte in decoded pixels as {data: bytes, width, height}. Fails unless the matte has a subject and a
 *  background. */
export function toMatte(pixels) {
  const data = convert(pixels), {width, height} = pixels;
  let subject = 0;
  for (let i = 0; i < data.length; ++i) subject += data[i] >= SUBJECT;
  if (subject === 0) fail('matte', 'a matte with a subject', 'an empty matte');
  if (subject === data.length) fail('matte', 'a matte with a background', 'a matte that is full everywhere');
  return {data, width, height};
}

/** Returns the median disparity of the subject, or undefined if the subject is too small for a regular grid of samples. */
export function findSubject(matte, map) {
  const placeOf = (k, size) => Math.trunc((2 * k + 1) * size / (2 * GRID)), found = [];
  for (let row = 0; row < GRID; ++row) {
    for (let column = 0; column < GRID; ++column) {
      const at = ({data, width, height}) => data[placeOf(row, height) * width + placeOf(column, width)];
      if (at(matte) >= SURE_SUBJECT && Number.isFinite(at(map))) found.push(at(map));
    }
  }
  return Float32Array.from(found).sort()[found.length >> 1];
}
