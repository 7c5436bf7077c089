// SPDX-License-Identifier: Apache-2.0
// Light-field folders and pictures of the program, read by node: what the package and the page are
// compared with.

import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {join} from 'node:path';
import {inflateSync} from 'node:zlib';

/** Which of left, upper and upper left byte is nearest to left + up - corner (PNG, section 9.4). */
function paeth(left, up, corner) {
  const a = Math.abs(up - corner), b = Math.abs(left - corner), c = Math.abs(left + up - 2 * corner);
  return a <= b && a <= c ? left : b <= c ? up : corner;
}

/** Returns {data, width, height} of a PNG of R, G, B bytes, the only kind that the program writes. */
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

/** Returns {data, width, height} of a little-endian map of floats; its file has the lowest row first. */
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

/** Returns the centre view and the four around it, and the disparity map, of a folder. */
export function readLightField(folder) {
  const names = ['+0.0_+0.0', '+1.0_+0.0', '-1.0_+0.0', '+0.0_+1.0', '+0.0_-1.0'];
  const views = names.map(name => readPng(join(folder, `view_${name}.png`)));
  const disparity = readPfm(join(folder, 'disparity.pfm'));
  const low = disparity.data.reduce((a, b) => Math.min(a, b));
  const high = disparity.data.reduce((a, b) => Math.max(a, b));
  return {views, disparity, low, high, width: views[0].width, height: views[0].height};
}

/** Returns the R, G, B of R, G, B, A. */
export function dropAlpha(data) {
  return data.filter((_, i) => i % 4 < 3);
}

/** Fails, with a number instead of all bytes, unless both are the same. */
export function assertSameBytes(actual, expected) {
  assert.equal(actual.length, expected.length);
  const wrong = actual.reduce((count, byte, i) => count + (byte !== expected[i]), 0);
  assert.equal(wrong, 0, `${wrong} of ${actual.length} bytes differ`);
}
