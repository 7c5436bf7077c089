// SPDX-License-Identifier: Apache-2.0
// Builds the README's example with vite in production, runs the page in Chromium with and without shared memory, and
// runs the README's example for node. All pictures must have the bytes that node computes from the same pixels. Also
// compiles programs that use the types of the package, and checks the packed package with attw and publint.

import assert from 'node:assert/strict';
import {execFile} from 'node:child_process';
import {mkdirSync, readFileSync, writeFileSync} from 'node:fs';
import {join, resolve} from 'node:path';
import {after, before, test} from 'node:test';
import {promisify} from 'node:util';
import {chromium} from 'playwright-core';
import sharp from 'sharp';
import {openPhoto} from 'starfocus';
import {build, createLogger, preview} from 'vite';

const ISOLATION = {'Cross-Origin-Opener-Policy': 'same-origin', 'Cross-Origin-Embedder-Policy': 'require-corp'};
const LIMIT = 60000;  // ms

// A photo with depth. The near half of the depth is bright, and it is the lower half, as in most photos. The photo is a
// checkerboard on a gradient, so that blur changes many bytes.
const width = 160, height = 120, point = {x: 80, y: 90};
const places = Array.from({length: width * height}, (_, i) => [i % width, Math.trunc(i / width)]);
const photo = {data: Uint8Array.from(places.flatMap(([x, y]) => {
  const light = ((x >> 2) + (y >> 2)) % 2 ? 200 : 40;
  return [light, (light + x) % 256, (light + 2 * y) % 256];
})), width, height};
const depth = {data: Uint8Array.from(places, ([, y]) => y < height / 2 ? 30 : 200), width, height};

/** The blocks of JavaScript in the README: the example for browsers, and the example for node. */
const examples = [...readFileSync('node_modules/starfocus/README.md', 'utf8').matchAll(/```js\n(.*?)```/gs)].map(([, code]) => code);

const closers = [];  // functions that end servers and the browser
let browser, expected;

/** Runs a program of the tools in node. Returns what the program prints. */
async function run(...values) {
  try {
    const {stdout, stderr} = await promisify(execFile)(process.execPath, values);
    return stdout + stderr;
  } catch (error) {
    assert.fail(`${values.join(' ')}: ${error.message}\n${error.stdout}`);
  }
}

/** Refocuses as the README's examples do, with one thread. */
async function refocus(picture, map, place) {
  const opened = await openPhoto(picture, map, {threads: 1});
  const {data} = await opened.refocus({focus: await opened.focusAt(place), fStop: 2});
  opened.close();
  return Buffer.from(data);
}

/** Writes photo.png and depth.png, which have exactly the pixels of the photo. */
async function writePictures(folder) {
  mkdirSync(folder, {recursive: true});
  await sharp(photo.data, {raw: {width, height, channels: 3}}).png().toFile(join(folder, 'photo.png'));
  await sharp(depth.data, {raw: {width, height, channels: 1}}).png().toFile(join(folder, 'depth.png'));
}

/** Builds a page with this script. Returns the folder of the page's files. The README's example finds the elements of the
 *  page by their ids, which browsers define as global variables. */
async function buildPage(name, script) {
  const root = resolve(name), warnings = [], logger = createLogger('warn');
  await writePictures(join(root, 'public'));
  writeFileSync(join(root, 'main.js'), script);
  writeFileSync(join(root, 'index.html'), `<!doctype html><title>starfocus</title>
      <img id="image" src="photo.png" alt="photo"><img id="depth" src="depth.png" alt="depth">
      <canvas id="canvas" width="${width}" height="${height}"></canvas><script type="module" src="/main.js"></script>`);
  logger.warn = logger.warnOnce = logger.error = message => warnings.push(message);
  await build({root, configFile: false, customLogger: logger});
  assert.deepEqual(warnings, []);
  return join(root, 'dist');
}

/** Serves a folder with these headers, and opens its page. Returns the page, and a list of the errors that it reports. */
async function openPage(folder, headers) {
  const server = await preview({
    root: folder, configFile: false, logLevel: 'error', appType: 'mpa', build: {outDir: '.'},
    preview: {host: '127.0.0.1', port: 0, headers}
  });
  closers.push(() => server.close());
  const page = await browser.newPage(), problems = [];
  page.on('pageerror', error => problems.push(error.message));
  page.on('console', message => message.type() === 'error' && !/favicon/.test(message.location().url) &&
      problems.push(message.text()));
  await page.goto(`http://localhost:${server.httpServer.address().port}/`);
  return {page, problems};
}

