// SPDX-License-Identifier: Apache-2.0
// Tests which files the page opens, which files it rejects and why, and what it keeps of a photo. page_test.mjs imports
// these tests.

import assert from 'node:assert/strict';
import {existsSync, readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import test from 'node:test';
import sharp from 'sharp';

import {makeDynamicDepth, makeGDepth, markApple, markGain, markIsoGain} from './gdepth_photo.mjs';
import {
  andFull, andWait, choose, drawPhoto, driver, error, file, focusText, load, openFiles, screenshot,
  setSlider, shown, shownDepth, site, sources, tap, waitFor, without
} from './page_driver.mjs';
import {assertSameBytes, folder as small, refocusByProgram} from './pictures.mjs';

const sample = name => file(name, readFileSync(join(sources, 'tests', 'fuzz', 'corpus', 'photo', name)));
const photos = join(process.env.STARFOCUS_DATA_DIR ?? join(sources, '..', 'shared', 'data'), 'photos');
const noDecoder = !existsSync(join(site, 'heic')) && 'the site has no HEIC decoder';
const noPug = noDecoder || !existsSync(join(photos, 'pug.heic')) && `${photos} has no pug.heic`;
const photo = () => file('photo.png', file('view_+0.0_+0.0.png').buffer);
const opened = (pattern, ...files) => andWait(() => openFiles(...files), pattern);

/** Returns the text of the focus at both ends of the slider, from far to near. */
async function focusTexts() {
  const texts = [];
  for (const end of ['min', 'max']) {
    await andFull(() => setSlider('focus', end));
    texts.push(await focusText());
  }
  return texts;
}

/** Returns a segment of EXIF in big-endian order, with the orientation 6 and the maker "Maker". */
function makeExif() {
  const tiff = Buffer.from('4d4d002a00000008' + '0002' + '010f000200000006' + '00000026' + '0112000300000001' + '00060000' +
                           '00000000', 'hex');
  const body = Buffer.concat([Buffer.from('Exif\0\0', 'latin1'), tiff, Buffer.from('Maker\0', 'latin1')]);
  return Buffer.concat([Buffer.from([0xFF, 0xE1, 0, body.length + 2]), body]);
}

/** Returns the JPEG with EXIF that states this orientation. */
function turn(jpeg, orientation) {
  const exif = makeExif();
  exif[exif.indexOf('0112000300000001', 'hex') + 9] = orientation;
  return Buffer.concat([jpeg.subarray(0, 2), exif, jpeg.subarray(2)]);
}

test('a depth map of 16 bits keeps its bits, in every orientation', async () => {
  const levels = Uint16Array.from({length: 64 * 48}, (_, i) => 0x1000 + i % 64 + 2 * Math.trunc(i / 64));
  const png = await sharp(levels, {raw: {width: 64, height: 48, channels: 1}}).toColourspace('grey16').png().toBuffer();
  const {jpeg} = await drawPhoto(64, 48);
  // Corners of the stored map, 0 to 3, that are shown at the upper left, upper right, lower left and lower right.
  const corners = {
    1: [0, 1, 2, 3], 2: [1, 0, 3, 2], 3: [3, 2, 1, 0], 4: [2, 3, 0, 1], 5: [0, 2, 1, 3], 6: [2, 0, 3, 1], 7: [3, 1, 2, 0], 8: [1, 3, 0, 2]
  };
  for (let orientation = 1; orientation <= 8; ++orientation) {
    const linear = {format: 'RangeLinear', units: 'm', far: 5};
    for (const range of orientation === 6 ? [undefined, linear] : [undefined]) {
      await opened(/^Opened: depth photo turned\.jpg/, file('turned.jpg', makeGDepth(turn(jpeg, orientation), png, range)));
      const depth = await shownDepth(), across = orientation >= 5 ? 48 : 64, down = 112 - across;
      const found = [0, across - 1, across * (down - 1), across * down - 1].map(at => depth[3 * at]);
      const stored = [0, 1, 2, 3].map(corner => found[corners[orientation].indexOf(corner)]);
      assert.ok(stored[0] > stored[1] + 50 && stored[1] > stored[2] + 20 && stored[2] > stored[3] + 50,
                `orientation ${orientation}: levels of the stored corners ${stored}`);
    }
  }
  await opened(/^Opened: photo\.png with depth\.png/, photo(), file('depth.png', png));
  const row = (await shownDepth()).subarray(0, 3 * 320);
  assert.ok(Math.abs(row[3 * 310] - row[3 * 10]) > 50, 'a file of 16 bits keeps its low bits');
  await choose('picture');
});

test('opens stereo photos, and estimates their depth as the program does', async () => {
  const [left, right] = await Promise.all(['view_+0.0_+0.0.png', 'view_+1.0_+0.0.png'].map(
      name => sharp(join(small, name)).jpeg({quality: 95, chromaSubsampling: '4:4:4'}).toBuffer()));
  const path = join(small, 'twins.mpo'), expected = () => refocusByProgram(path, '--focus-at', '100,120');
  writeFileSync(path, Buffer.concat([left, right]));
  await opened(/^Opened: stereo photo twins\.mpo, 320 x 240/, file('twins.mpo'));
  await tap(100, 120);
  assertSameBytes(await shown(), expected());
  writeFileSync(path, Buffer.concat([turn(left, 6), right]));
  await opened(/^Opened: stereo photo twins\.mpo, 320 x 240/, file('twins.mpo'));
  await tap(100, 120);
  assertSameBytes(await shown(), expected());
  // A right picture that is 3 pixels too low is moved; another scene is rejected.
  const low = await sharp(right).extract({left: 0, top: 0, width: 320, height: 237}).extend({top: 3, extendWith: 'mirror'}).jpeg({quality: 95, chromaSubsampling: '4:4:4'}).toBuffer();
  writeFileSync(path, Buffer.concat([left, low]));
  await opened(/^Opened: stereo photo twins\.mpo, 320 x 240/, file('twins.mpo'));
  await tap(100, 120);
  assertSameBytes(await shown(), expected());
  const upset = await sharp(right).rotate(180).jpeg({quality: 95}).toBuffer();
  await opened(/^Still open/, file('twins.mpo', Buffer.concat([left, upset])));
  assert.match(await error(), /^twins\.mpo has two pictures, but they are not two pictures of one scene/);
  const cut = await sharp(right).extract({left: 0, top: 0, width: 300, height: 240}).jpeg().toBuffer();
  await opened(/^Still open/, file('twins.mpo', Buffer.concat([left, cut])));
  assert.match(await error(), /^The right picture of twins\.mpo is 300 x 240; expected 320 x 240/);
  await without('segmenter', () => opened(/^Still open/, file('twins.jpg', Buffer.concat([left, right]))));
  assert.match(await error(), /^twins\.jpg contains no depth map\./);
});

test('opens light fields, and pairs with disparities', async () => {
  const names = ['view_+0.0_+0.0', 'view_+1.0_+0.0', 'view_-1.0_+0.0', 'view_+0.0_+1.0', 'view_+0.0_-1.0'];
  await opened(/^Opened: light field of 5 views, 320 x 240/, ...names.map(name => file(`${name}.png`)), file('disparity.pfm'));
  await tap(100, 120);
  assertSameBytes(await shown(), refocusByProgram(small, '--focus-at', '100,120'));
  assert.ok(await driver.page.isDisabled('#swap'));
  await andWait(() => driver.page.setInputFiles('#folder', small), /^Opened: light field of 5 views, 320 x 240/);
  await opened(/^Opened: photo\.png with map\.pfm/, photo(), file('map.pfm', file('disparity.pfm').buffer));
  await tap(100, 120);
  assertSameBytes(await shown(), refocusByProgram(small, '--focus-at', '100,120', '--views', '1'));
});

test('guesses the near end of a depth picture, and swaps it', async () => {
  const {png} = await drawPhoto(64, 48);
  await opened(/^Opened: photo\.png with depth\.png/, photo(), file('depth.png', png));
  const brightness = async () => {
    const depth = await shownDepth();
    return depth[3 * 310] - depth[3 * 10];  // right minus left in the first row
  };
  const before = await brightness();
  await tap(300, 120);
  await andFull(() => driver.page.click('#swap'));
  assert.ok(before * await brightness() < 0, 'the other end is near');
  await choose('picture');
});

test('opens depth photos of phones, with distances where they are known', async () => {
  const {jpeg, png} = await drawPhoto(64, 48);
  const phone = makeGDepth(jpeg, png, {units: 'm'});
  await andWait(() => driver.page.evaluate(bytes => {
    const transfer = new DataTransfer();
    transfer.items.add(new File([new Uint8Array(bytes)], 'phone.jpg'));
    dispatchEvent(new DragEvent('drop', {dataTransfer: transfer, cancelable: true}));
  }, [...phone]), /^Opened: depth photo phone\.jpg, 64 x 48/);
  assert.deepEqual(await focusTexts(), ['10 m away', '1 m away']);
  for (const texts of [['farthest', 'nearest'], ['10 m away', '1 m away']]) {
    await andFull(() => driver.page.click('#swap'));
    assert.deepEqual(await focusTexts(), texts);
  }
  for (const [name, buffer, texts] of [
    ['no-unit.jpg', makeGDepth(jpeg, png), ['farthest', 'nearest']],
    ['linear.jpg', makeGDepth(jpeg, png, {format: 'RangeLinear', units: 'm', far: 5}), ['5 m away', '1 m away']],
    ['dynamic.jpg', sample('dynamic.jpg').buffer, ['9 m away', '1 m away']],
    ['diopters.jpg', sample('diopters.jpg').buffer, ['farthest', 'nearest']],
    ['apple.jpg', sample('apple.jpg').buffer, ['1 m away', '0.25 m away']]
  ]) {
    await opened(RegExp(`^Opened: depth photo ${name}, (64 x 48|8 x 6)`), file(name, buffer));
    assert.deepEqual(await focusTexts(), texts);
  }
  await andFull(() => openFiles(sample('mattes.jpg')));  // a matte precedes the map
  assert.match((await focusTexts()).join(), /^1 m away,0\.25 m away$/);
});

test('portraits open with their original picture, and a gain map is never depth', async () => {
  const flat = (r, g, b) => sharp({create: {width: 64, height: 48, channels: 3, background: {r, g, b}}}).jpeg({quality: 95}).toBuffer();
  const [blurred, original, gain] = [await flat(40, 40, 200), await flat(200, 40, 40), markGain(await flat(90, 90, 90))];
  const map = await sharp((await drawPhoto(64, 48)).png).jpeg({quality: 95}).toBuffer(), depth = ['android/depthmap', map];
  for (const before of [undefined, gain]) {
    for (const [items, red] of [[[depth], 40], [[['android/original_image', original], depth], 200], [[depth, ['android/original_image', original]], 200]]) {
      await opened(/^Opened: depth photo portrait\.jpg, 64 x 48/, file('portrait.jpg', makeDynamicDepth(blurred, items, before)));
      assert.ok(Math.abs((await shown())[0] - red) < 5);
      const shades = await shownDepth();
      assert.ok(shades[3 * 10] - shades[3 * 54] > 100, 'the map is a ramp');
      await choose('picture');
    }
  }
});

test('a note says that a gain map is dropped', async () => {
  const {jpeg, png} = await drawPhoto(64, 48), depth = file('depth.png', png), small = await sharp(jpeg).resize(16).jpeg().toBuffer();
  const appended = extra => Buffer.concat([jpeg, extra]), phone = makeGDepth(jpeg, png);
  const box = text => Buffer.from(`\0\0\0${String.fromCharCode(8 + text.length)}free${text}`, 'latin1'), heic = heicSample();
  const note = /^starfocus \S+, \d threads?\. The gain map of the photo is dropped, because pictures have 8 bits\.$/;
  for (const [expected, name, ...files] of [
    [true, 'adobe', file('adobe.jpg', appended(markGain(small))), depth],
    [true, 'apple', file('apple.jpg', appended(markApple(small, {AuxiliaryImageType: 'urn:com:apple:photo:2020:aux:hdrgainmap'}))), depth],
    [true, 'iso', file('iso.jpg', appended(markIsoGain(small))), depth],
    [true, 'phone', file('phone.jpg', Buffer.concat([phone, markGain(small)]))],
    [false, 'plain', file('plain.jpg', jpeg), depth],
    [false, 'thumbnail', file('thumbnail.jpg', appended(small)), depth],
    [false, 'stripped', file('stripped.jpg', markGain(jpeg)), depth],
    ...noDecoder ? [] : [
      [true, 'tone', file('tone.heic', Buffer.concat([heic, box('infe\x02\0\0\0\0\x05\0\0tmap\0')]))],
      [true, 'aux', file('aux.heic', Buffer.concat([heic, box('urn:com:apple:photo:2020:aux:hdrgainmap\0')]))],
      [false, 'small', file('small.heic', heic)]
    ]
  ]) {
    await opened(new RegExp(`^Opened: .*${name}\\.`), ...files);
    const text = await driver.page.textContent('#engine');
    assert.equal(note.test(text), expected, `${name}: ${text}`);
  }
});

test('keeps EXIF in the downloaded JPEG, which is upright', async () => {
  const {jpeg, png} = await drawPhoto(64, 48), exif = makeExif();
  const turned = Buffer.concat([jpeg.subarray(0, 2), exif, jpeg.subarray(2)]);
  await opened(/^Opened: depth photo IMG_1\.jpg, 48 x 64/, file('IMG_1.jpg', makeGDepth(turned, png)));
  await tap(24, 32);
  const [download] = await Promise.all([driver.page.waitForEvent('download'), driver.page.click('#download')]);
  assert.equal(download.suggestedFilename(), 'IMG_1-refocused.jpg');
  const bytes = readFileSync(await download.path()), upright = Buffer.from(exif);
  upright[upright.indexOf('0112000300000001', 'hex') + 9] = 1;
  assert.deepEqual(bytes.subarray(2, 2 + exif.length), upright);
});

test('rejects what it cannot read in a true sentence, and keeps what was open', async () => {
  const centre = file('view_+0.0_+0.0.png'), pfm = readFileSync(join(small, 'disparity.pfm'));
  const {jpeg, png} = await drawPhoto(64, 48), text = Buffer.from('no picture');
  const heic = Buffer.concat([Buffer.from([0, 0, 0, 24]), Buffer.from('ftypheic\0\0\0\0mif1heic')]);
  const flat = file('flat-depth.png', file('view_+0.0_+0.0.png').buffer);
  await opened(/^Opened: depth photo phone\.jpg/, file('phone.jpg', makeGDepth(jpeg, png)));
  const rejected = [
    [[file('photo.jpg', jpeg)], /^photo\.jpg contains no depth map\. Open a depth photo/],
    [[file('broken.jpg', makeGDepth(jpeg, text))], /^The depth map of broken\.jpg is not a picture\.$/],
    [[file('notes.txt', text)], /^notes\.txt is not a picture\.$/],
    [[file('cut.jpg', jpeg.subarray(0, -100)), file('disparity.pfm')], /^cut\.jpg is cut off: the end of the file is missing\.$/],
    [[file('cut.png', centre.buffer.subarray(0, 5000)), file('disparity.pfm')], /^cut\.png is cut off/],
    [[file('a.png', centre.buffer), file('map.pfm', pfm.subarray(0, 5000))], /^map\.pfm is cut off: 320 x 240 values need/],
    [[file('a.png', centre.buffer), file('map.pfm', jpeg)], /^map\.pfm is not a depth map/],
    [[file('phone.heic', heic), file('depth.png', centre.buffer)], /^phone\.heic is a HEIC picture, which this browser cannot read\./],
    [[file('phone.heic', heic)], /^phone\.heic (cannot be decoded|is a HEIC picture, which this browser cannot read)/],
    [[file('photo.jpg', jpeg), flat], /^The depth of photo\.jpg is 320 x 240; expected at most 64 x 48/],
    [[file('input_Cam000.png', jpeg), file('parameters.cfg', jpeg)], /HCI benchmark/],
    [[file('out_00_00_-1_1_.png', jpeg)], /Stanford archive/],
    [[centre, file('view_+1.0_+0.0.png'), file('view_-1.0_+0.0.png')], /no disparity\.pfm/],
    [[file('view_+1.0_+0.0.png'), file('view_-1.0_+0.0.png')], /no centre view/],
    [[file('disparity.pfm')], /depth map without its picture/],
    [[1, 2, 3].map(i => file(`${i}.png`, jpeg)), /found 3 files/],
    [[file('photo.jpg', jpeg), file('mask.png', flat.buffer)], /^The matte of photo\.jpg with mask\.png cannot be used: expected alpha or grey levels, found colours\.$/],
    [[file('photo.jpg', jpeg), file('matte.jpg', await sharp(jpeg).greyscale().resize(64, 32, {fit: 'fill'}).toBuffer())],
     /^The matte of photo\.jpg .*: expected the proportions of the picture, 64 x 48, found '64 x 32'\.$/]
  ];
  await without('segmenter', async () => {
    for (const [files, message] of rejected) {
      await opened(/^Still open: depth photo phone\.jpg\.$/, ...files);
      assert.match(await error(), message);
      assert.doesNotMatch(await error(), /starfocus_|STARFOCUS|undefined|\bNaN\b/);
    }
  });
  await screenshot('error');
  await tap(10, 10);
  assert.ok(await driver.page.isHidden('#error'), 'an alert disappears after the next success');
});

/** Returns the correlation of R, G, B bytes with the proportions 4:3 with a grey PNG of other size. */
async function correlate(data, png) {
  const height = Math.sqrt(data.length / 4), width = 4 * height / 3;
  const [a, b] = await Promise.all([sharp(data, {raw: {width, height, channels: 3}}), sharp(png)].map(
      picture => picture.extractChannel(0).resize(100, 100, {fit: 'fill'}).raw().toBuffer()));
  const mean = of => a.reduce((sum, _, i) => sum + of(i), 0) / a.length;
  const [meanA, meanB] = [mean(i => a[i]), mean(i => b[i])];
  const covariance = mean(i => (a[i] - meanA) * (b[i] - meanB));
  return covariance / Math.sqrt(mean(i => (a[i] - meanA) ** 2) * mean(i => (b[i] - meanB) ** 2));
}

const heicSample = () => readFileSync(join(sources, 'tests', 'fuzz', 'corpus', 'heif', 'depth.heic'));

test('opens a portrait of a phone in HEIC', {skip: noPug}, async () => {
  const {page} = driver;
  await load(driver.address);  // a new page, and the memory of the old page is freed
  await opened(/^Opened: depth photo pug\.heic, 4032 x 3024/, file('pug.heic', readFileSync(join(photos, 'pug.heic'))));
  const likeness = await correlate(await shownDepth(), readFileSync(join(photos, 'pug_depth.png')));
  assert.ok(likeness > 0.98, `expected the depth of pug_depth.png, found a correlation of ${likeness}`);
  await choose('picture');
  await screenshot('heic');
  assert.deepEqual(await focusTexts(), ['farthest', 'nearest']);
  const [download] = await Promise.all([driver.page.waitForEvent('download'), driver.page.click('#download')]);
  assert.equal(download.suggestedFilename(), 'pug-refocused.jpg');
  const start = readFileSync(await download.path()).subarray(0, 8000).toString('latin1');
  assert.match(start, /Exif\0\0.*Apple.*ICC_PROFILE\0/s);
  await driver.page.close();
  driver.page = page;
});

test('decodes HEIC, and loads the decoder only if it is needed', {skip: noDecoder}, async () => {
  const {png} = await drawPhoto(16, 16), heic = heicSample(), plain = Buffer.from(heic);
  plain[plain.indexOf('auxid:2') + 6] = '1'.charCodeAt();  // alpha instead of depth
  const requests = [], note = request => requests.push(request.url());
  driver.page.context().on('request', note);
  await opened(/^Opened: photo\.png with depth\.png/, photo(), file('depth.png', png));
  assert.ok(!requests.some(url => url.includes('heic')), 'the decoder is not loaded');
  await opened(/^Opened: depth photo small\.heic, 16 x 16/, file('small.heic', heic));
  assert.ok(requests.some(url => url.includes('libheif.wasm')), 'the decoder is loaded');
  driver.page.context().off('request', note);
  await opened(/^Opened: plain\.heic with depth\.png, 16 x 16/, file('plain.heic', plain), file('depth.png', png));
  await without('segmenter', () => opened(/^Still open/, file('plain.heic', plain)));
  assert.match(await error(), /^plain\.heic contains no depth map\. Open a depth photo/);
  await opened(/^Still open/, file('cut.heic', heic.subarray(0, -200)));
  assert.match(await error(), /^cut\.heic cannot be decoded: the file is damaged, or of a kind/);
});

test('names HEIC as the reason if the site has no decoder', async () => {
  await without('heic', () => opened(/^Still open/, file('small.heic', heicSample())));
  assert.match(await error(), /^small\.heic is a HEIC picture, which this browser cannot read\./);
});
