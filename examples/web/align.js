// SPDX-License-Identifier: Apache-2.0
// Measures and corrects the different heights of points in the two pictures of a stereo photo, in the same operations as
// platform/readers/pair_alignment.cc. Pictures are {data, width, height} with 4 bytes per pixel. Used by pixels_worker.js.

const SMALL_SIDE = 400;      // longest side of the pictures that are compared
const HALF = 5;              // patches of 11 x 11 pixels are compared
const STEP = 9;              // distance between patches
const LEAST_CONTRAST = 480;  // least sum of differences of a patch in each direction
const LEAST_POINTS = 40;     // least number of points from which a pair is judged
const LEAST_DIFFERENCE = 0.3;  // pixels; smaller differences do not matter
const MOST_SLOPE = 0.05;       // a rotation of 3 degrees, or a difference of scale of 5 %
const LIMITS = [4, 3, 2, 1.5, 1, 1];  // distances of matches from the plane; the first planes are inaccurate

const between = (value, low, high) => Math.min(Math.max(value, low), high);

/** Returns the differences between the brightness of pixels, reduced by `factor`, and the mean of 5 x 5 pixels. */
function detailOf({data, width: full, height: rows}, factor) {
  const width = Math.trunc(full / factor), height = Math.trunc(rows / factor), grey = new Int32Array(width * height);
  for (let i = 0; i < grey.length; ++i) {
    const left = i % width * factor, top = Math.trunc(i / width) * factor;
    let sum = 0;
    for (let y = top; y < top + factor; ++y) {
      for (let x = left; x < left + factor; ++x) {
        const at = 4 * (y * full + x);
        sum += data[at] + data[at + 1] + data[at + 2];
      }
    }
    grey[i] = sum / (factor * factor);
  }
  const values = new Int32Array(grey.length);
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      let sum = 0;
      for (let v = -2; v <= 2; ++v) {
        for (let u = -2; u <= 2; ++u) sum += grey[between(y + v, 0, height - 1) * width + between(x + u, 0, width - 1)];
      }
      values[y * width + x] = grey[y * width + x] - Math.trunc(sum / 25);
    }
  }
  return {values, width, height};
}

/** Returns true if the levels of the patch at (x, y) change in both directions. */
function isCorner({values, width}, x, y) {
  let across = 0, down = 0;
  for (let row = y - HALF; row < y + HALF; ++row) {
    for (let at = row * width + x - HALF; at < row * width + x + HALF; ++at) {
      across += Math.abs(values[at + 1] - values[at]);
      down += Math.abs(values[at + width] - values[at]);
    }
  }
  return Math.min(across, down) >= LEAST_CONTRAST;
}

/** Returns the sum of differences between the patches at (ax, ay) and (bx, by), or a value of at least `most`. */
function apart(a, ax, ay, b, bx, by, most) {
  let sum = 0;
  for (let v = -HALF; v <= HALF && sum < most; ++v) {
    const from = (ay + v) * a.width + ax, to = (by + v) * b.width + bx;
    for (let u = -HALF; u <= HALF; ++u) sum += Math.abs(a.values[from + u] - b.values[to + u]);
  }
  return sum;
}

/** Returns the sum of the absolute values of a patch. */
function strengthOf({values, width}, x, y) {
  let sum = 0;
  for (let row = y - HALF; row <= y + HALF; ++row) {
    for (let column = x - HALF; column <= x + HALF; ++column) sum += Math.abs(values[row * width + column]);
  }
  return sum;
}

/** Searches the patch at (x, y) of the left picture in the right picture. Returns its rise, the difference of the
 *  heights; 'none' if the patch fits no place; or 'several'. */
function findRise(left, right, x, y) {
  const reach = Math.trunc(left.width / 8), most = Math.max(2, Math.trunc(left.height / 16));
  const top = Math.max(HALF + 1, y - most), bottom = Math.min(left.height - 2 - HALF, y + most);
  const last = Math.min(left.width - 1 - HALF, x + reach);
  let best = Infinity, other = Infinity, found = {x, y};
  for (let row = top; row <= bottom; ++row) {
    for (let column = Math.max(HALF, x - reach); column <= last; ++column) {
      const sum = apart(left, x, y, right, column, row, other);
      if (sum >= other) continue;
      const isNear = Math.max(Math.abs(column - found.x), Math.abs(row - found.y)) < 3;
      if (sum < best) {
        if (!isNear) other = best;
        best = sum;
        found = {x: column, y: row};
      } else if (!isNear) {
        other = sum;
      }
    }
  }
  if (best >= 0.8 * other) return best <= 0.5 * strengthOf(left, x, y) ? 'several' : 'none';
  if (found.y === top || found.y === bottom) return 'none';
  const [before, after] = [-1, 1].map(step => apart(left, x, y, right, found.x, found.y + step, Infinity));
  const bend = before + after - 2 * best;
  return found.y - y + (bend > 0 ? 0.5 * (before - after) / bend : 0);
}

