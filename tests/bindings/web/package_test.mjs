// SPDX-License-Identifier: Apache-2.0
// Tests createRefocuser of the installed package in node: the bytes of pictures, cancellation, progress, types of depth
// maps, and errors. photo_test.mjs tests openPhoto.

import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import test, {after, before} from 'node:test';
import {createRefocuser, ErrorCode, estimateDisparity, Mode, openPhoto, Shape, StarfocusError} from 'starfocus';

import {assertSameBytes, dropAlpha, folder, program, readLightField, refocusByProgram} from './pictures.mjs';

const field = readLightField();
const {width, height, low, high} = field, views = field.views.map(view => view.data);
const options = {width, height, views: 5, disparityMin: low, disparityMax: high, maxBlur: 20, previews: 3, shapes: true};
let refocuser;

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

test('taps, changed settings and a range in focus give the bytes of the program', async () => {
  const x = width >> 2, y = height >> 1, focus = await refocuser.focusAt({x, y});
  for (const [settings, params, values] of [
    [{}, {focus, aperture: 0.7}, ['--focus-at', `${x},${y}`, '--aperture', '0.7']],
    [{highlights: 4}, {focus: 1, shape: Shape.POLYGON, blades: 5}, ['--focus', '1', '--shape', 'polygon:5', '--highlights', '4']],
    [{highlights: 1}, {focus: 1, focusNearer: 0.75, focusFarther: 0.75}, ['--focus-range', '1.75,0.25']]
  ]) {
    await refocuser.configure(settings);
    const picture = await refocuser.refocus(params);
    assert.equal(picture.width, width);
    assertSameBytes(dropAlpha(picture.data), refocusByProgram(folder, ...values));
  }
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

/** Calls a function with a refocuser, and closes the refocuser. */
async function withRefocuser(options, call) {
  const opened = await createRefocuser(options);
  try {
    return await call(opened);
  } finally {
    opened.close();
  }
}

const STAR = [[0, 0], [1, 0], [-1, 0], [0, 1], [0, -1]];

test('views at positions give the bytes of the program, in any order', async () => {
  const focused = (order, positions) => withRefocuser({...options, views: order.length, positions}, async opened => {
    await opened.prepare(order.map(index => views[index]), field.disparity.data);
    await opened.configure({highlights: 2});
    await opened.configure({highlights: 1});
    return (await opened.refocus({focus: 1})).data;
  });
  const star = await focused([0, 1, 2, 3, 4]);
  assertSameBytes(dropAlpha(star), refocusByProgram(folder, '--focus', '1'));
  assertSameBytes(await focused([0, 4, 2, 1, 3], [0, 4, 2, 1, 3].map(index => STAR[index])), star);
  for (const order of [[0, 1], [0, 4, 2]]) {
    const pairs = order.map(index => STAR[index]), part = join(folder, `part-${order.length}`);
    execFileSync(program, ['import', folder, part, '--views', pairs.join(':')], {stdio: 'pipe'});
    const expected = refocusByProgram(part, '--focus', '1');
    assertSameBytes(dropAlpha(await focused(order, pairs)), expected);
    const photo = await openPhoto(order.map(index => field.views[index]), field.disparity, {disparity: true, positions: pairs});
    assertSameBytes(dropAlpha((await photo.refocus({focus: 1})).data), expected);
    photo.close();
    await checkEstimate(order.map(index => field.views[index]), {positions: pairs}, part);
  }
  await checkEstimate(field.views, {}, folder);
});

/** Checks that an estimate is that of the program for the folder, with a searched and with a given range. */
async function checkEstimate(pictures, given, input) {
  const path = join(folder, 'map.pfm'), steps = [];
  for (const range of [[], [-4, 5]]) {
    const [disparityMin, disparityMax] = range;
    execFileSync(program, ['disparity', input, '-o', path, ...range.length ? ['--range', range.join(':')] : []], {stdio: 'pipe'});
    const {data} = await estimateDisparity(pictures, {...given, disparityMin, disparityMax, onProgress: done => steps.push(done)});
    const bytes = readFileSync(path).subarray(-4 * width * height), row = 4 * width;
    for (let y = 0; y < height; ++y) {
      assertSameBytes(new Uint8Array(data.buffer, row * y, row), bytes.subarray(row * (height - 1 - y), row * (height - y)));
    }
  }
}

test('coverage gives the bytes of the program', async () => {
  const coverage = Uint8Array.from({length: width * height}, (_, i) => i % 251);
  const path = join(folder, 'coverage.pgm');
  writeFileSync(path, Buffer.concat([Buffer.from(`P5 ${width} ${height} 255\n`), coverage]));
  await refocuser.prepare(views, field.disparity.data, {coverage});
  const picture = await refocuser.refocus({focus: 1});
  assertSameBytes(dropAlpha(picture.data), refocusByProgram(folder, '--focus', '1', '--coverage', path));
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

test('disparity returns the prepared map', async () => {
  const map = await refocuser.disparity();
  assert.deepEqual([map.width, map.height], [width, height]);
  assertSameBytes(new Uint8Array(map.data.buffer), new Uint8Array(Float32Array.from(field.disparity.data).buffer));
});

test('focusAt takes fractions and pixels of the picture, whatever the size of the map', async () => {
  const half = {data: new Float32Array((width >> 1) * (height >> 1)), width: width >> 1, height: height >> 1};
  half.data.fill(1);
  half.data.subarray(half.width * (half.height >> 1)).fill(2);
  await refocuser.prepare(views, half);
  assert.equal(await refocuser.focusAt({x: width - 0.01, y: 10.5}), 1);
  assert.equal(await refocuser.focusAt({x: 0, y: height - 0.01}), 2);
  await refocuser.prepare(views, field.disparity.data);
});

test('an aborted call rejects at once, and the next call works', async () => {
  const slow = new AbortController(), waiting = new AbortController();
  const first = refocuser.refocus({focus: 5, mode: Mode.BENCHMARK, signal: slow.signal});
  const second = refocuser.refocus({focus: 5, signal: waiting.signal});
  waiting.abort();
  await assert.rejects(second, {name: 'AbortError'});
  await new Promise(resolve => setTimeout(resolve, 30));
  slow.abort();
  await assert.rejects(first, {name: 'AbortError'});
  await assert.rejects(refocuser.refocus({signal: AbortSignal.abort()}), {name: 'AbortError'});
  assert.equal((await refocuser.refocus({focus: 5})).data.length, 4 * width * height);
});

test('with shared memory, an aborted prepare or preview ends within milliseconds, and the worker goes on', async () => {
  const size = {width: 1000, height: 800}, pixels = size.width * size.height;
  const view = Uint8Array.from({length: 3 * pixels}, (_, i) => i % 3000 * 7 & 255);
  const map = Float32Array.from({length: pixels}, (_, i) => i % 1000 > 700 ? 20 : 3);
  await withRefocuser({...size, views: 1, disparityMin: -1, disparityMax: 21, previews: 1, threads: 2}, async large => {
    /** Aborts a call in the middle, on a machine of any load, and checks that the next call does not wait for its end. */
    const abort = async (call, next) => {
      for (let attempt = 0; attempt < 10; ++attempt) {
        const begin = performance.now();
        await call();
        const whole = performance.now() - begin, stop = new AbortController(), running = call(stop.signal);
        setTimeout(() => stop.abort(), whole / 4);
        if (await running.then(() => true, error => error.name !== 'AbortError')) continue;
        const stopped = performance.now();
        await next();
        if (performance.now() - stopped < whole / 3) return;
      }
      assert.fail(`${call}: expected the worker to be free soon after the abort`);
    };
    await abort(signal => large.prepare([view], map, {repair: true, signal}),
                () => assert.rejects(large.refocus({focus: 3}), {code: 'STATE'}));
    await large.prepare([view], map);
    const region = {x: 0, y: 0, width: 1000, height: 700}, next = () => large.focusAt({x: 5, y: 5});
    await abort(signal => large.preview({focus: 20, signal}), next);
    await abort(signal => large.refocus({focus: 20, region, signal}), next);
    await abort(signal => large.refocus({focus: 20, blocks: true, signal}), next);
  });
});

test('an aborted prepare rejects at once; without a light field calls fail; the next prepare works', async () => {
  const stop = new AbortController();
  const preparing = refocuser.prepare(views, field.disparity.data, {repair: true, signal: stop.signal});
  const waiting = refocuser.refocus({focus: 5});
  setTimeout(() => stop.abort(), 20);
  await assert.rejects(preparing, {name: 'AbortError'});
  await assert.rejects(waiting, {code: 'STATE'});
  await assert.rejects(refocuser.refocus({focus: 5}), {code: 'STATE'});
  for (const delay of [0, 20]) {
    const signal = AbortSignal.timeout(delay), aborted = refocuser.prepare(views, field.disparity.data, {repair: true, signal});
    const next = refocuser.prepare(views, field.disparity.data);
    await assert.rejects(aborted, {name: 'TimeoutError'});
    await next;
    assert.equal((await refocuser.refocus({focus: 5})).width, width);
  }
});

test('another worker, after an aborted prepare, has the settings that were configured', async () => {
  const size = {width: 8, height: 8}, pixels = [new Uint8Array(192)], stop = new AbortController();
  await withRefocuser({...size, views: 1, disparityMin: 0, disparityMax: 1, maxBlur: 64, threads: 1}, async small => {
    await small.configure({maxBlur: undefined, timing: {a: 5}});
    const aborted = small.prepare(pixels, new Float32Array(64), {signal: stop.signal});
    stop.abort();
    await assert.rejects(aborted, {name: 'AbortError'});
    await small.prepare(pixels, new Float32Array(64));
    assert.equal((await small.refocus({focus: 45})).width, 8);
  });
});

test('progress grows, in prepare with a repair over both steps', async () => {
  const grows = (calls, end) => calls.length > 0 && calls.every(([done, total], i) => total === end && done >= (calls[i - 1]?.[0] ?? 0));
  const rows = [], steps = [], size = {width: 1600, height: 1200}, pixels = size.width * size.height;
  await refocuser.refocus({focus: 5, mode: Mode.BENCHMARK, onProgress: (...values) => rows.push(values)});
  assert.ok(grows(rows, height));
  const view = Uint8Array.from({length: 3 * pixels}, (_, i) => i % 4800 * 7 & 255);
  const map = Float32Array.from({length: pixels}, (_, i) => i % 1600 > 700 ? 20 : 3);
  await withRefocuser({...size, views: 1, disparityMin: -1, disparityMax: 21, threads: 1}, large => large.prepare(
      [view], map, {repair: true, onProgress: (...values) => steps.push(values)}));
  assert.ok(steps.length > 1 && grows(steps, 2 * size.height));
});

test('an exception of onProgress rejects the call', async () => {
  let count = 0;
  const fail = () => {
    ++count;
    throw new RangeError('from onProgress');
  };
  await assert.rejects(refocuser.refocus({focus: 5, mode: Mode.BENCHMARK, onProgress: fail}), /from onProgress/);
  assert.equal(count, 1);
  assert.equal((await refocuser.refocus({focus: 5})).width, width);
});

test('wrong arguments are rejected with a code, the field and the value', async () => {
  const map = field.disparity.data;
  const wrong = [
    [() => createRefocuser(), 'ARGUMENT', /createRefocuser: expected an object, found undefined/],
    [() => createRefocuser({width, height, views: 5, disparityMin: 0}), 'ARGUMENT', /a value of disparityMax, found none/],
    [() => createRefocuser({...options, nonsense: 1}), 'ARGUMENT', /one of the fields width, .*found 'nonsense'/],
    [() => createRefocuser({...options, positions: [[0, 0], [1, 0]]}), 'ARGUMENT', /^positions: expected \[u, v\] for each of 5 views/],
    [() => createRefocuser({...options, views: 2, positions: [[0, 0], [1, NaN]]}), 'ARGUMENT', /^positions: expected \[u, v\]/],
    [() => createRefocuser({...options, views: 2, positions: [[0, 0], [1.5, 0]]}), 'RANGE', /^positions\[1\]\.u: .*1\.5/],
    [() => withRefocuser({...options, positions: STAR},
                         opened => opened.prepare(views, field.disparity.data, {repair: true})), 'ARGUMENT', /^repair: expected false/],
    [() => estimateDisparity(field.views.slice(0, 2)), 'ARGUMENT', /^image: expected 5, 9 or 17 views/],
    [() => estimateDisparity(field.views.slice(0, 1), {positions: [[0, 0]]}), 'ARGUMENT', /^image: expected an array of 2 to 17/],
    [() => createRefocuser({...options, threads: 0}), 'RANGE', /^threads: expected 1 to 64, found 0/],
    [() => refocuser.refocus({focusNearer: -1}), 'RANGE', /^focusNearer: .*found -1/],
    [() => createRefocuser({...options, worker: 5}), 'ARGUMENT', /^worker: expected a URL, found 5/],
    [() => refocuser.refocus({focus: NaN}), 'RANGE', /^focus: expected a number, found NaN/],
    [() => refocuser.prepare(views, map, {coverage: [1]}), 'ARGUMENT', /^coverage: expected a Uint8Array/],
    [() => refocuser.refocus({focus: 1000}), 'BLUR', /^focus|^aperture|blur/i],
    [() => refocuser.refocus({signal: {}}), 'ARGUMENT', /^signal: expected an AbortSignal, found an Object/],
    [() => refocuser.refocus({region: {x: width, y: 0, width: 1, height: 1}}), 'RANGE', /region/],
    [() => refocuser.focusAt({x: 2 ** 32 + 5, y: 5}), 'RANGE', /^x: expected 0 to 319, found 4294967301/],
    [() => refocuser.preview({shift: 2 ** 32 + 1}), 'RANGE', /^shift: expected 1, 2 or 3/],
    [() => refocuser.configure({width: 1}), 'ARGUMENT', /width cannot change after createRefocuser/],
    [() => refocuser.prepare(views, {data: map, scale: 1e39}), 'RANGE', /^depth.scale: expected a finite number/],
    [() => refocuser.refocus({mode: 1e10}), 'RANGE', /^mode: .*expected a value of mode, found 10000000000/],
    [() => refocuser.prepare(views, new Float32Array(5)), 'RANGE', /^depth.data: expected 320 x 240 values, found 5/],
    [() => refocuser.prepare([views[0].subarray(3), ...views.slice(1)], map), 'RANGE', /^views\[0\]/],
    [() => refocuser.prepare(views, map.map((d, i) => i === 3 ? Infinity : d)), 'NOT_FINITE', /pixel \(3, 0\) is Infinity/],
    [() => refocuser.prepare(views, map.map((d, i) => i === width + 7 ? 100 : d)), 'DISPARITY',
     /depth: the disparity of pixel \(7, 1\) is 100 \(expected /]
  ];
  for (const [call, code, message] of wrong) {
    await assert.rejects(async () => call(), error => {
      assert.ok(error instanceof StarfocusError, `${call}: ${error.stack}`);
      assert.equal(error.code, code, `${call}: ${error.message}`);
      assert.match(error.message, message, String(call));
      assert.doesNotMatch(error.message, /max_workers|STARFOCUS_|disparity_m/, String(call));
      return true;
    }, String(call));
  }
  assert.equal(ErrorCode.STATE, 'STATE');
  await assert.rejects(refocuser.refocus(), {code: ErrorCode.STATE});
  await refocuser.prepare(views, field.disparity.data);
  assert.equal((await refocuser.refocus({focus: 5})).width, width);
});

test('the types have every field that the package accepts', async () => {
  const types = readFileSync('node_modules/starfocus/starfocus.d.ts', 'utf8'), image = field.views[0], odd = {nonsense: 1};
  const calls = [
    createRefocuser({...options, ...odd}), refocuser.configure(odd), refocuser.refocus(odd), refocuser.preview(odd), refocuser.focusAt(odd),
    refocuser.prepare(views, {data: field.disparity.data, ...odd}), refocuser.prepare(views, field.disparity.data, odd),
    openPhoto(image, field.disparity, odd), estimateDisparity(field.views, odd)
  ];
  for (const call of calls) {
    const {message} = await call.then(() => ({}), error => error), [, names] = /one of the fields (.*), found 'nonsense'/.exec(message);
    assert.deepEqual(names.split(', ').filter(name => !RegExp(`\\b${name}\\??:`).test(types)), [], message);
  }
});

test('calls after close reject with the code CLOSED', async () => {
  const closed = await createRefocuser({...options, threads: 1}), waiting = closed.prepare(views, field.disparity.data);
  closed.close();
  await assert.rejects(waiting, {name: 'StarfocusError', code: 'CLOSED'});
  await assert.rejects(closed.prepare(views, field.disparity.data), {name: 'StarfocusError', code: 'CLOSED'});
});

test('an open refocuser does not keep node running, and pictures need no browser', async () => {
  const script = `import('starfocus').then(async ({createRefocuser}) => {
    const refocuser = await createRefocuser({width: 8, height: 8, views: 1, disparityMin: 0, disparityMax: 1});
    await refocuser.prepare([new Uint8Array(192)], new Float32Array(64));
    console.log((await refocuser.refocus()).data.length);
  })`;
  assert.equal(String(execFileSync(process.execPath, ['-e', script], {timeout: 20000})).trim(), '256');
  const picture = await refocuser.refocus();
  assert.throws(() => picture.toImageData(), {code: 'UNSUPPORTED'});
});

test('without SIMD: one sentence', {skip: process.arch !== 'x64'}, () => {
  // For an error that is not caught, node prints 300 kB of the package, which may be cut.
  const script = `import('starfocus').then(({createRefocuser}) => createRefocuser(${JSON.stringify(options)}))
                      .catch(error => console.log(error.message))`;
  assert.match(String(execFileSync(process.execPath, ['--no-enable-sse4-1', '-e', script])), /WebAssembly has no SIMD here/);
});
