// SPDX-License-Identifier: Apache-2.0
// Serves pages, and opens them in Debian's Chromium.

import assert from 'node:assert/strict';
import {spawn} from 'node:child_process';
import {chromium} from 'playwright-core';
import {preview} from 'vite';

import {point} from './scene.mjs';

const LIMIT = 60000;  // ms

export const ISOLATION = {'Cross-Origin-Opener-Policy': 'same-origin', 'Cross-Origin-Embedder-Policy': 'require-corp'};

const closers = [];  // functions that end servers and the browser
let browser;

export async function start() {
  browser = await chromium.launch({executablePath: '/usr/bin/chromium', args: ['--no-sandbox']});
  closers.push(() => browser.close());
}

export async function stop() {
  for (const close of closers.reverse()) await close();
}

/** Serves a folder with `vite preview` and these headers. Returns the address. */
export async function serve(folder, headers = {}) {
  const server = await preview({
    root: folder, configFile: false, logLevel: 'error', appType: 'mpa', build: {outDir: '.'},
    preview: {host: '127.0.0.1', port: 0, headers}
  });
  closers.push(() => server.close());
  return `http://localhost:${server.httpServer.address().port}/`;
}

/** Starts `next start` in a folder. Returns the address. */
export async function serveNext(folder, program) {
  const server = spawn(process.execPath, [program, 'start', '-p', '0', '-H', '127.0.0.1'], {
    cwd: folder, stdio: ['ignore', 'pipe', 'inherit'], env: {...process.env, NEXT_TELEMETRY_DISABLED: '1'}
  });
  closers.push(() => server.kill());
  const port = await new Promise((resolve, reject) => {
    server.stdout.on('data', text => {
      const found = /http:\/\/[\w.]+:(\d+)/.exec(text);
      if (found) resolve(found[1]);
    });
    server.on('exit', () => reject(new Error('next start ended without printing its address')));
  });
  return `http://localhost:${port}/`;
}

/** Opens a page. Returns the page and a list of the errors that the page reports. */
export async function openPage(address) {
  const page = await browser.newPage(), problems = [];
  page.on('pageerror', error => problems.push(error.message));
  page.on('console', message => message.type() === 'error' && !/favicon/.test(message.location().url) &&
      problems.push(message.text()));
  await page.goto(address);
  return {page, problems};
}

/** Returns the bytes of the canvas. */
async function readCanvas(page) {
  return Buffer.from(await page.evaluate(() => {
    const canvas = document.getElementById('canvas');
    const {data} = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    return btoa(String.fromCharCode(...data));
  }), 'base64');
}

/** Opens a page with the README's example, taps the canvas, and waits until the canvas has the expected bytes. */
export async function checkPage(address, isolated, expected) {
  const {page, problems} = await openPage(address);
  const describe = message => `${address}: ${message}; errors of the page: ${problems.join('; ') || 'none'}`;
  try {
    await page.waitForFunction(() => document.getElementById('canvas')?.onclick, undefined, {timeout: LIMIT});
  } catch {
    assert.fail(describe('the example did not open the photo'));
  }
  assert.equal(await page.evaluate(() => crossOriginIsolated), isolated);
  const cores = await page.evaluate(() => navigator.hardwareConcurrency);
  assert.equal(page.workers().length, isolated ? cores : 1, 'number of workers');
  await page.click('#canvas', {position: point});
  const end = Date.now() + LIMIT;
  while (!expected.equals(await readCanvas(page))) {
    assert.ok(Date.now() < end, describe('the canvas does not have the picture of node'));
    await page.waitForTimeout(50);
  }
  assert.deepEqual(problems, []);
  await page.close();
}
