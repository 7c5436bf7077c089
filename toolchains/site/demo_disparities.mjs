// SPDX-License-Identifier: Apache-2.0
// usage: demo_disparities.mjs DISPARITY.pfm FOLDER
// Writes the disparities of the demo for the page: disparity.png, with codes of 16 bits in the channels R (high byte)
// and G (low byte), and disparity.json, with {scale, offset}: disparity = scale * code + offset. Browsers decode both
// channels exactly, but reduce PNG files with 16 bits per channel to 8 bits.

import {readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import zlib, {deflateSync} from 'node:zlib';

const STEP = 1 / 512;  // pixels of disparity; finer steps enlarge the file and change no picture
const UP = 2;          // PNG filter: difference to the row above

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

function chunk(name, data) {
  const body = Buffer.concat([Buffer.from(name, 'latin1'), data]), frame = Buffer.alloc(8);
  frame.writeUInt32BE(data.length, 0);
  frame.writeUInt32BE(checksum(body), 4);
  return Buffer.concat([frame.subarray(0, 4), body, frame.subarray(4)]);
}

/** Returns the CRC-32 of PNG. Old versions of node have no zlib.crc32. */
function checksum(bytes) {
  if (zlib.crc32) return zlib.crc32(bytes);
  let crc = ~0;
  for (const byte of bytes) {
    crc ^= byte;
    for (let bit = 0; bit < 8; ++bit) crc = crc >>> 1 ^ (crc & 1 ? 0xEDB88320 : 0);
  }
  return ~crc >>> 0;
}

function encodePng(codes, width, height) {
  const stride = 3 * width, pixels = Buffer.alloc(stride * height), rows = Buffer.alloc((stride + 1) * height);
  codes.forEach((code, i) => pixels.writeUInt16BE(code, 3 * i));
  for (let y = 0; y < height; ++y) {
    rows[y * (stride + 1)] = UP;
    for (let x = 0; x < stride; ++x) {
      const above = y > 0 ? pixels[(y - 1) * stride + x] : 0;
      rows[y * (stride + 1) + 1 + x] = pixels[y * stride + x] - above;
    }
  }
  const header = Buffer.from([0, 0, 0, 0, 0, 0, 0, 0, 8, 2, 0, 0, 0]);  // 8 bits, R, G, B
  header.writeUInt32BE(width, 0);
  header.writeUInt32BE(height, 4);
  return Buffer.concat([
    Buffer.from('\x89PNG\r\n\x1A\n', 'latin1'), chunk('IHDR', header), chunk('IDAT', deflateSync(rows, {level: 9})),
    chunk('IEND', Buffer.alloc(0))
  ]);
}

const [source, folder] = process.argv.slice(2);
if (!folder) {
  console.error('usage: demo_disparities.mjs DISPARITY.pfm FOLDER');
  process.exit(2);
}
const {data, width, height} = readPfm(source);
const offset = data.reduce((a, b) => Math.min(a, b));
const codes = Uint16Array.from(data, value => Math.round((value - offset) / STEP));
writeFileSync(join(folder, 'disparity.png'), encodePng(codes, width, height));
writeFileSync(join(folder, 'disparity.json'), JSON.stringify({scale: STEP, offset}));
