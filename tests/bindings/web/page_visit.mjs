// SPDX-License-Identifier: Apache-2.0
// Tests a visit to the page: a phone, light and dark colours, the address, the return to the page, slow connections,
// large photos, actions while a photo opens, and parts that cannot be loaded. page_test.mjs imports these tests.

import assert from 'node:assert/strict';
import {readdirSync, readFileSync, statSync} from 'node:fs';
import {join} from 'node:path';
import test from 'node:test';

import {makeGDepth} from './gdepth_photo.mjs';
import {
  andFull, andWait, choose, drawPhoto, driver, error, file, full, inNewPage, openFiles, place, screenshot, setSlider,
  shown, site, sources, tap, visit, waitFor
} from './page_driver.mjs';
import {assertSameBytes, folder as small, readPicture, refocusByProgram} from './pictures.mjs';

const PHONE = {viewport: {width: 390, height: 844}, hasTouch: true, isMobile: true, deviceScaleFactor: 2};

test('fits a phone and a desktop, in light and dark colours', async () => {
  const colours = new Set();
  for (const colorScheme of ['light', 'dark']) {
    await visit({...PHONE, colorScheme}, async page => {
      await tap(...place('middle'));
      assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= 390));  // innerWidth grows with the page
      const low = await page.evaluate(() => [...document.querySelectorAll('button, select, input[type=range], .choices label')]
          .filter(control => !control.closest('[hidden]') && control.getBoundingClientRect().height < 44).map(control => control.outerHTML));
      assert.deepEqual(low, []);
      assert.doesNotMatch(await page.locator('body').innerText(), /\bdrop\b/i);
      await page.setViewportSize({width: 390, height: 1200});  // the whole page
      await screenshot(`phone-${colorScheme}`);
    });
    await visit({colorScheme}, async page => {
      await tap(...place('near'));
      assert.match(await page.locator('body').innerText(), /Drop a portrait, a depth photo/);
      colours.add(await page.evaluate(() => getComputedStyle(document.body).backgroundColor));
      await screenshot(`desktop-${colorScheme}`);
    });
  }
  assert.equal(colours.size, 2);
});

test('the gallery of the site fits phones', async () => {
  const compared = join(small, 'compare.html');
  refocusByProgram(small, '--focus', '1', '--compare', compared);
  const made = readFileSync(compared, 'utf8'), style = readFileSync(join(sources, 'toolchains', 'site', 'site.css'), 'utf8');
  const [slider] = /<div class="slider".*?<div class="divider"><\/div>\n<\/div>/s.exec(made);
  const rules = /<style>(.*?)<\/style>/s.exec(made)[1].match(/^\.(?:slider|tag|divider).*$/gm).join('\n');
  for (const width of [320, 360, 390, 412]) {
    const context = await driver.browser.newContext({...PHONE, viewport: {width, height: 844}}), page = await context.newPage();
    await page.setContent(`<!doctype html><meta name="viewport" content="width=device-width, initial-scale=1">
        <style>${style}${rules}</style><main><h1>Gallery</h1>${slider}</main>`);
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), width);
    await context.close();
  }
});

