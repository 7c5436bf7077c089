// SPDX-License-Identifier: Apache-2.0
// Tests openPhoto of the installed package in node, where pictures are pixels in memory: pictures with depth or a matte,
// requests, errors, and the range of depth maps. page_test.mjs tests files, images and canvases.

import assert from 'node:assert/strict';
import {getEventListeners} from 'node:events';
import {readFileSync, writeFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {dirname, join} from 'node:path';
import test, {after, before} from 'node:test';
import {openPhoto, StarfocusError} from 'starfocus';

import {assertSameBytes, dropAlpha, folder, readLightField, refocusByProgram} from './pictures.mjs';

const field = readLightField(), {width, height, low, high, disparity} = field, [image] = field.views;
const codes = Uint8Array.from(disparity.data, d => Math.round(255 * (d - low) / (high - low)));
const depth = {data: codes, width, height};
let photo;

/** Writes a grey picture. Returns its path. */
function writeGrey(name, {data, width: across, height: down}) {
  const path = join(folder, `${name}.pgm`);
  writeFileSync(path, Buffer.concat([Buffer.from(`P5 ${across} ${down} 255\n`), data]));
  return path;
}

/** Refocuses the photo with the program, which reads depth and matte from files. */
function photoByProgram({depth, matte}, ...values) {
  const picture = join(folder, 'photo.ppm');
  writeFileSync(picture, Buffer.concat([Buffer.from(`P6 ${width} ${height} 255\n`), image.data]));
  return refocusByProgram(picture, ...depth ? ['--depth', writeGrey('photo-map', depth)] : [],
                          ...matte ? ['--matte', writeGrey('photo-alpha', matte)] : [], ...values);
}

/** Opens the photo with these options, with depth or without, calls a function, and closes the photo. */
async function withPhoto({depth, ...options}, call) {
  const opened = await openPhoto(image, ...depth ? [depth] : [], {threads: 1, ...options});
  try {
    return await call(opened);
  } finally {
    opened.close();
  }
}

/** Returns the R, G, B bytes of a photo that is focused on its subject. */
const focusedOnSubject = async opened => dropAlpha((await opened.refocus({focus: opened.subjectFocus})).data);

before(async () => photo = await openPhoto(image, depth, {threads: 2}));
after(() => photo.close());

test('a photo has a size, a range of focus and the guessed near end', async () => {
  assert.deepEqual([photo.width, photo.height, photo.threads, photo.near], [width, height, 2, 'bright']);
  assert.deepEqual([photo.focusMin, Math.round(photo.focusMax * 1000)], [0, 7704]);
  assert.match(photo.version, /^\d+\.\d+\.\d+$/);
  for (const focus of [photo.focusMin, photo.focusMax]) assert.equal((await photo.refocus({focus})).width, width);
});

test('a tap gives the picture of the program, with depth of any size repaired', async () => {
  const data = Uint8Array.from({length: codes.length / 4}, (_, i) => codes[4 * i - 2 * (i % (width >> 1))]);
  const half = {data, width: width >> 1, height: height >> 1};
  for (const [map, x, y] of [[depth, width >> 2, height >> 1], [depth, width - 9.5, 5.25], [half, 100, 120]]) {
    await withPhoto({depth: map, threads: 2}, async opened => {
      const picture = await opened.refocus({focus: await opened.focusAt({x, y})});
      assert.deepEqual([picture.width, picture.height, picture.shift], [width, height, 0]);
      assertSameBytes(dropAlpha(picture.data), photoByProgram(
          {depth: map}, '--focus-at', `${Math.floor(x)},${Math.floor(y)}`, '--f-stop', '1.8'));
    });
  }
});

test('inverted depth gives the same picture, and near: bright inverts it', async () => {
  const inverted = {...depth, data: codes.map(code => 255 - code)}, expected = await photo.refocus({focus: 3});
  for (const options of [{}, {near: 'dark'}]) {
    await withPhoto({depth: inverted, ...options}, async dark => {
      assert.equal(dark.near, 'dark');
      assertSameBytes((await dark.refocus({focus: 3})).data, expected.data);
    });
  }
});

test('f-stops, highlights and shapes change the picture', async () => {
  const open = await photo.refocus({focus: 3}), stopped = await photo.refocus({focus: 3, fStop: 2});
  assertSameBytes(stopped.data, (await photo.refocus({focus: 3, aperture: 0.5})).data);
  for (const lens of [{fStop: 2}, {highlights: 8}, {shape: 2, blades: 6}]) {
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

test('an iteration yields a preview and the full picture, and leaves no listeners at its signal', async () => {
  const {signal} = new AbortController();
  for (let i = 0; i < 3; ++i) {
    await photo.refocus({focus: 3}, {signal});
    const shifts = [];
    for await (const picture of photo.refocus({focus: 2, blocks: true}, {signal})) {
      shifts.push(picture.shift);
      assert.equal(picture.width, Math.ceil(width / 2 ** picture.shift));
      assert.equal(picture.blocks !== undefined, picture.shift === 0);
    }
    assert.equal(shifts.length, 2);
    assert.ok(shifts[0] >= 1 && shifts[1] === 0);
  }
  assert.equal(getEventListeners(signal, 'abort').length, 0);
});

test('a newer request ends an older iteration and rejects an older promise', async () => {
  const seen = [];
  const older = (async () => {
    for await (const picture of photo.refocus({focus: 1})) seen.push(picture.shift);
  })();
  const rejected = assert.rejects(Promise.resolve(photo.refocus({focus: 2})), {name: 'AbortError'});
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
  const opened = await openPhoto(field.views, {...disparity}, {disparity: true, threads: 2});
  assert.deepEqual([opened.focusMin, opened.focusMax], [low, high].map(Math.fround));
  assertSameBytes(dropAlpha((await opened.refocus({focus: 2})).data), refocusByProgram(folder, '--focus', '2'));
  assertSameBytes((await opened.disparity()).data, disparity.data);
  opened.close();
});

/** Returns a soft matte of the person, whose disparity is the largest: a mean of 5 x 5 pixels. */
function makeMatte(across, down) {
  const data = Uint8Array.from({length: across * down}, (_, i) => {
    const x = Math.trunc((i % across + 0.5) * width / across), y = Math.trunc((Math.trunc(i / across) + 0.5) * height / down);
    let count = 0;
    for (let v = -2; v <= 2; ++v) {
      for (let u = -2; u <= 2; ++u) {
        const column = Math.min(Math.max(x + u, 0), width - 1), row = Math.min(Math.max(y + v, 0), height - 1);
        count += disparity.data[row * width + column] > 1.5;
      }
    }
    return Math.round(255 * count / 25);
  });
  return {data, width: across, height: down};
}

const matte = makeMatte(width, height);

test('a matte gives two surfaces, and the pictures of the program', () => withPhoto({matte, threads: 2}, async opened => {
  assert.deepEqual([opened.focusMin, opened.focusMax, opened.subjectFocus, opened.near], [0, 7.703125, 7.703125, 'bright']);
  assert.equal(await opened.focusAt({x: 132, y: 129}), opened.subjectFocus);
  assert.equal(await opened.focusAt({x: width - 9, y: 5}), 0);
  assertSameBytes(await focusedOnSubject(opened), photoByProgram({matte}));
  assertSameBytes(dropAlpha((await opened.refocus({focus: 0})).data), photoByProgram({matte}, '--focus', '0'));
}));

test('a floor and mattes of other sizes give the pictures of the program', async () => {
  for (const [across, down, floor] of [[64, 48, true], [80, 61, false], [900, 675, true], [128, 128, false]]) {
    const other = makeMatte(across, down);
    assertSameBytes(await withPhoto({matte: other, floor}, focusedOnSubject),
                    photoByProgram({matte: other}, ...floor ? ['--floor'] : []));
  }
});

test('with depth, mattes of any softness and size change the outlines as in the program', async () => {
  const level = d => 100 + 8 * d;
  const plain = {data: Uint8Array.from(disparity.data, level), width, height};
  // The edges of this map are 4 pixels beside the edges of the picture.
  const beside = {...plain, data: plain.data.map((_, i) => level(disparity.data[Math.max(0, i - 4)]))};
  const soft = {...matte, data: matte.data.map(alpha => 0.7 * alpha)};  // at most 178
  const dot = {data: new Uint8Array(1280 * 960), width: 1280, height: 960};
  dot.data[4 * 129 * dot.width + 4 * 132] = 255;  // one pixel, between the samples of a regular grid
  for (const [alpha, map, options, values] of [[matte, beside, {}, []], [matte, beside, {repair: false}, ['--no-repair']],
                                               [soft, plain, {}, []], [dot, plain, {}, []]]) {
    assertSameBytes(await withPhoto({matte: alpha, depth: map, ...options}, focusedOnSubject),
                    photoByProgram({matte: alpha, depth: map}, '--near', 'white', ...values));
  }
  for (const alpha of [soft, dot]) {
    await withPhoto({matte: alpha}, async opened => assert.equal(opened.subjectFocus, opened.focusMax));
  }
});

test('each kind of matte gives the same picture', async () => {
  const {data} = matte, expected = await withPhoto({matte}, focusedOnSubject);
  const pixels = (channels, value) => Uint8Array.from({length: channels * data.length}, (_, i) => value(data[Math.trunc(i / channels)], i % channels));
  const kinds = {
    'grey R, G, B': pixels(3, alpha => alpha), 'opaque grey': pixels(4, (alpha, channel) => channel < 3 ? alpha : 255),
    'a cut-out': pixels(4, (alpha, channel) => channel < 3 ? 50 * channel : alpha),
    'floats': Float32Array.from(data, alpha => alpha / 255), '16 bits': Uint16Array.from(data, alpha => 257 * alpha),
    'floats beside 0 and 1': Float32Array.from(data, alpha => 1.0002 * alpha / 255 - 0.0001)
  };
  for (const [kind, data] of Object.entries(kinds)) {
    assert.deepEqual(await withPhoto({matte: {...matte, data}}, focusedOnSubject), expected, kind);
  }
});

test('wrong arguments are rejected with a code, in one line', async () => {
  const open = (data, options) => () => openPhoto(image, data, options), pixels = (data, more) => ({...image, data, ...more});
  const alpha = (data, more) => () => openPhoto(image, {matte: {...matte, data, ...more}});
  const wrong = [
    [() => openPhoto(), 'ARGUMENT', /^image: expected a Blob, ImageData/],
    [open(depth, {near: 'white'}), 'ARGUMENT', /^near: expected 'bright' or 'dark', found 'white'/],
    [open(depth, {nonsense: 1}), 'ARGUMENT', /'nonsense'/],
    [open({...depth, data: codes.subarray(1)}), 'RANGE', /^depth.data: expected 320 x 240 x 1 or 3 or 4 values, found 76799/],
    [open({...depth, data: codes.map(() => 7)}), 'NOT_FINITE', /all values are equal/],
    [open({...disparity, data: disparity.data.map(() => NaN)}, {disparity: true}), 'NOT_FINITE', /^depth: expected a map with finite disparities/],
    [() => openPhoto(pixels(image.data.subarray(0, width * height)), depth), 'RANGE', /^image.data: expected/],
    [() => openPhoto(pixels(new Uint16Array(3 * width * height)), depth), 'ARGUMENT', /^image.data: .*Uint16Array/],
    [() => openPhoto([image, image], depth), 'RANGE', /^image: expected one picture, or 5, 9 or 17 views, found 2/],
    [() => openPhoto(field.views, depth), 'RANGE', /^disparity: expected true for several views/],
    [() => openPhoto([pixels(new Uint8Array(4 * width * height)), ...field.views.slice(1)], disparity, {disparity: true}), 'RANGE',
     /^image\[1\]: expected 4 bytes per pixel/],
    [() => openPhoto(new Blob(['text']), depth), 'UNSUPPORTED', /^image: picture files cannot be decoded here/],
    [() => photo.refocus({}), 'ARGUMENT', /a value of focus/],
    [() => photo.refocus({focus: 1000}), 'RANGE', /^focus: expected 0 to 7\.7.*, found 1000/],
    [() => photo.refocus({focus: 1, highlights: 0}), 'RANGE', /^highlights: expected 1 to 64, found 0/],
    [alpha(matte.data.map(() => 127)), 'RANGE', /^matte: expected a matte with a subject, found an empty matte\.$/],
    [alpha(matte.data.map(() => 128)), 'RANGE', /^matte: expected a matte with a background, found a matte that is full everywhere\.$/],
    [alpha(makeMatte(100, 50).data, {width: 100, height: 50}), 'RANGE', /^matte: expected the proportions of the picture, 320 x 240, found '100 x 50'\.$/],
    [alpha(image.data), 'RANGE', /^matte: expected alpha or grey levels, found colours\.$/],
    [alpha(Float32Array.from(matte.data)), 'RANGE', /^matte\.data: expected values from 0 to 1, found \d+\.$/],
    [() => openPhoto(image, {matte: 7}), 'ARGUMENT', /^matte: expected a Blob/],
    [() => openPhoto(image, {matte, near: 'dark'}), 'ARGUMENT', /^near: expected no value for a photo without depth, found 'dark'\.$/],
    [open(disparity, {matte, floor: true}), 'ARGUMENT', /^floor: expected false for a photo with depth, found true\.$/],
    [() => openPhoto(Array(5).fill(image), {matte}), 'ARGUMENT', /^depth: expected a map for several views/]
  ];
  for (const [call, code, message] of wrong) {
    await assert.rejects(async () => call(), error => {
      assert.ok(error instanceof StarfocusError, `${message}: ${error.stack}`);
      assert.equal(error.code, code, `${message}: ${error.message}`);
      assert.match(error.message, message);
      return true;
    }, String(message));
  }
});

test('the CommonJS module gives the same pictures and errors', async () => {
  const common = createRequire(import.meta.url)('starfocus'), opened = await common.openPhoto(image, depth, {threads: 1});
  assertSameBytes((await opened.refocus({focus: 3})).data, (await photo.refocus({focus: 3})).data);
  opened.close();
  await assert.rejects(common.openPhoto(), error => error instanceof common.StarfocusError && error instanceof StarfocusError);
});

const path = join(dirname(process.env.STARFOCUS_SERVER), '../../platform/web/worker/depth.js');
const {measureRobustly, writeDisparities} = await import(`data:text/javascript,${encodeURIComponent(readFileSync(path, 'utf8'))}`);

test('the range of a depth map are the quantiles of 0.1 % and 99.9 % of its finite values, as by sorting', () => {
  const tiny = 2 ** -149, largest = 3.4028234663852886e38;
  const waves = [1, 1e-3, 1e30].flatMap(scale => {
    const wave = Float32Array.from({length: 5003}, (_, i) => i % 11 ? scale * Math.tan(i * i) : NaN);
    return [wave, wave.map(value => value + 1000 * scale), wave.map(value => value - 1000 * scale), wave.subarray(1, 1003)];
  });
  const squares = Uint16Array.from({length: 6000}, (_, i) => i * i % 65536);
  for (const [data, channels = 1] of [
    [Float32Array.of(0)], [Float32Array.of(-0, 0)], [Float32Array.of(0, -0, NaN)], [Float32Array.of(-2, -1)],
    [Float32Array.of(-tiny, tiny, -Infinity, Infinity, NaN, -NaN)], [Float32Array.of(largest, -largest, Infinity, -Infinity)],
    [Float32Array.of(NaN, 7, 7.000001)], ...waves.map(wave => [wave]), [squares], [squares, 3], [Uint8Array.from(squares), 4],
    [Uint8Array.of(255)]
  ]) {
    const values = data.filter((value, i) => i % channels === 0 && Number.isFinite(value)).sort();
    const beyond = Math.trunc((values.length - 1) / 1000);
    // deepStrictEqual distinguishes the zeros.
    assert.deepStrictEqual(measureRobustly({data, channels}), {low: values[beyond], high: values[values.length - 1 - beyond]});
  }
  const {low, high} = measureRobustly({data: Float32Array.of(NaN, Infinity, -Infinity), channels: 1});
  assert.ok(low > high, 'a map without finite values has no range');
});

test('values of DEPTH16 are distances below any confidence, and 0 is unknown', () => {
  for (let confidence = 0; confidence < 8; ++confidence) {
    const data = Uint16Array.of(...[0, 1, 500, 8191].map(distance => distance + 8192 * confidence));
    const disparities = new Float32Array(4);
    writeDisparities({data, scale: 1000, reciprocal: true, depth16: true}, disparities);
    assert.deepStrictEqual(disparities, Float32Array.of(NaN, 1000, 2, 1000 / 8191));
  }
});
