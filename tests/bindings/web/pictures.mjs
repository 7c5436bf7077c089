// SPDX-License-Identifier: Apache-2.0
// Reads light-field folders and pictures of the program in node. The tests compare the package and the page with
// these pictures.

import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {readFileSync} from 'node:fs';
import {join} from 'node:path';

export const {STARFOCUS_PROGRAM: program, STARFOCUS_FIELD: folder} = process.env;
const out = join(folder, `out-${process.pid}.ppm`);

/** Refocuses a file or folder with the program. Returns {data, width, height} with the R, G, B bytes. */
export function makeByProgram(input, ...values) {
  execFileSync(program, ['refocus', input, '-o', out, ...values], {stdio: 'pipe'});
  const file = readFileSync(out), [header, width, height] = /^P6\s+(\d+)\s+(\d+)\s+255\s/.exec(file.toString('latin1', 0, 64));
  return {data: Uint8Array.from(file.subarray(header.length)), width: Number(width), height: Number(height)};
}

/** Returns only the bytes. */
export const refocusByProgram = (...values) => makeByProgram(...values).data;

/** Reads a picture without blur. */
export const readPicture = (path, map) => makeByProgram(
    path, '--depth', map, '--depth-unit', 'disparity', '--no-repair', '--focus', '0', '--strength', '0');

/** Reads a little-endian PFM. Returns {data, width, height}, with the top row first. */
function readPfm(path) {
  const file = readFileSync(path);
  const [header, width, height] = /^Pf\s+(\d+)\s+(\d+)\s+-\S+\s/.exec(file.toString('latin1', 0, 64));
  const data = new Float32Array(width * height);
  for (let i = 0; i < data.length; ++i) {
    const row = height - 1 - Math.floor(i / width);
    data[i] = file.readFloatLE(header.length + 4 * (row * width + (i % width)));
  }
  return {data, width: Number(width), height: Number(height)};
}

/** Reads five views and the disparity map of the folder. Also returns the range of the disparities. */
export function readLightField() {
  const names = ['+0.0_+0.0', '+1.0_+0.0', '-1.0_+0.0', '+0.0_+1.0', '+0.0_-1.0'], map = join(folder, 'disparity.pfm');
  const views = names.map(name => readPicture(join(folder, `view_${name}.png`), map)), disparity = readPfm(map);
  const low = disparity.data.reduce((a, b) => Math.min(a, b)), high = disparity.data.reduce((a, b) => Math.max(a, b));
  return {views, disparity, low, high, width: disparity.width, height: disparity.height};
}

/** Converts R, G, B, A bytes to R, G, B bytes. */
export function dropAlpha(data) {
  return data.filter((_, i) => i % 4 < 3);
}

/** Fails unless both arrays are equal. The message has the number of differing bytes, not the bytes. */
export function assertSameBytes(actual, expected) {
  assert.equal(actual.length, expected.length);
  const wrong = actual.reduce((count, byte, i) => count + (byte !== expected[i]), 0);
  assert.equal(wrong, 0, `${wrong} of ${actual.length} bytes differ`);
}
