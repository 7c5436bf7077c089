// SPDX-License-Identifier: Apache-2.0
// Tests actions during the opening of photos, and parts of the page that cannot be loaded. page_test.mjs imports these
// tests.

import assert from 'node:assert/strict';
import {join} from 'node:path';
import test from 'node:test';

import {
  andWait, choose, drawPhoto, driver, error, file, openFiles, setSlider, shown, small, tap, visit
} from './page_driver.mjs';
import {assertSameBytes, readPng} from './pictures.mjs';

const LARGE = /^Opened: photo\.jpg with depth\.png/;

test('a picture of the photo before does not replace a new photo', async () => {
  const old = await drawPhoto(2400, 1800), {jpeg, png} = await drawPhoto(4000, 3000);
  await visit({}, async page => {
    await andWait(() => openFiles(file('photo.jpg', old.jpeg), file('depth.png', old.png)), LARGE);
    await andWait(() => setSlider('focus', 'min'), /^Preview at 1\/\d: [\d.]+ ms/);
    await andWait(() => openFiles(file('photo.jpg', jpeg), file('depth.png', png)), LARGE);
    await page.waitForTimeout(500);
    const sharp = await shown();
    await setSlider('wipe', 100);
    const row = 3 * (await page.evaluate(() => document.getElementById('picture').width) - 2);  // without the line
    assertSameBytes(sharp.subarray(0, row), (await shown()).subarray(0, row));
  });
});

test('a demo that arrives late does not replace files of the user', async () => {
  const context = await driver.browser.newContext(), page = await context.newPage(), before = driver.page;
  let release;
  const released = new Promise(resolve => release = resolve);
  await context.route(/view_%2B0\.0_%2B0\.0/, route => released.then(() => route.continue()));
  driver.page = page;
  await page.goto(driver.address);
  const files = [file('photo.png', file('view_+0.0_+0.0.png').buffer), file('map.pfm', file('disparity.pfm').buffer)];
  await andWait(() => openFiles(...files), /^Opened: photo\.png with map\.pfm/);
  release();
  await page.waitForTimeout(500);
  assertSameBytes(await shown(), readPng(join(small, 'view_+0.0_+0.0.png')).data);
  await context.close();
  driver.page = before;
});

test('the depth of a large photo is repaired after the photo was opened', async () => {
  const {jpeg, png} = await drawPhoto(2400, 1800), engine = () => driver.page.textContent('#engine');
  await visit({}, async page => {
    await choose('depth');
    await andWait(() => openFiles(file('photo.jpg', jpeg), file('depth.png', png)), LARGE);
    assert.match(await engine(), /threads?\. The depth is being repaired\.$/);
    await page.waitForTimeout(300);
    const rough = await shown();
    await andWait(() => openFiles(file('notes.txt', Buffer.from('no picture'))), /^Still open/);
    await page.waitForFunction(() => !/repaired/.test(document.getElementById('engine').textContent), null, {timeout: 60000});
    await page.waitForTimeout(300);
    const repaired = await shown();
    assert.equal(repaired.length, rough.length);
    assert.ok(repaired.some((byte, i) => byte !== rough[i]), 'the depth changes');
    await choose('picture');
    await tap(100, 100);
  });
});

test('names parts of the page that cannot be loaded', async () => {
  const context = await driver.browser.newContext(), before = driver.page;
  await context.route(/pixels_worker/, route => route.fulfill({status: 404}));
  driver.page = await context.newPage();
  await driver.page.goto(driver.address);
  assert.equal(await error(), 'A part of the page could not be loaded. Reload the page.');
  await context.close();
  driver.page = before;
});
