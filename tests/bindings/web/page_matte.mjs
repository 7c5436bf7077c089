// SPDX-License-Identifier: Apache-2.0
// Tests photos with a matte and photos without depth, in which the page finds the person. page_test.mjs imports these
// tests.

import assert from 'node:assert/strict';
import {existsSync, readdirSync, readFileSync, statSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import test from 'node:test';
import sharp from 'sharp';

import {makeDynamicDepth, markApple} from './gdepth_photo.mjs';
import {
  andFull, andWait, choose, driver, error, file, focusText, full, openFiles, place, screenshot, shown, shownDepth,
  site, sources, tap, visit, waitFor, without
} from './page_driver.mjs';
import {assertSameBytes, folder as small, readLightField, refocusByProgram} from './pictures.mjs';

const segmenter = join(site, 'segmenter');
const noDecoder = !existsSync(join(site, 'heic'));
const noSegmenter = !existsSync(segmenter) && 'the site has no segmenter';
const {width, height, disparity} = readLightField();
const F_STOP = ['--f-stop', String(2 ** 0.85)];  // of the slider, which has steps
const photo = (name = 'photo.png') => file(name, file('view_+0.0_+0.0.png').buffer);

/** Returns a PNG of the person's matte with 1 to 4 channels. */
function makeMatte(channels, alphaOf = alpha => alpha) {
  const data = Uint8Array.from({length: channels * width * height}, (_, i) => {
    const alpha = disparity.data[Math.trunc(i / channels)] > 1.5 ? 255 : 0;
    return channels === 4 && i % 4 < 3 ? 40 * (i % 4) : alphaOf(alpha);
  });
  return sharp(data, {raw: {width, height, channels}}).png();
}

/** Opens files with a photo and a matte, which is focused at once. Returns the pixels of the canvas. */
async function openMatted(...files) {
  await andFull(() => openFiles(...files));
  assert.ok(await driver.page.isHidden('#offer'));
  return shown();
}

test('opens a picture with its matte, focused on the subject, as the program does', async () => {
  const grey = await makeMatte(1).toBuffer(), path = join(small, 'photo-matte.png'), centre = join(small, 'view_+0.0_+0.0.png');
  writeFileSync(path, grey);
  const near = await openMatted(photo(), file('photo-matte.png', grey));
  assertSameBytes(near, refocusByProgram(centre, '--matte', path, ...F_STOP));
  assert.equal(await focusText(), 'nearest');
  assert.ok(await driver.page.isDisabled('#swap'));
  await tap(width - 9, 5);
  assert.equal(await focusText(), 'farthest');
  assertSameBytes(await shown(), refocusByProgram(centre, '--matte', path, '--focus-at', `${width - 9},5`, ...F_STOP));
  for (const files of [[file('cut-out.png', await makeMatte(4).toBuffer()), photo()], [photo('mask.png'), file('mask-alpha.png', await makeMatte(4).toBuffer())],
                       [photo('no-depth.png'), file('no-depth-matte.png', grey)], [file('matte.png', grey), photo('display.png')],
                       [photo('a.png'), file('alpha.png', grey)]]) {
    assertSameBytes(await openMatted(...files), near);
  }
});

test('a matte turns with its photo', async () => {
  const upright = await sharp(photo().buffer).rotate(90).png().toBuffer();
  const turned = await sharp(photo().buffer).withMetadata({orientation: 6}).jpeg({quality: 100, chromaSubsampling: '4:4:4'}).toBuffer();
  const matte = await makeMatte(4).toBuffer(), pixels = [];
  for (const kind of [matte, await sharp(matte).rotate(90).png().toBuffer()]) {
    await openMatted(file('turned.jpg', turned), file('matte.png', kind));
    pixels.push(await shownDepth());
    await choose('picture');
  }
  assertSameBytes(...pixels);
  assert.equal(pixels[0].length, (await sharp(upright).removeAlpha().raw().toBuffer()).length);
});

test('a picture with its depth picture and its matte opens, focused on the subject', async () => {
  const levels = Uint8Array.from(disparity.data, value => 100 + 8 * value);
  const depth = await sharp(levels, {raw: {width, height, channels: 1}}).png().toBuffer();
  const files = [photo(), file('depth.png', depth), file('matte.png', await makeMatte(1).toBuffer())];
  await openMatted(...files);
  assert.ok(['near', 'nearest'].includes(await focusText()));
  assert.ok(await driver.page.isEnabled('#swap'));
});

test('a portrait that stores a mask instead of a map opens with two surfaces', async () => {
  const flat = (r, g, b) => sharp({create: {width, height, channels: 3, background: {r, g, b}}}).jpeg({quality: 95}).toBuffer();
  const black = await makeMatte(1, alpha => 255 - alpha).jpeg({quality: 95}).toBuffer();
  const white = await makeMatte(1).jpeg({quality: 95}).toBuffer();
  for (const [mask, isStated, isLost] of [[black, true], [black, false], [white, false], [black, true, true]]) {
    const portrait = makeDynamicDepth(await flat(40, 40, 200), [['android/depthmap', mask]], undefined, 'Segmentation', isStated, isLost);
    await andFull(() => openFiles(file('portrait.jpg', portrait)));
    assert.equal(await focusText(), 'nearest');
    const map = await shownDepth(), at = ([x, y]) => map[3 * (Math.trunc(y * height / 768) * width + Math.trunc(x * width / 1024))];
    assert.deepEqual([at(place('near')), map[3 * (5 * width + width - 9)]], [255, 0]);
    await choose('picture');
  }
});

test('portraits of Apple open with the matte that they store, with and without depth', async () => {
  const seed = (...path) => readFileSync(join(sources, 'tests', 'fuzz', 'corpus', ...path));
  const jpeg = seed('photo', 'mattes.jpg'), heic = seed('heif', 'mattes.heic'), flat = Buffer.from(heic);
  flat[flat.indexOf('auxid:') + 6] = '9'.charCodeAt();  // no type of depth
  const files = [file('mattes.jpg', jpeg), ...(noDecoder ? [] : [file('mattes.heic', heic), file('mattes.heic', flat)])];
  for (const one of files) {
    await andFull(() => openFiles(one));
    assert.ok(await driver.page.isHidden('#offer') && await driver.page.isHidden('#error'));
    assert.equal(await driver.page.isDisabled('#swap'), one.buffer === flat);
  }
  if (noDecoder) return;
  assert.equal(await focusText(), 'nearest');
  const map = await shownDepth();
  assert.deepEqual([map[3 * (24 * 128 + 48)], map[3 * (24 * 128 + 100)]], [255, 0]);
  await choose('picture');
});

test('a stored matte that cannot be used is ignored', async () => {
  const levels = Uint8Array.from(disparity.data, value => 100 + 8 * value), raw = {raw: {width, height, channels: 1}};
  const map = markApple(await sharp(levels, raw).jpeg({quality: 95}).toBuffer(), {AuxiliaryImageType: 'disparity'});
  const empty = markApple(await sharp(levels.map(() => 0), raw).jpeg().toBuffer(),
                          {AuxiliaryImageType: 'depth', AuxiliaryImageSubType: 'portraiteffectsmatte'});
  const picture = await sharp(photo().buffer).jpeg({quality: 95}).toBuffer();
  const damaged = Buffer.from(empty);
  damaged.fill(0, damaged.indexOf('ffc0', 'hex') + 5, damaged.indexOf('ffc0', 'hex') + 9);  // its size
  const open = (...parts) => openFiles(file('apple.jpg', Buffer.concat([picture, ...parts])));
  for (const [matte, reason] of [
    [empty, 'The matte of portrait apple.jpg cannot be used: expected a matte with a subject, found an empty matte.'],
    [damaged, 'apple.jpg has a damaged mask of its subject, and no depth map.']
  ]) {
    await andWait(() => open(matte, map), /^Opened: depth photo apple\.jpg/);
    await without('segmenter', () => andWait(() => open(matte), /^Still open: depth photo apple\.jpg/));
    assert.equal(await error(), reason);
    if (!noSegmenter) await andWait(() => open(matte), /^apple\.jpg has no depth\.$/);
  }
});

test('finds the person in a photo without depth, and sends nothing', {skip: noSegmenter}, async () => {
  const portrait = file('display.jpg', readFileSync(join(site, 'demo', 'view_+0.0_+0.0.jpg')));
  await visit({}, async page => {
    const requests = [], note = request => requests.push(request);
    page.context().on('request', note);
    await andWait(() => openFiles(portrait), /^display\.jpg has no depth\.$/);
    const megabytes = readdirSync(segmenter).filter(name => /\.gzip$/.test(name))
        .reduce((sum, name) => sum + statSync(join(segmenter, name)).size, 0) / 1e6;
    assert.match(await page.innerText('#offer'), new RegExp(`Loads a segmenter of ${megabytes.toFixed(1)}\\sMB from this site\\. Nothing leaves your browser\\.`));
    await screenshot('offer');
    await page.click('#picture');
    await waitFor(/^This photo has no depth: first find the person\.$/);
    await andWait(() => openFiles(file('notes.txt', Buffer.from('no picture'))), /^display\.jpg has no depth\.$/);
    assert.match(await error(), /^notes\.txt is not a picture\.$/);
    assert.ok(!requests.some(request => /segmenter\.js|gzip/.test(request.url())), 'the segmenter is not loaded');
    await andFull(() => page.click('#find-person'));
    assert.ok(await page.isHidden('#offer') && await page.isHidden('#error'));
    await screenshot('person');
    for (const [name, focus] of [['near', 'nearest'], ['far', 'farthest'], ['near', 'nearest']]) {
      await tap(...place(name));
      assert.equal(await focusText(), focus);
    }
    const wrong = requests.filter(request => request.method() === 'POST' || ![driver.address, 'blob:', 'data:'].some(start => request.url().startsWith(start)));
    assert.deepEqual(wrong.map(request => request.url()), []);
    await page.waitForURL(/#/);  // the address contains the lens
    page.context().off('request', note);
    await page.reload();
    await full();  // the matte was kept
    assert.ok(await page.isHidden('#offer'));
  });
});

test('names the reason if the segmenter cannot be loaded, and keeps the offer', {skip: noSegmenter}, async () => {
  await visit({}, async page => {
    await page.context().route('**/*.gzip', route => route.fulfill({status: 404}));
    await andWait(() => openFiles(photo()), /^photo\.png has no depth\.$/);
    await page.click('#find-person');
    assert.equal(await error(), 'No person was found in photo.png: the server returned status 404.');
    assert.ok(await page.isVisible('#offer'));
  });
});
