// SPDX-License-Identifier: Apache-2.0
// Tests the installed package in node: the bytes of pictures, cancellation, progress, types of depth maps, and error
// messages.

import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import test, {after, before} from 'node:test';
import {createRefocuser, Mode, Shape, StarfocusError} from 'starfocus';

import {assertSameBytes, dropAlpha, readLightField, readPng} from './pictures.mjs';

const program = process.env.STARFOCUS_PROGRAM, folder = process.env.STARFOCUS_FIELD;
const field = readLightField(folder);
const {width, height, low, high} = field, views = field.views.map(view => view.data);
const options = {width, height, views: 5, disparityMin: low, disparityMax: high, maxBlur: 20, previews: 3, shapes: true};
let refocuser;

/** Refocuses the light-field folder with the program, and returns the R, G, B bytes. */
function refocusByProgram(...values) {
  const path = join(folder, 'out.png');
  execFileSync(program, ['refocus', folder, '-o', path, ...values]);
  return readPng(path).data;
}

before(async () => {
  refocuser = await createRefocuser({...options, threads: 2});
  await refocuser.prepare(views, field.disparity.data);
});
after(() => refocuser.close());

test('its version is that of the package', () => {
  assert.match(refocuser.version, /^\d+\.\d+\.\d+$/);
  const text = readFileSync('node_modules/starfocus/package.json', 'utf8');
  assert.equal(refocuser.version, JSON.parse(text).version);
});

test('a tap gives the bytes of the program', async () => {
  const x = width >> 2, y = height >> 1, focus = await refocuser.focusAt(x, y);
  const picture = await refocuser.refocus({focus, aperture: 0.7});
  assert.equal(picture.width, width);
  assertSameBytes(dropAlpha(picture.data),
                   refocusByProgram('--focus-at', `${x},${y}`, '--aperture', '0.7'));
});

test('changed settings give the bytes of the program', async () => {
  await refocuser.configure({highlights: 4});
  const picture = await refocuser.refocus({focus: 1, shape: Shape.POLYGON, blades: 5});
  await refocuser.configure({highlights: 1});
  assertSameBytes(dropAlpha(picture.data),
                   refocusByProgram('--focus', '1', '--shape', 'polygon:5', '--highlights', '4'));
});

test('shapes of the lens that change from call to call give the bytes of the program', async () => {
  const lenses = {
    'fall-off': {}, 'polygon:7': {shape: Shape.POLYGON, blades: 7}, 'ring:0.25': {shape: Shape.RING, ringInner: 0.25},
    'disc': {shape: Shape.DISC}
  };
  for (const [option, lens] of Object.entries(lenses)) {
    const picture = await refocuser.refocus({focus: 1, ...lens});
    assertSameBytes(dropAlpha(picture.data), refocusByProgram('--focus', '1', '--shape', option));
  }
  await assert.rejects(refocuser.refocus({blades: 99}), error => error.field === 'lens.blades');
});

test('regions, blocks and previews', async () => {
  const whole = await refocuser.refocus({focus: 2, blocks: true});
  const covered = whole.blocks.reduce((sum, block) => sum + block.width * block.height, 0);
  assert.equal(covered, width * height);
  const region = {x: 10, y: 20, width: 31, height: 17}, part = await refocuser.refocus({focus: 2, region});
  for (let y = 0; y < region.height; ++y) {
    const at = 4 * ((y + region.y) * width + region.x), row = 4 * region.width;
    assertSameBytes(part.data.subarray(row * y, row * (y + 1)), whole.data.subarray(at, at + row));
  }
  const preview = await refocuser.preview({focus: 2, shift: 2});
  assert.deepEqual([preview.width, preview.height], [Math.ceil(width / 4), Math.ceil(height / 4)]);
});

test('coverage gives the bytes of the program', async () => {
  const coverage = Uint8Array.from({length: width * height}, (_, i) => i % 251);
  const path = join(folder, 'coverage.pgm');
  writeFileSync(path, Buffer.concat([Buffer.from(`P5 ${width} ${height} 255\n`), coverage]));
  await refocuser.prepare(views, field.disparity.data, {coverage});
  const picture = await refocuser.refocus({focus: 1});
  assertSameBytes(dropAlpha(picture.data), refocusByProgram('--focus', '1', '--coverage', path));
  await assert.rejects(refocuser.prepare(views, field.disparity.data, {coverage: coverage.subarray(1)}),
                       /coverage: expected/);
  await refocuser.prepare(views, field.disparity.data);
});

test('views of R, G, B, A and maps of bytes give the same', async () => {
  const expected = await refocuser.refocus({focus: 2});
  const withAlpha = views.map(view => Uint8ClampedArray.from(
      {length: 4 * width * height}, (_, i) => i % 4 === 3 ? 255 : view[3 * (i >> 2) + i % 4]));
  await refocuser.prepare(withAlpha, {data: field.disparity.data.slice()}, {transfer: true});
  assert.equal(withAlpha[0].length, 0);
  assertSameBytes(await refocuser.refocus({focus: 2}).then(p => p.data), expected.data);
  const codes = Uint8Array.from(field.disparity.data, d => Math.round(8 * (d - low)));
  await refocuser.prepare(views, {data: codes, scale: 1 / 8, offset: low});
  const bytes = await refocuser.refocus({focus: 2});
  const map = Float32Array.from(codes, code => Math.fround(Math.fround(code / 8) + Math.fround(low)));
  await refocuser.prepare(views, map);
  assertSameBytes(await refocuser.refocus({focus: 2}).then(p => p.data), bytes.data);
  await refocuser.prepare(views, field.disparity.data);
});

