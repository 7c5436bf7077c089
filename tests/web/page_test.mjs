// SPDX-License-Identifier: Apache-2.0
// Tests the page in Chromium: taps, sliders, dropped files, keys, and the screen of a phone, with and without shared
// memory. The bytes of the canvas are compared with the pictures of the program.

import assert from 'node:assert/strict';
import {execFileSync, spawn} from 'node:child_process';
import {mkdtempSync, readFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import test, {after, before} from 'node:test';
import {chromium} from 'playwright-core';

import {makeGDepth} from './gdepth_photo.mjs';
import {assertSameBytes, dropAlpha, readPng} from './pictures.mjs';

const {STARFOCUS_PROGRAM: program, STARFOCUS_SITE: site, STARFOCUS_FIELD: small} = process.env;
const demo = join(site, 'demo'), scratch = mkdtempSync(join(tmpdir(), 'starfocus-web-'));
const servers = [];
let browser, page, address;

/** Starts a server for the site, and returns the address of the server. */
async function serve(...values) {
  const server = spawn(process.execPath, [process.env.STARFOCUS_SERVER, site, '0', ...values]);
  servers.push(server);
  return new Promise(resolve => server.stdout.once('data', line => resolve(String(line).trim())));
}

function refocusByProgram(folder, ...values) {
  const path = join(scratch, 'expected.png');
  execFileSync(program, ['refocus', folder, '-o', path, ...values]);
  return readPng(path).data;
}

const status = () => page.textContent('#status');
const error = () => page.locator('#error:visible').textContent({timeout: 20000});

async function waitFor(pattern) {
  try {
    await page.waitForFunction(([source]) => RegExp(source).test(document.getElementById('status').textContent),
                               [pattern.source], {timeout: 30000});
  } catch {
    assert.fail(`expected a status like ${pattern}, found '${await status()}'`);
  }
}

/** Waits until the page shows a full picture, which implies that all earlier requests have finished. */
const full = () => waitFor(/Full picture: [\d.]+ ms$/);

/** Performs an action that starts a refocusing, and waits for the full picture. */
async function andFull(action) {
  await page.evaluate(() => document.getElementById('status').textContent = '');
  await action();
  await full();
}

/** Returns the R, G, B bytes of the canvas. */
async function shown() {
  await page.evaluate(() => new Promise(resolve => requestAnimationFrame(() => requestAnimationFrame(resolve))));
  const text = await page.evaluate(async () => {
    const canvas = document.getElementById('picture');
    const {data} = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    const url = await new Promise(resolve => {
      const reader = new FileReader();
      reader.onload = () => resolve(reader.result);
      reader.readAsDataURL(new Blob([data]));
    });
    return url.slice(url.indexOf(',') + 1);
  });
  return dropAlpha(new Uint8Array(Buffer.from(text, 'base64')));
}

async function tap(x, y) {
  const at = await page.evaluate(([x, y]) => {
    const canvas = document.getElementById('picture'), box = canvas.getBoundingClientRect();
    const scale = Math.min(box.width / canvas.width, box.height / canvas.height);
    return [
      box.left + (box.width - canvas.width * scale) / 2 + (x + .5) * scale,
      box.top + (box.height - canvas.height * scale) / 2 + (y + .5) * scale
    ];
  }, [x, y]);
  await andFull(() => page.mouse.click(...at));
}

const setSlider = (id, value) => page.locator(`#${id}`).evaluate((slider, value) => {
  slider.value = value;
  slider.dispatchEvent(new Event('input', {bubbles: true}));
}, String(value));

const choose = what => page.check(`input[name=show][value=${what}]`);
const screenshot = name => page.screenshot({path: join(process.env.STARFOCUS_SCREENSHOTS, `${name}.png`)});
const file = (name, buffer = readFileSync(join(small, name))) => ({name, mimeType: '', buffer});
const openFiles = (...files) => page.setInputFiles('#files', files);

/** Returns the pixel [x, y] of a named object in the demo, from the demo's meta.txt. */
const place = name => /(\d+),(\d+)/.exec(
    readFileSync(join(demo, 'meta.txt'), 'utf8').split('\n').find(line => line.startsWith(`${name}:`))).slice(1).map(Number);

async function load(url) {
  page = await browser.newPage({viewport: {width: 1280, height: 860}});
  page.on('pageerror', problem => servers.problem = problem);
  await page.goto(url);
  await waitFor(/^Opened: the demo/);
}

const launch = (...args) => chromium.launch({executablePath: '/usr/bin/chromium', args: ['--no-sandbox', ...args]});

before(async () => {
  browser = await launch();
  address = await serve();
  await load(address);
});
after(async () => {
  await browser?.close();
  servers.forEach(server => server.kill());
});

test('opens with the demo, sharp', async () => {
  assert.match(await page.textContent('#engine'), /^starfocus \d+\.\d+\.\d+, \d+ threads?\.$/);
  assert.ok(await page.evaluate(() => crossOriginIsolated));
  assertSameBytes(await shown(), readPng(join(demo, 'view_+0.0_+0.0.png')).data);
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
  await andFull(() => page.selectOption('#shape', 'pentagon'));
  assertSameBytes(await shown(), refocusByProgram(
      demo, '--focus-at', place('far').join(), '--aperture', '0.25', '--highlights', '4', '--shape', 'polygon:5'));
  await andFull(() => setSlider('highlights', 0));
  await andFull(() => page.selectOption('#shape', 'soft'));
  await andFull(() => setSlider('f-stop', 0));
});

test('of many changes of the focus the last one counts', async () => {
  await page.evaluate(async () => {
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
  const {data, width} = readPng(join(demo, 'view_+0.0_+0.0.png'));
  const wiped = await shown();
  assertSameBytes(wiped.subarray(0, 3 * (width - 2)), data.subarray(0, 3 * (width - 2)));
  await setSlider('wipe', 50);
  await screenshot('wipe');
  await setSlider('wipe', 0);
});

test('pulls the focus, and stops when asked', async () => {
  await andFull(() => page.click('#pull'));
  await page.click('#pull');
  await page.waitForTimeout(300);
  assert.equal(await page.getAttribute('#pull', 'aria-pressed'), 'true');
  await andFull(() => page.click('#pull'));
  assert.equal(await page.getAttribute('#pull', 'aria-pressed'), 'false');
});

test('gives a JPEG', async () => {
  const [download] = await Promise.all([page.waitForEvent('download'), page.click('#download')]);
  assert.equal(download.suggestedFilename(), 'starfocus.jpg');
  const bytes = readFileSync(await download.path());
  assert.deepEqual([...bytes.subarray(0, 3)], [0xFF, 0xD8, 0xFF]);
  assert.ok(bytes.length > 50000);
});

test('keys focus, and every control says what it is', async () => {
  await page.focus('#picture');
  for (const key of ['ArrowLeft', 'ArrowUp', 'Shift+ArrowUp']) await page.keyboard.press(key);
  assert.match(await status(), /^Cross at 49 % from the left, 41 % from the top\.$/);
  await andFull(() => page.keyboard.press('Enter'));
  await page.keyboard.press('Escape');
  const at = await page.evaluate(() => {
    const {width, height} = document.getElementById('picture');
    return [(width >> 1) - 8, (height >> 1) - 72];
  });
  assertSameBytes(await shown(), refocusByProgram(demo, '--focus-at', at.join()));
  const heard = await page.locator('body').ariaSnapshot();
  for (const control of [/slider "Focus/, /slider "F-stop/, /slider "Highlights/, /combobox "Aperture"/, /radio "Depth"/,
                         /slider "Before and after/, /button "Pull focus"/, /status/]) {
    assert.match(heard, control);
  }
  const unnamed = await page.evaluate(() => [...document.querySelectorAll('main input:not([hidden]), select, button')]
      .filter(control => !control.labels?.length && !control.textContent.trim()).length);
  assert.equal(unnamed, 0);
});

test('opens what is dropped', async () => {
  const names = ['view_+0.0_+0.0', 'view_+1.0_+0.0', 'view_-1.0_+0.0', 'view_+0.0_+1.0', 'view_+0.0_-1.0'];
  await openFiles(...names.map(name => file(`${name}.png`)), file('disparity.pfm'));
  await waitFor(/^Opened: light field of 5 views, 320 x 240/);
  await tap(100, 120);
  assertSameBytes(await shown(), refocusByProgram(small, '--focus-at', '100,120'));
  await page.setInputFiles('#folder', small);
  await waitFor(/^Opened: light field of 5 views, 320 x 240/);
  const photo = file('photo.png', file('view_+0.0_+0.0.png').buffer);
  await openFiles(photo, file('map.pfm', file('disparity.pfm').buffer));
  await waitFor(/^Opened: photo\.png with map\.pfm/);
  await tap(100, 120);
  assertSameBytes(await shown(), refocusByProgram(small, '--focus-at', '100,120', '--views', '1'));
  const gray = await page.evaluate(async () => {
    const canvas = new OffscreenCanvas(64, 48), context = canvas.getContext('2d');
    for (let x = 0; x < 64; ++x) {
      context.fillStyle = `rgb(${x * 4} ${x * 4} ${x * 4})`;
      context.fillRect(x, 0, 1, 48);
    }
    const bytes = async type => [...new Uint8Array(await (await canvas.convertToBlob({type})).arrayBuffer())];
    return {png: await bytes('image/png'), jpeg: await bytes('image/jpeg')};
  });
  await openFiles(photo, file('depth.png', Buffer.from(gray.png)));
  await waitFor(/^Opened: photo\.png with depth\.png/);
  await tap(300, 120);
  const phone = makeGDepth(Buffer.from(gray.jpeg), Buffer.from(gray.png));
  await page.evaluate(bytes => {
    const transfer = new DataTransfer();
    transfer.items.add(new File([new Uint8Array(bytes)], 'phone.jpg'));
    dispatchEvent(new DragEvent('drop', {dataTransfer: transfer, cancelable: true}));
  }, [...phone]);
  await waitFor(/^Opened: depth photo phone\.jpg, 64 x 48/);
  await tap(10, 10);
});

test('refuses what it cannot read in a sentence, and keeps what was open', async () => {
  const centre = file('view_+0.0_+0.0.png'), pfm = readFileSync(join(small, 'disparity.pfm'));
  const jpeg = Buffer.from('ffd8ffe000104a46494600010100000100010000ffd9', 'hex');
  const broken = makeGDepth(jpeg, Buffer.from('nothing'));
  const refused = [
    [[file('photo.jpg', jpeg)], /photo\.jpg contains no depth map\. Drop a depth photo/],
    [[file('broken.jpg', broken)], /broken\.jpg is not a picture that this browser can read\./],
    [[file('cut.png', centre.buffer.subarray(0, 500)), file('disparity.pfm')], /cut\.png is not a picture that this browser can read\./],
    [[file('a.png', centre.buffer), file('map.pfm', pfm.subarray(0, 5000))], /map\.pfm is truncated: 320 x 240 values need/],
    [[file('a.png', centre.buffer), file('map.pfm', jpeg)], /map\.pfm is not a depth map/],
    [[file('phone.heic', jpeg), file('depth.png', centre.buffer)], /phone\.heic is a HEIC picture, which this browser cannot read\./],
    [[file('input_Cam000.png', jpeg), file('parameters.cfg', jpeg)], /HCI benchmark/],
    [[file('out_00_00_-1_1_.png', jpeg)], /Stanford archive/],
    [[centre, file('view_+1.0_+0.0.png'), file('view_-1.0_+0.0.png')], /no disparity\.pfm/],
    [[file('view_+1.0_+0.0.png'), file('view_-1.0_+0.0.png')], /no centre view/],
    [[file('disparity.pfm')], /depth map without its picture/],
    [[1, 2, 3].map(i => file(`${i}.png`, jpeg)), /found 3 files/]
  ];
  for (const [files, message] of refused) {
    await openFiles(...files);
    assert.match(await error(), message);
    await waitFor(/^Still open: depth photo phone\.jpg\.$/);
  }
  await screenshot('error');
});

test('fits a phone', async () => {
  await page.click('#open-demo');
  await waitFor(/^Opened: the demo/);
  await page.setViewportSize({width: 390, height: 844});
  await tap(...place('middle'));
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
  const small = await page.evaluate(() => [...document.querySelectorAll('button, select')]
      .filter(control => control.getBoundingClientRect().height < 40).length);
  assert.equal(small, 0);
  await screenshot('phone');
  await page.setViewportSize({width: 1280, height: 860});
});

test('50 refocusings leak nothing', async () => {
  const session = await browser.newBrowserCDPSession(), own = await page.context().newCDPSession(page);
  const memory = async () => {
    await own.send('HeapProfiler.collectGarbage');
    await page.waitForTimeout(200);
    const {processInfo} = await session.send('SystemInfo.getProcessInfo');
    const sizes = processInfo.filter(({type}) => type === 'renderer').map(
        ({id}) => Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${id}/status`, 'utf8'))[1]) / 1024);
    return Math.max(...sizes);
  };
  const foci = async count => {
    for (let i = 0; i < count; ++i) await andFull(() => setSlider('focus', -8 + i % 16));
  };
  await foci(10);
  const first = await memory();
  await foci(50);
  const last = await memory();
  console.log(`# renderer: ${first.toFixed(0)} MiB after 10 refocusings, ${last.toFixed(0)} after 60`);
  assert.ok(last < first + 30, `${first} MiB grew to ${last}`);
});

test('works offline once it is loaded', async () => {
  await page.context().setOffline(true);
  await tap(...place('near'));
  await page.context().setOffline(false);
});

test('without shared memory: one thread, the same picture', async () => {
  await page.close();
  await load(await serve('plain'));
  assert.equal(await page.evaluate(() => crossOriginIsolated), false);
  assert.match(await page.textContent('#engine'), /, 1 thread\.$/);
  await tap(...place('near'));
  assertSameBytes(await shown(), refocusByProgram(demo, '--focus-at', place('near').join()));
  assert.equal(servers.problem, undefined);
});

test('without SIMD: one sentence', {skip: process.arch !== 'x64'}, async () => {
  await browser.close();
  browser = await launch('--js-flags=--no-enable-sse4-1');
  page = await browser.newPage();
  await page.goto(address);
  assert.match(await error(), /WebAssembly has no SIMD here/);
});
