// SPDX-License-Identifier: Apache-2.0
// Converts the pictures that callers pass as mattes to one byte of alpha per sample, and finds the focus of the subject in
// the same operations as the program (examples/cli/refocus/default_focus.cc).

const GRAY = 8;          // largest difference of the channels of a grey pixel: JPEG files change colours
const TOLERANCE = 0.01;  // by which floats may lie outside their range, because networks and resampling round
const SUBJECT = 128;     // least alpha of a sample that belongs to the subject
const CERTAIN = 192;     // least alpha of a sample that certainly belongs to the subject
const GRID = 256;        // rows and columns of samples

function fail(field, expected, found, value) {
  throw Object.assign(new Error(`${field}: expected ${expected}, found ${found}.`), {code: 'RANGE', field, value});
}

/** Returns the alpha channel, or null if the picture is opaque everywhere. Loops are several times as fast as
 *  Uint8Array.from() with a function. */
function alphaOf(data) {
  const alpha = new Uint8Array(data.length / 4);
  let common = 255;
  for (let i = 0; i < alpha.length; ++i) common &= alpha[i] = data[4 * i + 3];
  return common === 255 ? null : alpha;
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

/** Returns the alpha of floats from 0 to 1. Values outside by at most TOLERANCE are clamped, as in the program. */
function alphaOfFloats(data) {
  const alpha = new Uint8Array(data.length);
  for (let i = 0; i < alpha.length; ++i) {
    const value = data[i];
    if (!(value >= -TOLERANCE && value <= 1 + TOLERANCE)) fail('matte.data', 'values from 0 to 1', value, value);
    alpha[i] = Math.min(Math.max(value, 0), 1) * 255 + 0.5;
  }
  return alpha;
}

/** Returns the alpha of integers of 16 bits. */
function alphaOf16Bits(data) {
  const alpha = new Uint8Array(data.length);
  for (let i = 0; i < alpha.length; ++i) alpha[i] = data[i] / 257 + 0.5;
  return alpha;
}

function convert({data, channels}) {
  if (data instanceof Float32Array) return alphaOfFloats(data);
  if (data instanceof Uint16Array) return alphaOf16Bits(data);
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

/** Returns the median disparity of the places of a regular grid at which the matte has at least `leastAlpha`, or undefined
 *  if there are no such places. */
function findMedian(matte, map, columns, rows, leastAlpha) {
  const placeOf = (k, count, size) => Math.trunc((2 * k + 1) * size / (2 * count)), found = [];
  for (let row = 0; row < rows; ++row) {
    for (let column = 0; column < columns; ++column) {
      const at = ({data, width, height}) => data[placeOf(row, rows, height) * width + placeOf(column, columns, width)];
      if (at(matte) >= leastAlpha && Number.isFinite(at(map))) found.push(at(map));
    }
  }
  return Float32Array.from(found).sort()[found.length >> 1];
}

/** Returns the median disparity of the pixels that certainly belong to the subject, or of all its pixels if the subject is
 *  small or uncertain. Returns undefined if the map is unknown there. */
export const findSubject = (matte, map) =>
    findMedian(matte, map, GRID, GRID, CERTAIN) ?? findMedian(matte, map, matte.width, matte.height, SUBJECT);
