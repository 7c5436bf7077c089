// SPDX-License-Identifier: Apache-2.0
// Checks the matte and the options of openPhoto that belong to it. The worker converts the matte.

import {expect} from './errors.js';

const TOLERANCE = 0.03;  // of the proportions of a matte, as in the program
const DEPTH_OPTIONS = ['near', 'disparity', 'repair', 'positions'];

/** Checks which options of openPhoto are present with a depth map, or with only a matte. */
export function checkMatteOptions(options, hasDepth) {
  expect(!options.floor || !hasDepth, 'floor', 'false for a photo with depth', options.floor);
  const wrong = hasDepth ? undefined : DEPTH_OPTIONS.find(name => options[name]);
  expect(!wrong, wrong, 'no value for a photo without depth', options[wrong]);
}

/** Checks the proportions of a matte. Sizes are rounded to whole pixels. Square mattes fit all pictures, because many
 *  networks stretch pictures to squares. */
export function checkMatteSize(matte, {width, height}) {
  if (matte.width === matte.height) return;
  const a = matte.width * height, b = matte.height * width;
  expect(Math.abs(a - b) <= Math.max(TOLERANCE * Math.min(a, b), width, height), 'matte',
         `the proportions of the picture, ${width} x ${height}`, `${matte.width} x ${matte.height}`, 'RANGE');
}
