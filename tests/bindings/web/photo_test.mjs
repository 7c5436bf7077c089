// SPDX-License-Identifier: Apache-2.0
// Tests openPhoto of the installed package in node, where pictures are pixels in memory. page_test.mjs tests files,
// images and canvases.

import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {getEventListeners} from 'node:events';
import {writeFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {join} from 'node:path';
import test, {after, before} from 'node:test';
import {openPhoto, StarfocusError} from 'starfocus';

import {assertSameBytes, dropAlpha, readLightField, readPng} from './pictures.mjs';

const program = process.env.STARFOCUS_PROGRAM, folder = process.env.STARFOCUS_FIELD;
const field = readLightField(folder), {width, height, low, high} = field, [image] = field.views;
const codes = Uint8Array.from(field.disparity.data, d => Math.round(255 * (d - low) / (high - low)));
const depth = {data: codes, width, height};
let photo;

/** Writes a PGM depth picture next to a copy of the centre view, and refocuses the pair with the program. */
function refocusByProgram({data, width: columns, height: rows}, ...values) {
  const picture = join(folder, 'pair.ppm'), map = join(folder, 'pair-depth.pgm'), out = join(folder, 'pair-out.png');
  writeFileSync(picture, Buffer.concat([Buffer.from(`P6 ${width} ${height} 255\n`), image.data]));
  writeFileSync(map, Buffer.concat([Buffer.from(`P5 ${columns} ${rows} 255\n`), data]));
  execFileSync(program, ['refocus', picture, '-o', out, ...values], {stdio: 'pipe'});
  return readPng(out).data;
}

before(async () => photo = await openPhoto(image, depth, {threads: 2}));
after(() => photo.close());

test('a photo has a size, a range of focus and the guessed near end', () => {
  assert.deepEqual([photo.width, photo.height, photo.threads, photo.near], [width, height, 2, 'bright']);
  assert.deepEqual([photo.focusMin, Math.round(photo.focusMax * 1000)], [0, 7704]);
  assert.match(photo.version, /^\d+\.\d+\.\d+$/);
});

test('a tap gives the picture of the program, with the depth repaired', async () => {
  for (const [x, y] of [[width >> 2, height >> 1], [width - 9.5, 5.25]]) {
    const picture = await photo.refocus({focus: await photo.focusAt({x, y})});
    assert.deepEqual([picture.width, picture.height, picture.shift], [width, height, 0]);
    assertSameBytes(dropAlpha(picture.data),
                    refocusByProgram(depth, '--focus-at', `${Math.floor(x)},${Math.floor(y)}`, '--f-stop', '1.8'));
  }
});

test('depth of half the size gives the picture of the program', async () => {
  const data = Uint8Array.from({length: codes.length / 4}, (_, i) => codes[4 * i - 2 * (i % (width >> 1)) ]);
  const half = {data, width: width >> 1, height: height >> 1};
  await withPhoto(await openPhoto(image, half, {threads: 2}), async opened => {
    const picture = await opened.refocus({focus: await opened.focusAt({x: 100, y: 120})});
    assertSameBytes(dropAlpha(picture.data), refocusByProgram(half, '--focus-at', '100,120', '--f-stop', '1.8'));
  });
});

test('inverted depth gives the same picture, and near: bright inverts it', async () => {
  const inverted = {...depth, data: codes.map(code => 255 - code)};
  const expected = await photo.refocus({focus: 3});
  for (const options of [{}, {near: 'dark'}]) {
    await withPhoto(await openPhoto(image, inverted, {...options, threads: 1}), async dark => {
      assert.equal(dark.near, 'dark');
      assertSameBytes((await dark.refocus({focus: 3})).data, expected.data);
    });
  }
});

/** Calls a function with a photo, and closes the photo. */
async function withPhoto(opened, call) {
  try {
    await call(opened);
  } finally {
    opened.close();
  }
}

test('f-stops, highlights and shapes change the picture', async () => {
  const open = await photo.refocus({focus: 3}), stopped = await photo.refocus({focus: 3, fStop: 2});
  const half = await photo.refocus({focus: 3, aperture: 0.5});
  assertSameBytes(stopped.data, half.data);
  assert.notDeepEqual(open.data, stopped.data);
  for (const lens of [{highlights: 8}, {shape: 2, blades: 6}]) {
    assert.notDeepEqual((await photo.refocus({focus: 3, ...lens})).data, open.data);
  }
  assertSameBytes((await photo.refocus({focus: 3})).data, open.data);
});

test('each picture has its own highlights, and undefined fields count as omitted', async () => {
  const plain = await photo.refocus({focus: 3}), bright = photo.refocus({focus: 3, highlights: 8});
  bright.catch(() => {});
  assertSameBytes((await photo.refocus({focus: 3})).data, plain.data);
  const paused = photo.refocus({focus: 3})[Symbol.asyncIterator]();
  await paused.next();
  const expected = await photo.refocus({focus: 3, highlights: 8}), newer = photo.refocus({focus: 3, highlights: 8});
  const [, last] = await Promise.all([paused.next(), newer]);
  assertSameBytes(last.data, expected.data);
  const stopped = await photo.refocus({focus: 3, fStop: 4});
  assertSameBytes((await photo.refocus({focus: 3, fStop: 4, aperture: undefined})).data, stopped.data);
});

test('a signal that is used for many requests keeps no listeners', async () => {
  const {signal} = new AbortController();
  for (let i = 0; i < 3; ++i) {
    await photo.refocus({focus: 3}, {signal});
    for await (const picture of photo.refocus({focus: 3}, {signal})) assert.ok(picture.width > 0);
  }
  assert.equal(getEventListeners(signal, 'abort').length, 0);
});

test('an iteration yields a preview and the full picture', async () => {
  const shifts = [];
  for await (const picture of photo.refocus({focus: 2, blocks: true})) {
    shifts.push(picture.shift);
    assert.equal(picture.width, Math.ceil(width / 2 ** picture.shift));
    assert.equal(picture.blocks !== undefined, picture.shift === 0);
  }
  assert.equal(shifts.length, 2);
  assert.ok(shifts[0] >= 1 && shifts[1] === 0);
});

test('a newer request ends an older iteration and rejects an older promise', async () => {
  const seen = [];
  const older = (async () => {
    for await (const picture of photo.refocus({focus: 1})) seen.push(picture.shift);
  })();
  const promise = photo.refocus({focus: 2});
  const rejected = assert.rejects(Promise.resolve(promise), {name: 'AbortError'});
  const newest = await photo.refocus({focus: 3});
  await Promise.all([older, rejected]);
  assert.ok(!seen.includes(0));
  assert.equal(newest.width, width);
});

test('a signal aborts refocus and openPhoto', async () => {
  await assert.rejects(Promise.resolve(photo.refocus({focus: 1}, {signal: AbortSignal.abort()})), {name: 'AbortError'});
  await assert.rejects(async () => {
    for await (const picture of photo.refocus({focus: 1}, {signal: AbortSignal.abort()})) assert.fail(picture.width);
  }, {name: 'AbortError'});
  for (const delay of [0, 10, 20, 40, 60, 80, 100]) {
    const stop = new AbortController(), opening = openPhoto(image, depth, {signal: stop.signal, threads: 2});
    setTimeout(() => stop.abort(), delay);
    await assert.rejects(opening, {name: 'AbortError'});
  }
});

test('a light field of five views gives the picture of the program', async () => {
  const disparities = {...field.disparity};
  await withPhoto(await openPhoto(field.views, disparities, {disparity: true, threads: 2}), async opened => {
    assert.deepEqual([opened.focusMin, opened.focusMax], [low, high].map(Math.fround));
    const out = join(folder, 'field-out.png');
    execFileSync(program, ['refocus', folder, '-o', out, '--focus', '2']);
    assertSameBytes(dropAlpha((await opened.refocus({focus: 2})).data), readPng(out).data);
    assertSameBytes((await opened.disparity()).data, field.disparity.data);
  });
});

test('the focus of either end is valid', async () => {
  for (const focus of [photo.focusMin, photo.focusMax]) assert.equal((await photo.refocus({focus})).width, width);
});

test('wrong arguments are rejected with a code', async () => {
  const wrong = [
    [() => openPhoto(), 'ARGUMENT', /^image: expected a Blob, ImageData/],
    [() => openPhoto(image, depth, {near: 'white'}), 'ARGUMENT', /^near: expected 'bright' or 'dark', found 'white'/],
    [() => openPhoto(image, depth, {blur: 0}), 'RANGE', /^blur: expected more than 0/],
    [() => openPhoto(image, depth, {nonsense: 1}), 'ARGUMENT', /'nonsense'/],
    [() => openPhoto(image, {...depth, data: codes.subarray(1)}), 'RANGE', /^depth.data: expected 320 x 240 x 1 or 3 or 4 values, found 76799/],
    [() => openPhoto(image, {data: codes.map(() => 7), width, height}), 'NOT_FINITE', /all values are equal/],
    [() => openPhoto({...image, data: image.data.subarray(5)}, depth), 'RANGE', /^image.data: expected/],
    [() => openPhoto([image, image], depth), 'RANGE', /^image: expected one picture, or 5, 9 or 17 views, found 2/],
    [() => openPhoto(new Blob(['text']), depth), 'UNSUPPORTED', /^image: picture files cannot be decoded here/],
    [() => openPhoto({...image, data: image.data.subarray(0, width * height)}, depth), 'RANGE', /^image.data: expected/],
    [() => openPhoto({...image, data: new Uint16Array(3 * width * height)}, depth), 'ARGUMENT', /^image.data: .*Uint16Array/],
    [() => openPhoto(image, {data: new Float64Array(9), width: 3, height: 3}), 'ARGUMENT', /^depth.data: .*Float64Array/],
    [() => openPhoto(image, {data: new Float32Array(27), width: 3, height: 3}), 'RANGE', /^depth.data: expected 3 x 3 x 1 /],
    [() => openPhoto(field.views, depth), 'RANGE', /^disparity: expected true for several views/],
    [() => openPhoto([{data: new Uint8Array(4 * width * height), width, height}, ...field.views.slice(1)],
                     field.disparity, {disparity: true}), 'RANGE', /^image\[1\]: expected 4 bytes per pixel/],
    [() => openPhoto(image, {...field.disparity, data: field.disparity.data.map(() => NaN)}, {disparity: true}),
     'NOT_FINITE', /^depth: expected a map with finite disparities/],
    [() => photo.refocus({}), 'ARGUMENT', /a value of focus/],
    [() => photo.refocus({focus: 1000}), 'RANGE', /^focus: expected 0 to 7\.7.*, found 1000/],
    [() => photo.refocus({focus: 1, highlights: 0}), 'RANGE', /^highlights: expected 1 to 64, found 0/],
    [() => photo.refocus({focus: 1, fStop: 0.5}), 'RANGE', /^fStop: expected at least 1, found 0.5/],
    [() => photo.focusAt({x: NaN, y: 0}), 'RANGE', /^x: expected a number, found NaN/]
  ];
  for (const [call, code, message] of wrong) {
    await assert.rejects(async () => call(), error => {
      assert.ok(error instanceof StarfocusError, `${call}: ${error.stack}`);
      assert.equal(error.code, code, `${call}: ${error.message}`);
      assert.match(error.message, message);
      return true;
    }, String(call));
  }
});

test('the CommonJS module gives the same pictures and errors', async () => {
  const common = createRequire(import.meta.url)('starfocus');
  await withPhoto(await common.openPhoto(image, depth, {threads: 1}), async opened => {
    assertSameBytes((await opened.refocus({focus: 3})).data, (await photo.refocus({focus: 3})).data);
  });
  await assert.rejects(common.openPhoto(), error => error instanceof common.StarfocusError && error instanceof StarfocusError);
});
