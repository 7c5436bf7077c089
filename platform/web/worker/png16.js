// SPDX-License-Identifier: Apache-2.0
// Reads PNG files with one channel of 16 bits, which browsers reduce to 8 bits.

const SIGNATURE = [0x89504E47, 0x0D0A1A0A], MAX_SIDE = 65535;

/** Returns the compressed data of the picture: the contents of all IDAT chunks. */
function readIdat(view) {
  const parts = [];
  for (let at = 8; at + 12 <= view.byteLength;) {
    const length = view.getUint32(at);
    if (view.getUint32(at + 4) === 0x49444154) {  // 'IDAT'
      parts.push(new Uint8Array(view.buffer, at + 8, Math.min(length, view.byteLength - at - 8)));
    }
    at += 12 + length;
  }
  return new Blob(parts);
}

/** Paeth predictor of PNG (section 9.4): returns the left, upper or upper left byte, whichever is nearest to
 *  left + up - corner. */
function paeth(left, up, corner) {
  const a = Math.abs(up - corner), b = Math.abs(left - corner), c = Math.abs(left + up - 2 * corner);
  return a <= b && a <= c ? left : b <= c ? up : corner;
}

/** Reverses the filter of a row in place. `up` is the row above. */
function unfilter(kind, row, up) {
  const guess = [
    () => 0, left => left, (left, above) => above, (left, above) => (left + above) >> 1, paeth
  ][kind];
  for (let i = 0; i < row.length; ++i) {
    row[i] += guess(i < 2 ? 0 : row[i - 2], up[i], i < 2 ? 0 : up[i - 2]);
  }
}

/** Returns the picture of a file as {data: Uint16Array, width, height, channels: 1}, or null if the file is not a PNG
 *  with one channel of 16 bits, is interlaced or is damaged. */
export async function readPng16(file) {
  const view = new DataView(await file.arrayBuffer());
  if (view.byteLength < 33 || SIGNATURE.some((word, i) => view.getUint32(4 * i) !== word)) return null;
  const width = view.getUint32(16), height = view.getUint32(20);
  const isGrey16 = view.getUint8(24) === 16 && view.getUint8(25) === 0 && view.getUint8(28) === 0;
  if (!isGrey16 || !(width >= 1 && width <= MAX_SIDE && height >= 1 && height <= MAX_SIDE)) return null;
  let rows;
  try {
    const inflated = readIdat(view).stream().pipeThrough(new DecompressionStream('deflate'));
    rows = new Uint8Array(await new Response(inflated).arrayBuffer());
  } catch {
    return null;
  }
  const stride = 2 * width;
  if (rows.length < (stride + 1) * height) return null;
  const data = new Uint16Array(width * height);
  let up = new Uint8Array(stride);
  for (let y = 0; y < height; ++y) {
    const at = y * (stride + 1), row = rows.subarray(at + 1, at + 1 + stride);
    if (rows[at] > 4) return null;
    unfilter(rows[at], row, up);
    for (let x = 0; x < width; ++x) data[y * width + x] = row[2 * x] << 8 | row[2 * x + 1];
    up = row;
  }
  return {data, width, height, channels: 1};
}
