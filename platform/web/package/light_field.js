// SPDX-License-Identifier: Apache-2.0
// Light fields as callers give them, checked and as the engine reads them.

/** Throws one sentence: what, what was expected and what was found. */
function expect(holds, what, expected, found) {
  if (!holds) throw new TypeError(`${what}: expected ${expected}, found ${found}.`);
}

/** Returns the bytes of a view: an ImageData, or an array of bytes with 3 or 4 a pixel. */
function bytesOfView(view, index, width, height) {
  const what = `views[${index}]`;
  if (view?.data !== undefined) {
    expect(view.width === width && view.height === height, what, `${width} x ${height} pixels`,
           `${view.width} x ${view.height}`);
    view = view.data;
  }
  expect(view instanceof Uint8Array || view instanceof Uint8ClampedArray, what,
         'an ImageData, a Uint8Array or a Uint8ClampedArray', typeof view);
  const pixelBytes = view.length / (width * height);
  expect(pixelBytes === 3 || pixelBytes === 4, what,
         `${3 * width * height} bytes of R, G, B or ${4 * width * height} of R, G, B, A`, view.length);
  return view;
}

/** Returns the views as arrays of bytes, and how many bytes a pixel of all of them has. */
export function checkViews(views, config) {
  expect(Array.isArray(views) && views.length === config.views, 'views', `an array of ${config.views}`,
         Array.isArray(views) ? views.length : typeof views);
  const pixels = views.map((view, index) => bytesOfView(view, index, config.width, config.height));
  const pixelBytes = pixels[0].length / (config.width * config.height);
  const other = pixels.findIndex(view => view.length !== pixels[0].length);
  expect(other < 0, `views[${other}]`, `${pixelBytes} bytes a pixel, as views[0] has`,
         pixels[other]?.length);
  return {pixels, pixelBytes};
}

/** Checks coverage, of which there may be none: a byte a pixel. */
export function checkCoverage(coverage, config) {
  if (coverage === undefined) return;
  expect(coverage instanceof Uint8Array || coverage instanceof Uint8ClampedArray, 'coverage',
         'a Uint8Array or a Uint8ClampedArray', typeof coverage);
  expect(coverage.length === config.width * config.height, 'coverage',
         `${config.width * config.height} bytes`, coverage.length);
}

/** Returns the disparity map {data: Float32Array, width, height} of a depth map: a Float32Array as large
 *  as the picture, or an object as starfocus.d.ts has it. Unknown values become NaN. */
export function readDepth(depth, config) {
  const map = depth instanceof Float32Array ? {data: depth} : depth;
  const {data, width = config.width, height = config.height, scale = 1, offset = 0, invalid} = map ?? {};
  const known = [Float32Array, Uint16Array, Uint8Array, Uint8ClampedArray];
  expect(known.some(type => data instanceof type), 'depth',
         'a Float32Array, a Uint16Array or a Uint8Array', typeof data);
  expect(data.length === width * height, 'depth', `${width} x ${height} values`, data.length);
  expect(Number.isInteger(width) && width >= 1 && width <= config.width && Number.isInteger(height) &&
             height >= 1 && height <= config.height,
         'depth', `at most ${config.width} x ${config.height} values`, `${width} x ${height}`);
  // In single precision, each operation rounded, as in starfocus/image.h.
  const f = Math.fround, a = f(scale), b = f(offset), unknown = f(invalid);
  expect(Number.isFinite(a) && a !== 0 && Number.isFinite(b), 'depth',
         'a finite scale other than 0 and a finite offset', `${scale} and ${offset}`);
  if (data instanceof Float32Array && map.scale === undefined && !offset && !map.reciprocal &&
      invalid === undefined) {
    return {data, width, height};
  }
  const disparity = map.reciprocal ? z => f(f(a / z) + b) : z => f(f(a * z) + b);
  const values = Float32Array.from(data, z => z === unknown ? NaN : disparity(z));
  return {data: values, width, height};
}
