// SPDX-License-Identifier: Apache-2.0
// Drives the page in Chromium for the tests of the page: servers, loading, taps, sliders, files, and the pixels of the
// canvas. The tests share one page, `driver.page`.

import assert from 'node:assert/strict';
import {spawn} from 'node:child_process';
import {cpSync, mkdtempSync, readFileSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {dirname, join} from 'node:path';
import {chromium} from 'playwright-core';
import sharp from 'sharp';

import {dropAlpha, folder as small} from './pictures.mjs';

export const site = process.env.STARFOCUS_SITE;
export const sources = join(dirname(process.env.STARFOCUS_SERVER), '..', '..');
const scratch = mkdtempSync(join(tmpdir(), 'starfocus-web-'));
const servers = [];

export const driver = {browser: null, page: null, address: '', problem: undefined};

/** Starts a server for the site, and returns the address of the server. */
export async function serve(...values) {
  const server = spawn(process.execPath, [process.env.STARFOCUS_SERVER, site, '0', ...values]);
  servers.push(server);
  return new Promise(resolve => server.stdout.once('data', line => resolve(String(line).trim())));
}

export const launch = (...args) => chromium.launch({executablePath: '/usr/bin/chromium', args: ['--no-sandbox', ...args]});

export async function end() {
  await driver.browser?.close();
  servers.forEach(server => server.kill());
}

/** Writes the demo of the page as a light-field folder of the program, and returns the folder. */
export async function makeDemoFolder() {
  const demo = join(site, 'demo'), folder = join(scratch, 'demo');
  cpSync(demo, folder, {recursive: true});
  const {scale, offset} = JSON.parse(readFileSync(join(demo, 'disparity.json')));
  const {data, info: {width, height}} = await sharp(join(demo, 'disparity.png')).raw().toBuffer({resolveWithObject: true});
  const pfm = Buffer.alloc(4 * width * height);
  for (let i = 0; i < width * height; ++i) {  // the bottom row of a PFM is first
    const row = height - 1 - Math.trunc(i / width), code = data[3 * i] << 8 | data[3 * i + 1];
    pfm.writeFloatLE(code * scale + offset, 4 * (row * width + i % width));
  }
  writeFileSync(join(folder, 'disparity.pfm'), Buffer.concat([Buffer.from(`Pf\n${width} ${height}\n-1.0\n`), pfm]));
  return folder;
}

/** Returns the pixel [x, y] of a named object in the demo, from the demo's meta.txt. */
export const place = name => /(\d+),(\d+)/.exec(readFileSync(join(site, 'demo', 'meta.txt'), 'utf8').split('\n')
    .find(line => line.startsWith(`${name}:`))).slice(1).map(Number);

export const status = () => driver.page.textContent('#status');
export const error = () => driver.page.locator('#error:visible').textContent({timeout: 20000});

export async function waitFor(pattern, page = driver.page) {
  try {
    await page.waitForFunction(([source]) => RegExp(source).test(document.getElementById('status').textContent),
                               [pattern.source], {timeout: 60000, polling: 20});
  } catch {
    assert.fail(`expected a status like ${pattern}, found '${await page.textContent('#status')}' '${await page.textContent('#error')}'`);
  }
}

/** Waits until the page shows a full picture, which implies that all earlier requests have finished. */
export const full = () => waitFor(/Full picture: [\d.]+ ms$/);

/** Performs an action that changes the status, and waits for the status. */
export async function andWait(action, pattern) {
  await driver.page.evaluate(() => document.getElementById('status').textContent = '');
  await action();
  await waitFor(pattern);
}

export const andFull = action => andWait(action, /Full picture: [\d.]+ ms$/);

/** Returns the R, G, B bytes of the canvas. */
export async function shown() {
  const {page} = driver;
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

/** Taps on a pixel of the canvas, and waits for the full picture. */
export async function tap(x, y) {
  const {page} = driver;
  const at = await page.evaluate(([x, y]) => {
    const canvas = document.getElementById('picture');
    canvas.scrollIntoView({block: 'center'});
    const box = canvas.getBoundingClientRect();
    const scale = Math.min(box.width / canvas.width, box.height / canvas.height);
    return [
      box.left + (box.width - canvas.width * scale) / 2 + (x + .5) * scale,
      box.top + (box.height - canvas.height * scale) / 2 + (y + .5) * scale
    ];
  }, [x, y]);
  await andFull(() => page.mouse.click(...at));
}

/** Moves a slider to a value, or to an end: 'min' or 'max'. */
export const setSlider = (id, value) => driver.page.locator(`#${id}`).evaluate((slider, value) => {
  slider.value = slider[value] ?? value;
  slider.dispatchEvent(new Event('input', {bubbles: true}));
}, String(value));

export const choose = what => driver.page.check(`input[name=show][value=${what}]`);

/** Shows the depth instead of a picture, and returns its R, G, B bytes. The picture is visible until the depth arrives. */
export async function shownDepth() {
  await choose('picture');
  const picture = await shown(), end = Date.now() + 20000;
  await choose('depth');
  for (;;) {
    const depth = await shown();
    if (Buffer.compare(depth, picture) !== 0) return depth;
    assert.ok(Date.now() < end, 'expected the depth within 20 s, found the picture');
  }
}

export const focusText = () => driver.page.getAttribute('#focus', 'aria-valuetext');
export const screenshot = (name, page = driver.page) =>
    page.screenshot({path: join(process.env.STARFOCUS_SCREENSHOTS, `${name}.png`)});
export const file = (name, buffer = readFileSync(join(small, name))) => ({name, mimeType: '', buffer});
export const openFiles = (...files) => driver.page.setInputFiles('#files', files);

/** Makes a JPEG photo of coloured rectangles, and a grey PNG of its depth, which is a ramp from left to right. */
export async function drawPhoto(width, height, quality = 90) {
  const across = Math.min(width, 800), down = Math.min(height, 600);
  const photo = Buffer.alloc(3 * width * height), ramp = Buffer.alloc(across * down, 0);
  for (let i = 0; i < photo.length; ++i) {
    const x = Math.trunc(i / 3) % width, y = Math.trunc(i / (3 * width));
    photo[i] = Math.trunc(50 * x / width) * 89 + Math.trunc(50 * y / height) * 151 + i % 3 * 61;
  }
  for (let i = 0; i < ramp.length; ++i) ramp[i] = Math.round(255 * (i % across) / (across - 1));
  return {
    jpeg: await sharp(photo, {raw: {width, height, channels: 3}}).jpeg({quality}).toBuffer(),
    png: await sharp(ramp, {raw: {width: across, height: down, channels: 1}}).png().toBuffer()
  };
}

export async function load(url, options = {}) {
  driver.page = await driver.browser.newPage({viewport: {width: 1280, height: 860}, ...options});
  driver.page.on('pageerror', problem => driver.problem = problem);
  await driver.page.goto(url);
  await waitFor(/^Opened: the demo/);
}

/** Performs an action while the site has no files in one of its folders. */
export async function without(folder, action) {
  const context = driver.page.context(), pattern = `**/${folder}/*`;
  await context.route(pattern, route => route.fulfill({status: 404}));
  await action();
  await context.unroute(pattern);
}

/** Performs an action in a page of a new context, and closes the context. */
export async function inNewPage(prepare, action) {
  const before = driver.page, context = await driver.browser.newContext();
  try {
    await prepare(context);
    driver.page = await context.newPage();
    await driver.page.goto(driver.address);
    await action(driver.page);
  } finally {
    await context.close();
    driver.page = before;
  }
}

/** Opens the page in a new context, performs an action, and closes the context. */
export async function visit(options, action) {
  const before = driver.page;
  try {
    await load(driver.address, options);
    await action(driver.page);
  } finally {
    await driver.page.context().close();
    driver.page = before;
  }
}