/** Returns the plane [offset, across, down] of the matches that differ from `plane` by less than `within`, by Gaussian
 *  elimination of its normal equations; or `plane` if the matches define none. */
function fitPlane(matches, within, plane) {
  const rows = [[0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0]];
  for (const {x, y, rise} of matches) {
    const point = [1, x, y];
    if (Math.abs(rise - (plane[0] + plane[1] * x + plane[2] * y)) >= within) continue;
    for (let k = 0; k < 3; ++k) {
      for (let n = 0; n < 3; ++n) rows[k][n] += point[k] * point[n];
      rows[k][3] += point[k] * rise;
    }
  }
  for (let k = 0; k < 3; ++k) {
    if (Math.abs(rows[k][k]) < 1e-6) return plane;  // the points lie on a line
    for (let other = 0; other < 3; ++other) {
      if (other === k) continue;
      const factor = rows[other][k] / rows[k][k];
      for (let n = k; n < 4; ++n) rows[other][n] -= factor * rows[k][n];
    }
  }
  return rows.map((row, k) => row[3] / row[k]);
}

/** Returns {plane, corners, matches, repeated, consistent}, as PairAlignment of the program. */
function measure(left, right) {
  const factor = Math.ceil(Math.max(left.width, left.height) / SMALL_SIDE);
  const from = detailOf(left, factor), to = detailOf(right, factor), matches = [];
  let corners = 0, repeated = 0;
  for (let y = HALF + 1; y < from.height - HALF - 1; y += STEP) {
    for (let x = HALF; x < from.width - HALF; x += STEP) {
      if (!isCorner(from, x, y)) continue;
      ++corners;
      const rise = findRise(from, to, x, y);
      if (rise === 'several') ++repeated;
      else if (rise !== 'none') matches.push({x, y, rise});
    }
  }
  const rises = Float64Array.from(matches, ({rise}) => rise).sort();
  let plane = [rises[rises.length >> 1] ?? 0, 0, 0];
  for (const within of LIMITS) plane = fitPlane(matches, within, plane);
  const consistent = matches.filter(({x, y, rise}) => Math.abs(rise - (plane[0] + plane[1] * x + plane[2] * y)) <= 1).length;
  return {plane: [factor * plane[0], plane[1], plane[2]], corners, matches: matches.length, repeated, consistent};
}

/** Returns the right picture, rotated, scaled and moved so that its points have the heights that `plane` describes. */
function move({data, width, height}, [offset, across, down]) {
  const moved = new Uint8ClampedArray(data.length);
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      const aside = down * (x - width / 2) - across * (y - height / 2);  // a rotation also moves points sideways
      const fromX = between(x + aside, 0, width - 1), fromY = between(y + offset + across * x + down * y, 0, height - 1);
      const column = Math.trunc(fromX), row = Math.trunc(fromY), part = fromX - column, to = 4 * (y * width + x);
      const step = column < width - 1 ? 4 : 0, upper = 4 * (row * width + column), lower = row < height - 1 ? upper + 4 * width : upper;
      for (let c = 0; c < 4; ++c) {
        const above = data[upper + c] + part * (data[upper + step + c] - data[upper + c]);
        const below = data[lower + c] + part * (data[lower + step + c] - data[lower + c]);
        moved[to + c] = Math.trunc(above + (fromY - row) * (below - above) + 0.5);
      }
    }
  }
  return {data: moved, width, height};
}

/** Returns the right picture at the heights of the left one, or null if both have these heights or cannot be compared.
 *  Throws an Error if the pictures do not show one scene. */
export function align(left, right) {
  const {plane, corners, matches, repeated, consistent} = measure(left, right), [offset, across, down] = plane;
  const unrepeated = corners - repeated, isJudged = unrepeated >= LEAST_POINTS;
  if (isJudged && (8 * matches < unrepeated || 2 * consistent < matches || Math.max(Math.abs(across), Math.abs(down)) > MOST_SLOPE)) {
    throw new Error('they are not two pictures of one scene, taken side by side with hardly any rotation');
  }
  const differences = [0, right.width - 1].flatMap(
      x => [0, right.height - 1].map(y => Math.abs(offset + across * x + down * y)));
  return matches < LEAST_POINTS || Math.max(...differences) < LEAST_DIFFERENCE ? null : move(right, plane);
}
