// SPDX-License-Identifier: Apache-2.0
// Checks views, depth maps and coverage, and converts this input of the caller to the layout that the engine reads.
// Used by starfocus.js.

/** Throws a TypeError that names the argument, the expected value and the actual value, unless `holds` is true. */
function expect(holds, what, expected, found) {
  if (!holds) throw new TypeError(`${what}: expected ${expected}, found ${found}.`);
}

/** Returns the bytes of a view, which is an ImageData or an array with 3 or 4 bytes per pixel. */
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

/** Returns the views as arrays of bytes, and the number of bytes per pixel, which is the same for all views. */
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

/** Checks the coverage, which is one byte per pixel or undefined. */
export function checkCoverage(coverage, config) {
  if (coverage === undefined) return;
  expect(coverage instanceof Uint8Array || coverage instanceof Uint8ClampedArray, 'coverage',
         'a Uint8Array or a Uint8ClampedArray', typeof coverage);
  expect(coverage.length === config.width * config.height, 'coverage',
         `${config.width * config.height} bytes`, coverage.length);
}

/** Converts a depth map to a disparity map {data: Float32Array, width, height}. The depth map is a Float32Array of the
 *  picture's size or a DepthMap of starfocus.d.ts. Unknown values become NaN. */
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
  // Each operation rounds to single precision, as starfocus/image.h requires.
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
