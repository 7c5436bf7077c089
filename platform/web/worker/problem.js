// SPDX-License-Identifier: Apache-2.0
// Converts statuses of the C library to errors with the words of starfocus.d.ts.

import {findBad} from './depth.js';
import {readText} from './engine.js';

const CODES = {
  3: 'RANGE', 4: 'FEATURE', 7: 'MEMORY', 8: 'MEMORY', 11: 'BLUR', 12: 'DISPARITY', 13: 'NOT_FINITE', 14: 'NOT_FINITE',
  15: 'RANGE'
};
const NAMES = {max_workers: 'threads', preview_shift: 'shift'};

/** Returns the name of a C field in starfocus.d.ts: 'tuning.n_scale' becomes 'nScale'. */
function toName(field) {
  const name = field.replace(/^(study|tuning)\./, '');
  return NAMES[name] ?? name.replace(/_([a-z])/g, (_, letter) => letter.toUpperCase());
}

/** Replaces the C names in the description of a range. */
function toWords(text) {
  return text.replace(/\ba starfocus_(mode|renderer|shape|transfer)\b/g, 'a value of $1')
      .replace('STARFOCUS_FEATURE_SHAPES', 'shapes: true')
      .replace('STARFOCUS_MAX_BLUR', '128')
      .replace('STARFOCUS_MAX_TIMING', '100000000')
      .replace(/STARFOCUS_(\w+)_([A-Z_]+)/g, '$2')
      .replace(/\b[a-z]+(_[a-z]+)+\b/g, toName);
}

/** Returns the starfocus_problem of the last call, or null if it does not describe `status`. */
function readProblem(engine, memory, status) {
  const address = engine.problem();
  if (!address) return null;
  const problem = new DataView(memory.buffer, address, 40);
  const [found, index, name, expected] = [0, 4, 8, 12].map(offset => problem.getInt32(offset, true));
  if (found !== status) return null;
  const value = problem.getFloat64(16, true);
  return {
    field: toName(readText(memory, name).replace('[]', `[${index}]`)),
    expected: toWords(readText(memory, expected)),
    value: Number.isNaN(value) ? undefined : value
  };
}

/** Returns the error of a status of the engine. `given` are the arguments of the call. */
export function errorOf(engine, memory, status, given = {}) {
  const sentence = toWords(readText(memory, engine.status_string(status)));
  const {field = '', expected, value: read} = readProblem(engine, memory, status) ?? {};
  const value = field.split('.').reduce((values, name) => values?.[name], given) ?? read;
  const found = value === undefined ? '' : `, found ${value}`;
  const message = field ? `${field}: ${sentence} (expected ${expected}${found})` : sentence;
  return Object.assign(new Error(message), {code: CODES[status] ?? 'INTERNAL', field, value});
}

/** Adds the position of the first bad disparity of `map` to an error of prepare. */
export function locate(error, map, {disparityMin, disparityMax}) {
  if (error.code !== 'DISPARITY' && error.code !== 'NOT_FINITE') return error;
  const range = error.code === 'DISPARITY';
  const bad = range ? findBad(map, disparityMin, disparityMax) : findBad(map, -Number.MAX_VALUE, Number.MAX_VALUE);
  if (!bad) return error;
  const expected = range ? `${disparityMin} to ${disparityMax}, the range of disparityMin and disparityMax` :
                           'a finite number; fillUnknown: true fills unknown values';
  error.message = `depth: the disparity of pixel (${bad.x}, ${bad.y}) is ${bad.value} (expected ${expected})`;
  return Object.assign(error, {field: 'depth', value: bad.value});
}
