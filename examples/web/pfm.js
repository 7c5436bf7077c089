// SPDX-License-Identifier: Apache-2.0
// Reads PFM files, which contain maps of floats.

/** Parses a PFM file with one channel. Returns {data: Float32Array, width, height}, with the top row first. In a PFM
 *  file the bottom row is first. Infinite values become NaN, which is unknown. `name` is the name of the file in
 *  messages. */
export function parsePfm(buffer, name) {
  const header = new TextDecoder('latin1').decode(buffer.slice(0, 128));
  const match = /^Pf\s+(\d+)\s+(\d+)\s+(-?[\d.]+(?:e[-+]?\d+)?)\s/i.exec(header);
  if (!match) throw new Error(`${name} is not a depth map: expected a PFM file with one channel.`);
  const [width, height, scale] = match.slice(1).map(Number);
  const expected = match[0].length + 4 * width * height;
  if (buffer.byteLength < expected || width < 1 || height < 1) {
    throw new Error(`${name} is cut off: ${width} x ${height} values need ${expected} bytes, but the file has ${buffer.byteLength}.`);
  }
  const view = new DataView(buffer, match[0].length), data = new Float32Array(width * height);
  for (let y = 0; y < height; ++y) {
    const row = 4 * width * (height - 1 - y);
    for (let x = 0; x < width; ++x) {
      const value = view.getFloat32(row + 4 * x, scale < 0);
      data[y * width + x] = Number.isFinite(value) ? value : NaN;
    }
  }
  return {data, width, height};
}