test('a call is called off while it runs, one that waits at once, and the next one works', async () => {
  const slow = new AbortController(), waiting = new AbortController();
  const first = refocuser.refocus({focus: 5, mode: Mode.BENCHMARK, signal: slow.signal});
  const second = refocuser.refocus({focus: 5, signal: waiting.signal});
  waiting.abort();
  await assert.rejects(second, {name: 'AbortError'});
  await new Promise(resolve => setTimeout(resolve, 30));
  const start = performance.now();
  slow.abort();
  await assert.rejects(first, {name: 'AbortError'});
  assert.ok(performance.now() - start < 1000);
  await assert.rejects(refocuser.refocus({signal: AbortSignal.abort()}), {name: 'AbortError'});
  assert.equal((await refocuser.refocus({focus: 5})).data.length, 4 * width * height);
});

test('progress grows', async () => {
  const told = [];
  await refocuser.refocus({focus: 5, mode: Mode.BENCHMARK, onProgress: (done, rows) => told.push([done, rows])});
  assert.ok(told.length > 0 && told.every(([done, rows], i) => rows === height && done >= (told[i - 1]?.[0] ?? 0)));
});

test('what is wrong is told in a sentence', async () => {
  const wrong = [
    [() => createRefocuser({...options, views: 3}), StarfocusError, /views: .*expected 1, 5, 9 or 17.*found 3/],
    [() => createRefocuser({...options, nonsense: 1}), TypeError, /no field 'nonsense'/],
    [() => refocuser.refocus({nonsense: 1}), TypeError, /refocus: there is no field 'nonsense'/],
    [() => refocuser.refocus({focus: NaN}), StarfocusError, /focus/],
    [() => refocuser.refocus({region: {x: width, y: 0, width: 1, height: 1}}), StarfocusError, /region/],
    [() => refocuser.focusAt(-1, 0), StarfocusError, /outside its range/],
    [() => refocuser.focusAt(2 ** 32, 0), TypeError, /expected whole numbers, found 4294967296, 0/],
    [() => refocuser.focusAt(0.5, 0), TypeError, /expected whole numbers/],
    [() => refocuser.preview({shift: 0}), TypeError, /expected a shift of 1, 2 or 3, found 0/],
    [() => refocuser.preview({shift: 2 ** 32 + 1}), TypeError, /expected a shift/],
    [() => refocuser.refocus({focus: null}), TypeError, /expected a number as 'focus', found object/],
    [() => refocuser.refocus({region: {x: 0, y: 0}}), TypeError, /expected a region with 'width'/],
    [() => refocuser.refocus({region: {x: 0.5, y: 0, width: 1, height: 1}}), StarfocusError, /region/],
    [() => refocuser.configure({disparity_min: 0}), TypeError, /no field 'disparity_min'/],
    [() => refocuser.configure({timing: {block: -1}}), StarfocusError, /timing/],
    [() => createRefocuser({...options, width: width + 0.5}), StarfocusError, /^width: .*expected 1 to 65535/],
    [() => createRefocuser({...options, threads: 0}), TypeError, /expected 1 to 64 threads, found 0/],
    [() => refocuser.prepare(views, {data: new Float32Array(3), width: 1.5, height: 2}), TypeError, /depth: expected/],
    [() => refocuser.prepare(views, {data: field.disparity.data, scale: 1e39}), TypeError, /finite scale/],
    [() => refocuser.configure({width: 1}), TypeError, /'width' stays/],
    [() => refocuser.configure({highlights: 0}), StarfocusError, /highlights: .*expected 1 to 64.*found 0/],
    [() => refocuser.prepare(views.slice(1), field.disparity.data), TypeError, /expected an array of 5/],
    [() => refocuser.prepare([views[0].subarray(3), ...views.slice(1)], field.disparity.data), TypeError, /views\[0\]/],
    [() => refocuser.prepare(views, new Float32Array(5)), TypeError, /depth: expected/],
    [() => refocuser.prepare(views, field.disparity.data.map(d => d + 100)), StarfocusError, /disparity/]
  ];
  for (const [call, type, message] of wrong) {
    await assert.rejects(async () => call(), error => error instanceof type && message.test(error.message),
                         String(call));
  }
  await assert.rejects(refocuser.refocus(), /no light field yet/);
  await refocuser.prepare(views, field.disparity.data);
  assert.equal((await refocuser.refocus({focus: 5})).width, width);
});

test('a closed refocuser refuses', async () => {
  const closed = await createRefocuser({...options, threads: 1});
  closed.close();
  await assert.rejects(closed.prepare(views, field.disparity.data), /was closed/);
});

test('without SIMD: one sentence', {skip: process.arch !== 'x64'}, () => {
  const script = `import('starfocus').then(({createRefocuser}) => createRefocuser(${JSON.stringify(options)}))`;
  assert.throws(() => execFileSync(process.execPath, ['--no-enable-sse4-1', '-e', script], {stdio: 'pipe'}),
                /WebAssembly has no SIMD here/);
});
