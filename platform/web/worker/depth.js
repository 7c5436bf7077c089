// SPDX-License-Identifier: Apache-2.0
// Converts depth maps to disparities in the memory of the engine.

const f = Math.fround;

/** Returns the conversion of a value to a disparity. Each operation of a DepthMap rounds to single precision, as
 *  starfocus/image.h requires. Maps of openPhoto have `order`: {zero, factor, most}. */
function toDisparity({scale = 1, offset = 0, reciprocal = false, invalid, order}) {
  if (order) return z => f(Math.min(Math.max(order.factor * (z - order.zero), 0), order.most));
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
  const valueOf = map.depth16 ? code => code & 0x1fff || NaN : code => code;
  const table =
    Float32Array.from({length: data instanceof Uint16Array ? 65536 : 256}, (_, code) => convert(valueOf(code)));
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

const OUTLIERS = 1000;  // one of this number of values may be an outlier, at each end

/** Returns the index of the bin that contains the value with this rank, and the rank of the value within the bin. */
function find(counts, rank) {
  let bin = 0;
  while (rank >= counts[bin]) rank -= counts[bin++];
  return {bin, rank};
}

const BINS = 65536;  // 2 ** 16: keys of floats are counted by their upper and lower 16 bits

/** Returns a function from ranks to the finite floats of a map in ascending order, and the number of these floats. The
 *  floats are counted, because sorting 12 megapixels takes seconds. */
function rankFloats(data) {
  const floats = new Int32Array(data.buffer, data.byteOffset, data.length), upper = new Uint32Array(BINS);
  const toKey = bits => bits < 0 ? ~bits : bits | 0x80000000;  // as unsigned integers, keys are ordered like the floats
  let count = 0;
  for (let i = 0; i < floats.length; ++i) {
    const bits = floats[i];
    if ((bits & 0x7f800000) === 0x7f800000) continue;  // infinity or NaN
    ++upper[toKey(bits) >>> 16];
    ++count;
  }
  const valueAt = wanted => {
    const {bin, rank} = find(upper, wanted), lower = new Uint32Array(BINS);
    for (let i = 0; i < floats.length; ++i) {
      const key = toKey(floats[i]);
      if (key >>> 16 === bin) ++lower[key & 0xffff];
    }
    const key = bin << 16 | find(lower, rank).bin;
    return new Float32Array(Int32Array.of(key < 0 ? key & 0x7fffffff : ~key).buffer)[0];
  };
  return {valueAt, count};
}

/** Returns the same for integers, each `channels` apart. */
function rankIntegers(data, channels) {
  const counts = new Uint32Array(data instanceof Uint16Array ? 65536 : 256);
  for (let i = 0; i < data.length; i += channels) ++counts[data[i]];
  return {valueAt: rank => find(counts, rank).bin, count: data.length / channels};
}

/** Returns the quantiles of 0.1 % and 99.9 % of the finite values, {low, high}, and low > high if no value is
 *  finite. */
export function measureRobustly({data, channels}) {
  const {valueAt, count} = data instanceof Float32Array ? rankFloats(data) : rankIntegers(data, channels);
  if (count === 0) return {low: Infinity, high: -Infinity};
  const beyond = Math.trunc((count - 1) / OUTLIERS);
  return {low: valueAt(beyond), high: valueAt(count - 1 - beyond)};
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

/** Returns the samples of a map between which `to` samples of a resized map lie, for one direction. */
function places(from, to) {
  return Array.from({length: to}, (_, k) => {
    const at = Math.min(Math.max((k + 0.5) * from / to - 0.5, 0), from - 1), first = Math.trunc(at);
    return {first, second: Math.min(first + 1, from - 1), weight: f(at - first)};
  });
}

/** Returns the mean of four values with weights. Unknown values (NaN) have no weight. */
function average(values, weights) {
  let sum = 0, total = 0, low = Infinity, high = -Infinity;
  for (let i = 0; i < 4; ++i) {
    const value = values[i];
    if (!Number.isFinite(value)) continue;
    sum = f(sum + f(weights[i] * value));
    total = f(total + weights[i]);
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  return total > 0 ? Math.min(Math.max(f(sum / total), low), high) : NaN;
}

/** Resizes a map to `width` x `height` values by bilinear interpolation, in the same single-precision operations as the
 *  program, and writes it to a Float32Array. */
export function resize(map, width, height, to) {
  const columns = places(map.width, width), values = [0, 0, 0, 0], weights = [0, 0, 0, 0];
  let i = 0;
  for (const row of places(map.height, height)) {
    const upper = map.width * row.first, lower = map.width * row.second, rest = f(1 - row.weight);
    for (const {first, second, weight} of columns) {
      values[0] = map.data[upper + first];
      values[1] = map.data[upper + second];
      values[2] = map.data[lower + first];
      values[3] = map.data[lower + second];
      if (values[0] === values[1] && values[2] === values[3] && values[0] === values[2]) {
        to[i++] = values[0];
        continue;
      }
      const left = f(1 - weight);
      weights[0] = f(left * rest);
      weights[1] = f(weight * rest);
      weights[2] = f(left * row.weight);
      weights[3] = f(weight * row.weight);
      to[i++] = average(values, weights);
    }
  }
}

/** Returns {x, y, value} of the first disparity outside [low, high], or of the first one that is not finite, or
 *  undefined. */
export function findBad({data, width}, low, high) {
  const at = data.findIndex(value => !(value >= low && value <= high));
  return at < 0 ? undefined : {x: at % width, y: Math.trunc(at / width), value: data[at]};
}
