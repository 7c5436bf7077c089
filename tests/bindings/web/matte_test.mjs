// SPDX-License-Identifier: Apache-2.0
// Tests openPhoto of the installed package with mattes in node: the pictures of the program, kinds of mattes, options,
// and errors.

import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {writeFileSync} from 'node:fs';
import {join} from 'node:path';
import test from 'node:test';
import {openPhoto, StarfocusError} from 'starfocus';

import {assertSameBytes, dropAlpha, readLightField, readPng} from './pictures.mjs';

const program = process.env.STARFOCUS_PROGRAM, folder = process.env.STARFOCUS_FIELD;
const {views: [image], width, height, disparity} = readLightField(folder);

/** Returns a soft matte of the person, whose disparity is the largest: a mean of 5 x 5 pixels. */
function makeAlpha(across, down) {
  return Uint8Array.from({length: across * down}, (_, i) => {
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
}

const matte = {data: makeAlpha(width, height), width, height};

/** Writes a grey picture with the name `name`.pgm. Returns its path. */
function writeGrey(name, {data, width: across, height: down}) {
  const path = join(folder, `${name}.pgm`);
  writeFileSync(path, Buffer.concat([Buffer.from(`P5 ${across} ${down} 255\n`), data]));
  return path;
}

/** Refocuses the photo with the program, which reads the matte from a PGM. */
function refocusByProgram(given, ...values) {
  const picture = join(folder, 'matted.ppm'), out = join(folder, 'matted-out.png');
  writeFileSync(picture, Buffer.concat([Buffer.from(`P6 ${width} ${height} 255\n`), image.data]));
  execFileSync(program, ['refocus', picture, '--matte', writeGrey('alpha', given), '-o', out, ...values], {stdio: 'pipe'});
  return readPng(out).data;
}

/** Opens the photo with a matte, calls a function, and closes the photo. */
async function withPhoto(options, call, depth) {
  const photo = depth ? await openPhoto(image, depth, {threads: 1, ...options}) : await openPhoto(image, {threads: 1, ...options});
  try {
    return await call(photo);
  } finally {
    photo.close();
  }
}

/** Returns the pixels of the photo with a matte, focused on the subject. */
const refocused = options => withPhoto(
    options, async photo => (await photo.refocus({focus: photo.subjectFocus})).data);

test('a matte gives two surfaces, and the pictures of the program', () => withPhoto({matte, threads: 2}, async photo => {
  assert.deepEqual([photo.focusMin, photo.focusMax, photo.subjectFocus, photo.near], [0, 7.703125, 7.703125, 'bright']);
  assert.equal(await photo.focusAt({x: 132, y: 129}), photo.subjectFocus);
  assert.equal(await photo.focusAt({x: width - 9, y: 5}), 0);
  for (const [focus, values] of [[photo.subjectFocus, []], [0, ['--focus', '0']]]) {
    assertSameBytes(dropAlpha((await photo.refocus({focus})).data), refocusByProgram(matte, ...values));
  }
}));

test('a floor and mattes of other sizes give the pictures of the program', async () => {
  for (const [across, down, floor] of [[64, 48, true], [80, 61, false], [900, 675, true], [128, 128, false]]) {
    const other = {data: makeAlpha(across, down), width: across, height: down};
    assertSameBytes(dropAlpha(await refocused({matte: other, floor})), refocusByProgram(other, ...(floor ? ['--floor'] : [])));
  }
});

test('with depth, the matte changes the outlines as in the program', async () => {
  // The edges of the map are 4 pixels beside the edges of the picture.
  const data = Uint8Array.from({length: width * height}, (_, i) => 100 + 8 * disparity.data[Math.max(0, i - 4)]);
  const depth = {data, width, height}, file = writeGrey('beside', depth);
  const plain = await withPhoto({}, async photo => (await photo.refocus({focus: photo.focusMax})).data, depth);
  await withPhoto({matte}, async photo => {
    const {data: found} = await photo.refocus({focus: photo.subjectFocus});
    assertSameBytes(dropAlpha(found), refocusByProgram(matte, '--depth', file, '--near', 'white'));
    assert.notDeepEqual((await photo.refocus({focus: photo.focusMax})).data, plain);
  }, depth);
  await withPhoto({matte, repair: false}, async photo => assertSameBytes(
      dropAlpha((await photo.refocus({focus: photo.subjectFocus})).data),
      refocusByProgram(matte, '--depth', file, '--near', 'white', '--no-repair')), depth);
});

test('soft and small subjects are in focus, as in the program', async () => {
  const soft = {...matte, data: matte.data.map(alpha => 0.7 * alpha)};  // at most 178
  // One pixel, between the samples of a regular grid.
  const large = {data: new Uint8Array(1280 * 960), width: 1280, height: 960}, [x, y] = [4 * 132, 4 * 129];
  large.data[y * large.width + x] = 255;
  const data = Uint8Array.from(disparity.data, value => 100 + 8 * value), depth = {data, width, height};
  const file = writeGrey('soft-depth', depth);
  for (const given of [soft, large]) {
    await withPhoto({matte: given}, async photo => assert.equal(photo.subjectFocus, photo.focusMax));
    await withPhoto({matte: given}, async photo => assertSameBytes(
        dropAlpha((await photo.refocus({focus: photo.subjectFocus})).data),
        refocusByProgram(given, '--depth', file, '--near', 'white')), depth);
  }
});

test('each kind of matte gives the same picture', async () => {
  const {data} = matte, expected = await refocused({matte});
  const pixels = (channels, value) => Uint8Array.from({length: channels * data.length}, (_, i) => value(data[Math.trunc(i / channels)], i % channels));
  const kinds = {
    'grey R, G, B': pixels(3, alpha => alpha), 'opaque grey': pixels(4, (alpha, channel) => channel < 3 ? alpha : 255),
    'a cut-out': pixels(4, (alpha, channel) => channel < 3 ? 50 * channel : alpha),
    'floats': Float32Array.from(data, alpha => alpha / 255), 'floats beside 0 and 1': Float32Array.from(data, alpha => 1.0002 * alpha / 255 - 0.0001), '16 bits': Uint16Array.from(data, alpha => 257 * alpha)
  };
  await Promise.all(Object.entries(kinds).map(
      async ([kind, data]) => assert.deepEqual(await refocused({matte: {...matte, data}}), expected, kind)));
});

test('wrong mattes and options are one line each', async () => {
  const wrong = [
    [{matte: {...matte, data: matte.data.map(() => 127)}}, 'RANGE', /^matte: expected a matte with a subject, found an empty matte\.$/],
    [{matte: {...matte, data: matte.data.map(() => 128)}}, 'RANGE', /^matte: expected a matte with a background, found a matte that is full everywhere\.$/],
    [{matte: {data: makeAlpha(100, 50), width: 100, height: 50}}, 'RANGE', /^matte: expected the proportions of the picture, 320 x 240, found '100 x 50'\.$/],
    [{matte: image}, 'RANGE', /^matte: expected alpha or grey levels, found colours\.$/],
    [{matte: {...matte, data: Float32Array.from(matte.data)}}, 'RANGE', /^matte\.data: expected values from 0 to 1, found \d+\.$/],
    [{matte: {...matte, data: matte.data.subarray(1)}}, 'RANGE', /^matte\.data: expected 320 x 240 x 1 or 3 or 4 values, found 76799\.$/],
    [{matte: 7}, 'ARGUMENT', /^matte: expected a Blob/],
    [{matte, near: 'dark'}, 'ARGUMENT', /^near: expected no value for a photo without depth, found 'dark'\.$/],
    [{matte, repair: true}, 'ARGUMENT', /^repair: expected no value/],
    [{matte, floor: true}, 'ARGUMENT', /^floor: expected false for a photo with depth, found true\.$/, disparity]
  ];
  await assert.rejects(openPhoto(Array(5).fill(image), {matte}), /^StarfocusError: depth: expected a map for several views/);
  for (const [options, code, message, depth] of wrong) {
    await assert.rejects(withPhoto(options, () => {}, depth), error => {
      assert.ok(error instanceof StarfocusError, error.stack);
      assert.equal(error.code, code, error.message);
      assert.match(error.message, message);
      return true;
    });
  }
});
