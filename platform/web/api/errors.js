// SPDX-License-Identifier: Apache-2.0
// The error class of the package, and checks of arguments that throw this error.

const BRAND = Symbol.for('starfocus.StarfocusError');

/** See starfocus.d.ts. The ES module and the CommonJS module have a class each, and `instanceof` accepts errors of
 *  both classes. */
export class StarfocusError extends Error {
  constructor(code, message, {field = '', value} = {}) {
    super(message);
    this.name = 'StarfocusError';
    this.code = code;
    this.field = field;
    this.value = value;
  }

  get [BRAND]() {
    return true;
  }

  static [Symbol.hasInstance](error) {
    return error?.[BRAND] === true;
  }
}

/** Returns a short description of a value for messages: numbers and strings as they are, other values by their class. */
export function describe(value) {
  if (value === null || value === undefined) return String(value);
  if (typeof value === 'string') return `'${value.length > 40 ? `${value.slice(0, 40)}...` : value}'`;
  if (typeof value !== 'object' && typeof value !== 'function') return String(value);
  const name = value.constructor?.name || typeof value;
  return `${/^[AEIO]/.test(name) ? 'an' : 'a'} ${name}`;
}

/** Throws a StarfocusError that names the field, the expected values and the given value, unless `holds` is true. */
export function expect(holds, field, expected, value, code = 'ARGUMENT') {
  if (holds) return;
  throw new StarfocusError(code, `${field}: expected ${expected}, found ${describe(value)}.`, {field, value});
}

const KINDS = {
  number: [value => typeof value === 'number', 'a number'],
  integer: [value => typeof value === 'number', 'an integer'],
  boolean: [value => typeof value === 'boolean', 'true or false'],
  function: [value => typeof value === 'function', 'a function'],
  object: [value => typeof value === 'object' && value !== null && !Array.isArray(value) && !ArrayBuffer.isView(value),
           'an object'],
  signal: [value => typeof value?.addEventListener === 'function' && 'aborted' in value, 'an AbortSignal'],
  any: [() => true, '']
};

function checkField(field, value, kind) {
  if (typeof kind === 'object') return checkFields(field, value, kind);
  const [holds, expected] = KINDS[kind];
  expect(holds(value), field, expected, value);
  if (kind === 'number') expect(!Number.isNaN(value), field, expected, value, 'RANGE');
  if (kind === 'integer') expect(Number.isInteger(value), field, expected, value, 'RANGE');
}

/** Checks the argument `values` of a call: an object with some of the fields of `kinds`, which maps names to kinds or
 *  to the kinds of an inner object. Fields with the value undefined count as omitted. `what` is the name of the call
 *  or of the object. */
export function checkFields(what, values, kinds, required = []) {
  expect(KINDS.object[0](values), what, 'an object', values);
  for (const [name, value] of Object.entries(values)) {
    const names = Object.keys(kinds);
    expect(names.includes(name), what, `one of the fields ${names.join(', ')}`, name);
    if (value !== undefined) checkField(name, value, kinds[name]);
  }
  const missing = required.find(name => values[name] === undefined);
  if (missing === undefined) return;
  throw new StarfocusError('ARGUMENT', `${what}: expected a value of ${missing}, found none.`, {field: missing});
}
