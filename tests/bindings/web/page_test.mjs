// SPDX-License-Identifier: Apache-2.0
// Tests the page in Chromium: taps, sliders, dropped files, keys, and the screen of a phone, with and without shared
// memory. The bytes of the canvas are compared with the pictures of the program.

import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {join} from 'node:path';
import test, {after, before} from 'node:test';
import sharp from 'sharp';

import {
  andFull, choose, driver, end, error, focusText, full, launch, load, makeDemoFolder, place, screenshot, serve,
  setSlider, shown, status, tap, waitFor
} from './page_driver.mjs';
import {assertSameBytes, readPicture, refocusByProgram} from './pictures.mjs';

let demo, centre;

before(async () => {
  demo = await makeDemoFolder();
  centre = readPicture(join(demo, 'view_+0.0_+0.0.jpg'), join(demo, 'disparity.pfm')).data;
  driver.browser = await launch();
  driver.address = await serve();
  await load(driver.address);
});
after(end);

test('opens with the demo, sharp', async () => {
  assert.match(await driver.page.textContent('#engine'), /^starfocus \d+\.\d+\.\d+, \d+ threads?\.$/);
  assert.ok(await driver.page.evaluate(() => crossOriginIsolated));
  assertSameBytes(await shown(), centre);
});

test('two taps give the pictures of the program', async () => {
  for (const name of ['near', 'far']) {
    const at = place(name);
    await tap(...at);
    assertSameBytes(await shown(), refocusByProgram(demo, '--focus-at', at.join()));
    await screenshot(name);
  }
});

test('sliders and apertures give the pictures of the program', async () => {
  await andFull(() => setSlider('f-stop', 4));
  await andFull(() => setSlider('highlights', 2));
  await andFull(() => driver.page.selectOption('#shape', 'pentagon'));
  assertSameBytes(await shown(), refocusByProgram(
      demo, '--focus-at', place('far').join(), '--aperture', '0.25', '--highlights', '4', '--shape', 'polygon:5'));
  await andFull(() => setSlider('highlights', 0));
  await andFull(() => driver.page.selectOption('#shape', 'soft'));
  await andFull(() => setSlider('f-stop', 0));
});

test('the ends of the focus are no errors, and the focus is in words', async () => {
  for (const [value, words] of [['min', 'farthest'], ['max', 'nearest'], [0, 'in the middle']]) {
    await andFull(() => setSlider('focus', value));
    assert.ok(await driver.page.isHidden('#error'));
    assert.equal(await focusText(), words);
  }
  assert.doesNotMatch(await driver.page.locator('body').innerText(), /disparity/i);
});

test('of many changes of the focus the last one counts', async () => {
  await driver.page.evaluate(async () => {
    const slider = document.getElementById('focus');
    for (let i = 0; i <= 20; ++i) {
      slider.value = -8 + i / 2;
      slider.dispatchEvent(new Event('input', {bubbles: true}));
      await new Promise(resolve => setTimeout(resolve, 10));
    }
    document.getElementById('status').textContent = '';
  });
  await full();
  assertSameBytes(await shown(), refocusByProgram(demo, '--focus', '2'));
});

test('shows depth, blocks, and the original beside the picture', async () => {
  await choose('depth');
  await screenshot('depth');
  const depth = await shown();
  assert.ok(depth.every((value, i) => value === depth[i - i % 3]));
  await andFull(() => choose('blocks'));
  await screenshot('blocks');
  await choose('picture');
  await setSlider('wipe', 100);
  const row = 3 * (await driver.page.evaluate(() => document.getElementById('picture').width) - 2);  // without the line
  assertSameBytes((await shown()).subarray(0, row), centre.subarray(0, row));
  await setSlider('wipe', 50);
  await screenshot('wipe');
  await setSlider('wipe', 0);
});

