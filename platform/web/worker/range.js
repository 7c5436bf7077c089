// SPDX-License-Identifier: Apache-2.0
// Finds the range of disparities of a set of views from an estimate for reduced views, in the same operations as the
// program (examples/cli/disparity/estimate_run.cc).

const SMALL_WIDTH = 256;      // largest width of the reduced views
const LEAST_CONFIDENCE = 48;  // excludes outliers at edges and on flat walls
const LEAST_AGREEING = 6;     // of the 3 x 3 pixels around a pixel, unless the views form a star
const STRAYS = 0.0005;        // part of the values that is discarded at each end
const LIMIT = 500;            // pixels, STARFOCUS_MAX_DISPARITY

const f = Math.fround;

/** Returns the factor by which views of this width are reduced. */
export const factorFor = width => Math.ceil(width / SMALL_WIDTH);

/** Returns the largest disparity that is searched in reduced views of this width. */
export const mostIn = (width, factor) => Math.min(f(width / 8), f(LIMIT / factor));

/** Returns R, G, B of a view, reduced by `factor` in each direction. Each pixel is the mean of its pixels. */
export function shrink({data, width, height, channels}, factor) {
  const across = Math.max(1, Math.trunc(width / factor)), down = Math.max(1, Math.trunc(height / factor));
  const small = new Uint8Array(3 * across * down);
  for (let k = 0; k < small.length; ++k) {
    const x = Math.trunc(k / 3) % across * factor, y = Math.trunc(k / (3 * across)) * factor;
    let sum = 0, count = 0;
    for (let row = y; row < Math.min(y + factor, height); ++row) {
      for (let column = x; column < Math.min(x + factor, width); ++column, ++count) {
        sum += data[channels * (row * width + column) + k % 3];
      }
    }
    small[k] = Math.trunc((sum + (count >> 1)) / count);
  }
  return {data: small, width: across, height: down, channels: 3};
}

/** Returns the number of pixels of the 3 x 3 pixels around (x, y) that are certain and have about the same disparity. */
function countAgreeing({data, width, height}, confidence, x, y) {
  let agreeing = 0;
  for (let row = Math.max(0, y - 1); row <= Math.min(y + 1, height - 1); ++row) {
    for (let column = Math.max(0, x - 1); column <= Math.min(x + 1, width - 1); ++column) {
      const at = row * width + column;
      if (confidence[at] >= LEAST_CONFIDENCE && Math.abs(f(data[at] - data[y * width + x])) <= 1) ++agreeing;
    }
  }
  return agreeing;
}

/** Returns {low, high} of the disparities of the views. `map` is the estimate for the reduced views. */
export function rangeOf(map, confidence, factor, isStar) {
  const most = mostIn(map.width, factor);
  const sure = map.data.filter((_, at) => confidence[at] >= LEAST_CONFIDENCE && (isStar ||
      countAgreeing(map, confidence, at % map.width, Math.trunc(at / map.width)) >= LEAST_AGREEING)).sort();
  const strays = Math.trunc(STRAYS * sure.length), last = sure.length - 1;
  // A range that is extended by one pixel of the reduced views includes surfaces close to discarded outliers.
  const low = Math.max(f((sure[strays] ?? 0) - 1), -most), high = Math.min(f((sure[last - strays] ?? 0) + 1), most);
  return {low: Math.max(f(low * factor), -LIMIT), high: Math.min(f(high * factor), LIMIT)};
}
