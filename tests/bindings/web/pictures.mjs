// SPDX-License-Identifier: Apache-2.0
// Reads light-field folders and pictures of the program in node. The tests compare the package and the page with
// these pictures.

import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {join} from 'node:path';
import {inflateSync} from 'node:zlib';

/** Paeth predictor of PNG (section 9.4): returns the left, upper or upper left byte, whichever is nearest to
 *  left + up - corner. */
function paeth(left, up, corner) {
  const a = Math.abs(up - corner), b = Math.abs(left - corner), c = Math.abs(left + up - 2 * corner);
  return a <= b && a <= c ? left : b <= c ? up : corner;
}

/** Reads a PNG of R, G, B bytes, the only kind that the program writes. Returns {data, width, height}. */
export function readPng(path) {
  const file = readFileSync(path);
  const width = file.readUInt32BE(16), height = file.readUInt32BE(20);
  if (file[24] !== 8 || file[25] !== 2 || file[28] !== 0) throw new Error(`${path}: no 8-bit R, G, B`);
  const parts = [];
  for (let at = 8; at < file.length; at += 12 + file.readUInt32BE(at)) {
    if (file.toString('latin1', at + 4, at + 8) !== 'IDAT') continue;
    parts.push(file.subarray(at + 8, at + 8 + file.readUInt32BE(at)));
  }
  const rows = inflateSync(Buffer.concat(parts)), stride = 3 * width;
  const data = new Uint8Array(stride * height);
  for (let y = 0; y < height; ++y) {
    const filter = rows[y * (stride + 1)], from = y * (stride + 1) + 1, to = y * stride;
    for (let x = 0; x < stride; ++x) {
      const left = x < 3 ? 0 : data[to + x - 3], up = y === 0 ? 0 : data[to + x - stride];
      const corner = x < 3 || y === 0 ? 0 : data[to + x - stride - 3];
      const guess = [0, left, up, (left + up) >> 1, paeth(left, up, corner)][filter];
      data[to + x] = rows[from + x] + guess;
    }
  }
  return {data, width, height};
}

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

/** Reads five views and the disparity map of a light-field folder. Also returns the range of the disparities. */
export function readLightField(folder) {
  const names = ['+0.0_+0.0', '+1.0_+0.0', '-1.0_+0.0', '+0.0_+1.0', '+0.0_-1.0'];
  const views = names.map(name => readPng(join(folder, `view_${name}.png`)));
  const disparity = readPfm(join(folder, 'disparity.pfm'));
  const low = disparity.data.reduce((a, b) => Math.min(a, b));
  const high = disparity.data.reduce((a, b) => Math.max(a, b));
  return {views, disparity, low, high, width: views[0].width, height: views[0].height};
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