test('the address is a link to the lens', async () => {
  await visit({}, async page => {
    await andFull(() => setSlider('focus', 3));
    await andFull(() => setSlider('f-stop', 3));
    await andFull(() => page.selectOption('#shape', 'hexagon'));
    await andFull(() => setSlider('highlights', 1));
    await page.waitForFunction(() => /highlights=2/.test(location.hash));
    assert.match(page.url(), /#focus=0\.\d+&f=2\.83&shape=hexagon&highlights=2\.00$/);
    const expected = await shown(), link = page.url();
    await page.goto('about:blank');
    await page.goto(link);
    await full();
    assert.equal(await page.inputValue('#shape'), 'hexagon');
    const again = await shown(), different = again.filter((byte, i) => Math.abs(byte - expected[i]) > 2).length;
    assert.ok(different < 0.001 * again.length, `${different} bytes differ`);
  });
});

test('is as it was left after Back and after a reload', async () => {
  await visit({}, async page => {
    const {jpeg, png} = await drawPhoto(64, 48);
    await andWait(() => openFiles(file('phone.jpg', makeGDepth(jpeg, png))), /^Opened: depth photo phone\.jpg/);
    await tap(10, 10);
    await page.check('input[name=show][value=depth]');
    await page.waitForTimeout(600);
    const expected = await shown();
    await page.goto('about:blank');
    await page.goBack();
    await full();
    await page.waitForTimeout(300);
    assertSameBytes(await shown(), expected);
    await page.reload();
    await full();
    assert.ok(await page.isChecked('input[name=show][value=depth]'));
    await page.check('input[name=show][value=picture]');
    assert.equal(await page.evaluate(() => document.getElementById('picture').width), 64);
  });
});

/** Loads the page over 6.4 Mbit/s with a processor that is six times slower. Returns the times in ms until the centre
 *  view is visible and until the picture can be tapped. */
async function loadSlowly() {
  const page = await driver.browser.newPage({viewport: PHONE.viewport}), session = await page.context().newCDPSession(page);
  await session.send('Network.enable');
  await session.send('Network.emulateNetworkConditions',
                     {offline: false, latency: 40, downloadThroughput: 800000, uploadThroughput: 800000});
  await session.send('Emulation.setCPUThrottlingRate', {rate: 6});
  const begin = performance.now();
  await page.goto(driver.address, {waitUntil: 'commit'});
  await page.waitForSelector('canvas.filled', {timeout: 60000});
  const visible = performance.now() - begin;
  await waitFor(/^Opened: the demo/, page);
  const tappable = performance.now() - begin;
  await page.context().close();
  return {visible, tappable};
}

test('on a slow phone the centre view is visible before the picture can be tapped, and the demo is small', async () => {
  const {visible, tappable} = await loadSlowly();
  console.log(`# slow phone: centre view after ${visible.toFixed()} ms, tappable after ${tappable.toFixed()} ms`);
  assert.ok(visible < tappable);
  const demo = join(site, 'demo');
  const bytes = readdirSync(demo).reduce((sum, name) => sum + statSync(join(demo, name)).size, 0);
  assert.ok(bytes < 2.5e6, `the demo has ${bytes} bytes`);
});

test('a photo above 16 megapixels is reduced before any canvas is drawn', async () => {
  const {jpeg, png} = await drawPhoto(5000, 4000, 50);
  await visit({}, async page => {
    // Canvases above 2 ** 24 pixels fail, as on iOS before version 18, in the page and in its workers.
    const context = page.context();
    await context.route(/\.js$/, async route => {
      const response = await route.fetch();
      const body = (await response.text()).replace(/new OffscreenCanvas\((\w+(?:\.\w+)*), ?(\w+(?:\.\w+)*)\)/g,
                                                   'new OffscreenCanvas($1*$2>16777216?$1.isTooLarge.forCanvas:$1,$2)');
      await route.fulfill({response, body});
    });
    await page.reload();
    await waitFor(/^Opened: the demo/);
    await andWait(() => openFiles(file('large.jpg', jpeg), file('depth.png', png)),
                  /^Opened: large\.jpg with depth\.png, reduced from 5000 x 4000, 4579 x 3663/);
    const [download] = await Promise.all([page.waitForEvent('download'), page.click('#download')]);
    const bytes = readFileSync(await download.path());
    assert.deepEqual(sizeOfJpeg(bytes), [4579, 3663]);
    assert.ok(await page.isHidden('#error'));
  });
});

/** Returns the width and height in the first frame header of a JPEG file. */
function sizeOfJpeg(bytes) {
  const at = bytes.indexOf(Buffer.from([0xFF, 0xC0]));
  return [bytes.readUInt16BE(at + 7), bytes.readUInt16BE(at + 5)];
}

test('a photo of 12 megapixels is visible before it can be tapped', async () => {
  const {jpeg, png} = await drawPhoto(4000, 3000), photo = file('large.jpg', makeGDepth(jpeg, png));
  await visit({}, async page => {
    await page.evaluate(() => {
      const picture = document.getElementById('picture'), status = document.getElementById('status'), begin = {};
      document.getElementById('files').addEventListener('change', () => begin.time = performance.now(), {capture: true});
      new MutationObserver(() => globalThis.sharp = performance.now() - begin.time).observe(picture, {attributeFilter: ['width']});
      new MutationObserver(() => {
        if (/^Opened: depth/.test(status.textContent)) globalThis.ready ??= performance.now() - begin.time;
      }).observe(status, {childList: true});
    });
    await andWait(() => openFiles(photo), /^Opened: depth photo large\.jpg, 4000 x 3000/);
    await tap(100, 100);
    const [sharp, ready] = await page.evaluate(() => [globalThis.sharp, globalThis.ready]);
    console.log(`# 12 megapixels: sharp after ${sharp.toFixed()} ms, ready after ${ready.toFixed()} ms`);
    assert.ok(sharp < ready);
  });
});

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
  let release;
  const released = new Promise(resolve => release = resolve);
  const hold = context => context.route(/view_%2B0\.0_%2B0\.0/, route => released.then(() => route.continue()));
  await inNewPage(hold, async page => {
    const files = [file('photo.png', file('view_+0.0_+0.0.png').buffer), file('map.pfm', file('disparity.pfm').buffer)];
    await andWait(() => openFiles(...files), /^Opened: photo\.png with map\.pfm/);
    release();
    await page.waitForTimeout(500);
    assertSameBytes(await shown(), readPicture(join(small, 'view_+0.0_+0.0.png'), join(small, 'disparity.pfm')).data);
  });
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

test('names parts of the page that cannot be loaded', () => inNewPage(
    context => context.route(/pixels_worker/, route => route.fulfill({status: 404})),
    async () => assert.equal(await error(), 'A part of the page could not be loaded. Reload the page.')));
