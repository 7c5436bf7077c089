// SPDX-License-Identifier: Apache-2.0
// Fields of the options, settings and parameters of starfocus.d.ts, with their kinds. The engine checks ranges.

const timing = Object.fromEntries(
    ['block', 'field', 'a', 'b', 'c', 'upsample', 'span', 'hole'].map(name => [name, 'integer']));

/** Settings that Refocuser.configure can change. */
export const SETTINGS = {
  maxBlur: 'number', superblock: 'integer', deblocking: 'integer', timing, nScale: 'number', gather: 'boolean',
  highlights: 'number', fillUnknown: 'boolean', shapes: 'boolean'
};

/** Options of a light field, which cannot change after createRefocuser. */
export const FIXED = {
  width: 'integer', height: 'integer', views: 'integer', disparityMin: 'number', disparityMax: 'number',
  previews: 'integer', maxLayer: 'integer', transfer: 'integer', positions: 'any'
};

/** Options of the worker. */
export const ENGINE = {threads: 'integer', worker: 'any'};

export const LENS = {
  focus: 'number', focusNearer: 'number', focusFarther: 'number', aperture: 'number', shape: 'integer',
  blades: 'integer', theta: 'number', rotation: 'number', curvature: 'number', ringInner: 'number', catsEye: 'number'
};

export const PARAMS = {
  ...LENS, mode: 'integer', renderer: 'integer', blocks: 'boolean',
  region: {x: 'integer', y: 'integer', width: 'integer', height: 'integer'}
};

/** Options of calls that take long. */
export const CALL = {signal: 'signal', onProgress: 'function'};
