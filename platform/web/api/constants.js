// SPDX-License-Identifier: Apache-2.0
// Values of options, and codes of errors. starfocus.d.ts documents them.

export const Mode = Object.freeze({FRAME: 0, BENCHMARK: 1, BLOCK: 2, BLUR: 3});
export const Renderer = Object.freeze({AUTO: 0, LINE_SCAN: 1, SLICES: 2});
export const Shape = Object.freeze({FALL_OFF: 0, DISC: 1, POLYGON: 2, RING: 3});
export const Transfer = Object.freeze({SRGB: 0, NONE: 1});

const names = [
  'ARGUMENT', 'RANGE', 'FEATURE', 'BLUR', 'DISPARITY', 'NOT_FINITE', 'STATE', 'CLOSED', 'MEMORY', 'DECODE',
  'UNSUPPORTED', 'WORKER', 'INTERNAL'
];
export const ErrorCode = Object.freeze(Object.fromEntries(names.map(name => [name, name])));
