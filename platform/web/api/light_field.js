// SPDX-License-Identifier: Apache-2.0
// Checks the views, depth maps and coverage that callers pass. The worker converts the values.

import {checkFields, expect} from './errors.js';

export const isBytes = array => array instanceof Uint8Array || array instanceof Uint8ClampedArray;
export const isDepth = array => isBytes(array) || array instanceof Uint16Array || array instanceof Float32Array;

/** Returns the bytes of a view, which is an ImageData, {data, width, height}, or an array with 3 or 4 bytes per pixel. */
function bytesOfView(view, what, {width, height}) {
  if (view?.data !== undefined) {
    expect(view.width === width && view.height === height, what, `a picture of ${width} x ${height} pixels`,
           `${view.width} x ${view.height}`, 'RANGE');
    view = view.data;
  }
  expect(isBytes(view), what, 'an ImageData, a Uint8Array or a Uint8ClampedArray', view);
  const pixelBytes = view.length / (width * height);
  expect(pixelBytes === 3 || pixelBytes === 4, what,
         `${3 * width * height} bytes of R, G, B or ${4 * width * height} of R, G, B, A`, view.length, 'RANGE');
  return view;
}

/** Returns the views as arrays of bytes. All views have the same number of bytes per pixel. */
export function checkViews(views, config) {
  expect(Array.isArray(views), 'views', `an array of ${config.views}`, views);
  expect(views.length === config.views, 'views', `an array of ${config.views}`, views.length, 'RANGE');
  const pixels = views.map((view, index) => bytesOfView(view, `views[${index}]`, config));
  const other = pixels.findIndex(view => view.length !== pixels[0].length);
  expect(other < 0, `views[${other}]`, `${pixels[0].length / (config.width * config.height)} bytes per pixel, as in ` +
             'views[0]', pixels[other]?.length, 'RANGE');
  return pixels;
}

/** Checks the coverage, which is one byte per pixel or undefined. */
export function checkCoverage(coverage, {width, height}) {
  if (coverage === undefined) return;
  expect(isBytes(coverage), 'coverage', 'a Uint8Array or a Uint8ClampedArray', coverage);
  expect(coverage.length === width * height, 'coverage', `${width * height} bytes`, coverage.length, 'RANGE');
}

const MAX_VIEWS = 17;

/** Checks the positions of views: [u, v] for each view, or undefined. */
export function checkPositions(positions, views) {
  if (positions === undefined) return;
  const isPair = pair => Array.isArray(pair) && pair.length === 2 && pair.every(Number.isFinite);
  expect(Array.isArray(positions) && positions.length === views && views <= MAX_VIEWS && positions.every(isPair),
         'positions', `[u, v] for each of ${Math.min(views, MAX_VIEWS)} views`, positions);
}

const MAP = {
  data: 'any', width: 'integer', height: 'integer', scale: 'number', offset: 'number', reciprocal: 'boolean',
  invalid: 'any', depth16: 'boolean'
};

/** Returns a depth map with all fields of DepthMap in starfocus.d.ts. `depth` is a DepthMap, or a Float32Array of the
 *  picture's size. */
export function checkDepth(depth, config) {
  const given = depth instanceof Float32Array ? {data: depth} : depth;
  checkFields('depth', given, MAP, ['data']);
  const {data, width = config.width, height = config.height, scale = 1, offset = 0} = given;
  const {reciprocal = false, invalid, depth16 = false} = given;
  expect(isDepth(data), 'depth.data', 'a Float32Array, a Uint16Array or a Uint8Array', data);
  expect(!depth16 || data instanceof Uint16Array, 'depth.data', 'a Uint16Array for depth16', data);
  expect(width >= 1 && width <= config.width, 'depth.width', `1 to ${config.width}`, width, 'RANGE');
  expect(height >= 1 && height <= config.height, 'depth.height', `1 to ${config.height}`, height, 'RANGE');
  expect(data.length === width * height, 'depth.data', `${width} x ${height} values`, data.length, 'RANGE');
  expect(Number.isFinite(Math.fround(scale)) && Math.fround(scale) !== 0, 'depth.scale', 'a finite number other than 0',
         scale, 'RANGE');
  expect(Number.isFinite(Math.fround(offset)), 'depth.offset', 'a finite number', offset, 'RANGE');
  expect(invalid === undefined || typeof invalid === 'number', 'depth.invalid', 'a number', invalid);
  return {data, width, height, scale, offset, reciprocal, invalid, depth16};
}