test('pulls the focus and returns, and stops when asked', async () => {
  const focus = await driver.page.inputValue('#focus');
  await andFull(() => driver.page.click('#pull'));
  assert.equal(await driver.page.inputValue('#focus'), focus);
  await driver.page.click('#pull');
  await driver.page.waitForTimeout(300);
  assert.equal(await driver.page.getAttribute('#pull', 'aria-pressed'), 'true');
  assert.notEqual(await driver.page.inputValue('#focus'), focus);
  await andFull(() => driver.page.click('#pull'));
  assert.equal(await driver.page.getAttribute('#pull', 'aria-pressed'), 'false');
});

test('gives a JPEG of the picture', async () => {
  const [download] = await Promise.all([driver.page.waitForEvent('download'), driver.page.click('#download')]);
  assert.equal(download.suggestedFilename(), 'demo-refocused.jpg');
  const path = await download.path(), {data} = await sharp(path).raw().toBuffer({resolveWithObject: true});
  assert.deepEqual([...readFileSync(path).subarray(0, 3)], [0xFF, 0xD8, 0xFF]);
  const expected = await shown(), error = expected.reduce((sum, byte, i) => sum + Math.abs(byte - data[i]), 0);
  assert.equal(data.length, expected.length);
  assert.ok(error < 2 * data.length, `the mean error is ${error / data.length}`);
});