/** Returns the number of threads that the package uses in a page. */
const threadsOf = (page, isolated) => isolated ? page.evaluate(() => navigator.hardwareConcurrency) : 1;

before(async () => {
  browser = await chromium.launch({executablePath: '/usr/bin/chromium', args: ['--no-sandbox']});
  closers.push(() => browser.close());
  expected = await refocus(photo, depth, point);
});
after(async () => {
  for (const close of closers.reverse()) await close();
});

test('the example runs in a page that vite builds without warnings', async () => {
  const site = await buildPage('example', examples[0]);
  for (const isolated of [false, true]) {
    const {page, problems} = await openPage(site, isolated ? ISOLATION : {});
    const describe = message => `${message}; errors of the page: ${problems.join('; ') || 'none'}`;
    await page.waitForFunction(() => document.getElementById('canvas').onclick, undefined, {timeout: LIMIT})
        .catch(() => assert.fail(describe('the example did not open the photo')));
    assert.equal(await page.evaluate(() => crossOriginIsolated), isolated);
    assert.equal(page.workers().length, await threadsOf(page, isolated), 'number of workers');
    await page.click('#canvas', {position: point});
    const read = () => page.evaluate(() => {
      const {data} = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
      return btoa(String.fromCharCode(...data));
    });
    for (const end = Date.now() + LIMIT; !expected.equals(Buffer.from(await read(), 'base64'));) {
      assert.ok(Date.now() < end, describe('the canvas does not have the picture of node'));
      await page.waitForTimeout(50);
    }
    assert.deepEqual(problems, []);
  }
});

test('without blob workers, the option worker helps', async () => {
  const policy = {'Content-Security-Policy': `script-src 'self' 'wasm-unsafe-eval'; worker-src 'self'`};
  const site = await buildPage('policy', `import {openPhoto} from 'starfocus';
      import worker from 'starfocus/worker?url';  // vite copies the file, and returns its address
      Object.assign(globalThis, {openPhoto, worker});`);
  const open = (page, hasWorker) => page.evaluate(async hasWorker => {
    try {
      const opened = await openPhoto(image, depth, hasWorker ? {worker} : {});
      const {data} = await opened.refocus({focus: await opened.focusAt({x: 80, y: 90}), fStop: 2});
      return {threads: opened.threads, bytes: btoa(String.fromCharCode(...data))};
    } catch ({code, message}) {
      return {code, message};
    }
  }, hasWorker);
  for (const isolated of [false, true]) {
    const {page} = await openPage(site, {...policy, ...isolated ? ISOLATION : {}});
    const {threads, bytes, message} = await open(page, true);
    assert.equal(message, undefined);
    assert.ok(expected.equals(Buffer.from(bytes, 'base64')));
    assert.equal(threads, await threadsOf(page, isolated));
    const failed = await open(page, false);
    assert.equal(failed.code, 'WORKER');
    assert.match(failed.message, /Content-Security-Policy.* serve starfocus\/worker .*option worker/);
  }
});

test('the example for node, with sharp', async () => {
  await sharp(photo.data, {raw: {width, height, channels: 3}}).jpeg().toFile('photo.jpg');
  await sharp(depth.data, {raw: {width, height, channels: 1}}).png().toFile('depth.png');
  writeFileSync('example.mjs', examples[1]);
  await run('example.mjs');
  const data = await sharp('refocused.png').raw().toBuffer(), jpeg = await sharp('photo.jpg').raw().toBuffer();
  assert.ok(data.equals(await refocus({data: jpeg, width, height}, depth, {x: width / 2, y: height / 2})));
});

// The environment of each program that uses the types. `none` is a folder of types that does not exist.
const PROGRAMS = {
  'types.ts': ['--lib', 'es2022', '--typeRoots', 'none'],
  'types_environments.ts': ['--lib', 'es2022,esnext.disposable,dom', '--types', 'node']
};
for (const [file, options] of Object.entries(PROGRAMS)) {
  test(`${file} compiles strictly`, () => run('../node_modules/typescript/bin/tsc', '--strict', '--noEmit', '--target', 'es2022',
                                              '--module', 'nodenext', ...options, file));
}

test('attw and publint find no problem', async () => {
  await run('../node_modules/.bin/attw', process.env.STARFOCUS_PACKAGE);
  assert.match(await run('../node_modules/.bin/publint', '--strict', process.env.STARFOCUS_PACKAGE), /All good!/);
});
