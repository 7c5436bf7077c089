// SPDX-License-Identifier: Apache-2.0
// Converts depth maps to disparities in the memory of the engine.

const f = Math.fround;

/** Returns the conversion of a value to a disparity. Each operation rounds to single precision, as starfocus/image.h
 *  requires. */
function toDisparity({scale = 1, offset = 0, reciprocal = false, invalid}) {
  const a = f(scale), b = f(offset), unknown = f(invalid ?? NaN);
  if (reciprocal) return z => z === unknown ? NaN : f(f(a / z) + b);
  return z => z === unknown ? NaN : f(f(a * z) + b);
}

/** Writes the disparities of a DepthMap of starfocus.d.ts to a Float32Array. Unknown values become NaN. The values of
 *  one pixel are `channels` apart. */
export function writeDisparities(map, to, channels = 1) {
  const {data} = map, convert = toDisparity(map), count = to.length;
  if (data instanceof Float32Array) {
    for (let i = 0; i < count; ++i) to[i] = convert(data[i]);
    return;
  }
  const table = Float32Array.from({length: data instanceof Uint16Array ? 65536 : 256}, (_, code) => convert(code));
  for (let i = 0, at = 0; i < count; ++i, at += channels) to[i] = table[data[at]];
}

/** Returns the smallest and the largest finite value of a map, {low, high}; low > high if there is none. */
export function measure(data, channels = 1) {
  let low = Infinity, high = -Infinity;
  for (let i = 0; i < data.length; i += channels) {
    const value = data[i];
    if (value < low && value > -Infinity) low = value;
    if (value > high && value < Infinity) high = value;
  }
  return {low, high};
}

function meanOfRows({data, width, channels}, from, to) {
  let sum = 0, count = 0;
  for (let i = from * width * channels; i < to * width * channels; i += channels) {
    if (!Number.isFinite(data[i])) continue;
    sum += data[i];
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

/** Guesses whether large values of a depth picture are near: true if the lower third of the picture has larger values
 *  than the upper third. */
export function guessNear(map) {
  const third = Math.trunc((map.height + 2) / 3);
  return meanOfRows(map, map.height - third, map.height) > meanOfRows(map, 0, third);
}

/** Returns {x, y, value} of the first disparity outside [low, high], or of the first one that is not finite, or
 *  undefined. */
export function findBad({data, width}, low, high) {
  const at = data.findIndex(value => !(value >= low && value <= high));
  return at < 0 ? undefined : {x: at % width, y: Math.trunc(at / width), value: data[at]};
}