test('keys focus, and every control says what it is', async () => {
  await driver.page.focus('#picture');
  for (const key of ['ArrowLeft', 'ArrowUp', 'Shift+ArrowUp']) await driver.page.keyboard.press(key);
  assert.match(await status(), /^Cross at 49 % from the left, 41 % from the top\.$/);
  await andFull(() => driver.page.keyboard.press('Enter'));
  await driver.page.keyboard.press('Escape');
  const at = await driver.page.evaluate(() => {
    const {width, height} = document.getElementById('picture');
    return [(width >> 1) - 8, (height >> 1) - 72];
  });
  assertSameBytes(await shown(), refocusByProgram(demo, '--focus-at', at.join()));
  const heard = await driver.page.locator('body').ariaSnapshot();
  for (const control of [/slider "Focus/, /slider "F-stop/, /slider "Highlights/, /combobox "Aperture"/, /radio "Depth"/,
                         /slider "Before and after/, /button "Pull focus"/, /status/]) {
    assert.match(heard, control);
  }
  const unnamed = await driver.page.evaluate(() => [...document.querySelectorAll('main input:not([hidden]), select, button')]
      .filter(control => !control.labels?.length && !control.textContent.trim()).length);
  assert.equal(unnamed, 0);
});

await import('./page_files.mjs');
await import('./page_matte.mjs');
await import('./page_visit.mjs');

test('50 refocusings leak nothing', async () => {
  await driver.page.close();
  await load(driver.address);
  const session = await driver.browser.newBrowserCDPSession(), own = await driver.page.context().newCDPSession(driver.page);
  const memory = async () => {
    await own.send('HeapProfiler.collectGarbage');
    await driver.page.waitForTimeout(200);
    const {processInfo} = await session.send('SystemInfo.getProcessInfo');
    const sizes = processInfo.filter(({type}) => type === 'renderer').map(
        ({id}) => Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${id}/status`, 'utf8'))[1]) / 1024);
    return Math.max(...sizes);
  };
  const foci = async count => {
    for (let i = 0; i < count; ++i) await andFull(() => setSlider('focus', -8 + i % 16));
  };
  await foci(10);
  const picture = await driver.page.evaluate(() => {
    const {width, height} = document.getElementById('picture');
    return 4 * width * height / 1024 ** 2;
  });
  const first = await memory();
  await foci(50);
  const last = await memory();
  console.log(`# renderer: ${first.toFixed(0)} MiB after 10 refocusings, ${last.toFixed(0)} after 60`);
  // Chromium's own memory varies by up to 30 MiB. A leak of half a picture in each refocusing exceeds this.
  assert.ok(last < first + 50 * picture / 2, `${first} MiB grew to ${last}`);
});

test('works offline once it is loaded', async () => {
  await driver.page.context().setOffline(true);
  await tap(...place('near'));
  await driver.page.context().setOffline(false);
});

test('without shared memory: one thread, the same picture', async () => {
  await driver.page.close();
  await load(await serve('plain'));
  assert.equal(await driver.page.evaluate(() => crossOriginIsolated), false);
  assert.match(await driver.page.textContent('#engine'), /, 1 thread\.$/);
  await tap(...place('near'));
  assertSameBytes(await shown(), refocusByProgram(demo, '--focus-at', place('near').join()));
  assert.equal(driver.problem, undefined);
});

test('without shared memory, pictures in parts have the same bytes, and every call can be cancelled', async () => {
  const found = await driver.page.evaluate(async () => {
    const {createRefocuser} = await import('./starfocus/starfocus.js');
    const width = 301, height = 2300, pixels = width * height, problems = [];
    const made = await createRefocuser({width, height, views: 1, disparityMin: -1, disparityMax: 21, previews: 3});
    const view = Uint8Array.from({length: 3 * pixels}, (_, i) => i % 903 * 7 + i / 9000 & 255);
    const map = Float32Array.from({length: pixels}, (_, i) => i % 301 > 150 ? 20 : i / pixels);
    await made.prepare([view], map);
    const regions = [undefined, {x: 0, y: 0, width: 0, height: 0}, {x: 7, y: 500, width: 200, height: 30},
                     {x: 0, y: 1023, width: 301, height: 1277}, {x: 33, y: 511, width: 64, height: 1025}];
    const {signal} = new AbortController();
    for (const region of regions) {
      for (const shift of [0, 1, 2, 3]) {
        for (const blocks of shift ? [false] : [false, true]) {
          const call = extra => shift ? made.preview({focus: 12, region, shift, ...extra}) : made.refocus({focus: 12, region, blocks, ...extra});
          const whole = await call({}), parts = await call({signal});
          const isSame = whole.width === parts.width && whole.height === parts.height &&
              whole.data.every((value, i) => value === parts.data[i]) && JSON.stringify(whole.blocks) === JSON.stringify(parts.blocks);
          if (!isSame) problems.push(`${JSON.stringify(region)}, shift ${shift}, blocks ${blocks}`);
        }
      }
    }
    const errorOf = call => call.then(() => ({}), error => error);
    for (const [x, y, width, height] of [[0, 0, 302, 5], [0, 2299, 3, 2], [-1, 0, 3, 3], [0, 0, 0, 5]]) {
      const region = {x, y, width, height}, error = await errorOf(made.refocus({focus: 12, region, signal}));
      if (error.code !== 'RANGE') problems.push(`${JSON.stringify(region)}: ${error.message}`);
    }
    // The worker ends a call after the part that is being computed.
    for (const call of [signal => made.preview({focus: 12, shift: 1, signal}), signal => made.refocus({focus: 12, region: regions[3], signal}),
                        signal => made.refocus({focus: 12, blocks: true, signal})]) {
      let isFree = false;
      for (let attempt = 0; attempt < 10 && !isFree; ++attempt) {  // other programs may delay one attempt
        const stop = new AbortController(), running = call(stop.signal), begin = performance.now();
        await new Promise(resolve => setTimeout(resolve, 5));
        stop.abort();
        const error = await errorOf(running);
        await made.focusAt({x: 1, y: 1});
        const time = performance.now() - begin, start = performance.now();
        await call();
        isFree = error.name === 'AbortError' && time < 0.75 * (performance.now() - start);
      }
      if (!isFree) problems.push(`${call}: not free soon after the abort`);
    }
    const stop = new AbortController(), preparing = made.prepare([view], map, {repair: true, signal: stop.signal});
    setTimeout(() => stop.abort(), 20);
    const error = await errorOf(preparing);
    await made.prepare([view], map);
    if (error.name !== 'AbortError' || (await made.preview({focus: 12})).width !== 151) problems.push(`prepare: ${error.name}`);
    made.close();
    return problems;
  });
  assert.deepEqual(found, []);
});

test('without SIMD: one sentence', {skip: process.arch !== 'x64'}, async () => {
  await driver.browser.close();
  driver.browser = await launch('--js-flags=--no-enable-sse4-1');
  driver.page = await driver.browser.newPage();
  await driver.page.goto(driver.address);
  assert.match(await error(), /WebAssembly has no SIMD here/);
});
