// SPDX-License-Identifier: Apache-2.0
// Builds the README's example with bundlers in production, and runs the results in Chromium, with and without shared
// memory, and in node. All pictures must have the bytes of the picture that node computes from the same pixels.

import assert from 'node:assert/strict';
import {copyFileSync, writeFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {join} from 'node:path';
import {after, before, describe, test} from 'node:test';
import sharp from 'sharp';
import {openPhoto} from 'starfocus';

import {checkPage, ISOLATION, openPage, serve, serveNext, start, stop} from './browser.mjs';
import {buildNext, buildWorkerPage, copyTemplate, examples, pages, run} from './projects.mjs';
import {depth, photo, point} from './scene.mjs';

const AT_ONCE = 2;  // builds that run in parallel

// Warnings that do not concern the package. webpack counts bytes before compression. The configuration of next for
// webpack has no support for `await` outside functions, as in the README's example, but next compiles the example.
const KNOWN = [
  /^WARNING in (asset size limit|entrypoint size limit|webpack performance recommendations): /m,
  /^webpack \S+ compiled with 3 warnings in/m, /^⚠ Compiled with warnings in .*\n\n\.\/example\.js\n.* "topLevelAwait"\.$/m
];

/** Refocuses as the README's examples do, with one thread. */
async function refocus(picture, map, place) {
  const opened = await openPhoto(picture, map, {threads: 1});
  const {data} = await opened.refocus({focus: await opened.focusAt(place), fStop: 2});
  opened.close();
  return Buffer.from(data);
}

function expectNoWarning(output) {
  const unknown = KNOWN.reduce((rest, text) => rest.replace(new RegExp(text, 'gm'), ''), output);
  assert.doesNotMatch(unknown, /warn|deprecat/i);
}

let expected;
before(async () => {
  await start();
  expected = await refocus(photo, depth, point);
});
after(stop);

describe('the example runs in the pages of', {concurrency: AT_ONCE}, () => {
  for (const [name, build] of Object.entries(pages)) {
    test(name, async () => {
      const {site, output} = await build();
      expectNoWarning(output);
      await checkPage(await serve(site), false, expected);
      await checkPage(await serve(site, ISOLATION), true, expected);
    });
  }
  for (const bundler of ['turbopack', 'webpack']) {
    test(`next with ${bundler}, and a route of its server refocuses`, async () => {
      const {folder, output} = await buildNext(bundler);
      expectNoWarning(output);
      const address = await serveNext(folder, createRequire(import.meta.url).resolve('next/dist/bin/next'));
      await checkPage(address, false, expected);
      await checkPage(`${address}isolated`, true, expected);
      const answer = await fetch(`${address}api/refocus`, {method: 'POST'});
      assert.ok(expected.equals(Buffer.from(await answer.arrayBuffer())));
    });
  }
});

describe('without blob workers, the option worker helps in pages of', {concurrency: AT_ONCE}, () => {
  const policy = {'Content-Security-Policy': `script-src 'self' 'wasm-unsafe-eval'; worker-src 'self'`};
  const open = (page, hasWorker) => page.evaluate(async hasWorker => {
    try {
      const opened = await openPhoto(image, depth, hasWorker ? {worker} : {});
      const {data} = await opened.refocus({focus: await opened.focusAt({x: 80, y: 90}), fStop: 2});
      return {threads: opened.threads, bytes: btoa(String.fromCharCode(...data))};
    } catch ({code, message}) {
      return {code, message};
    }
  }, hasWorker);
  for (const tool of ['files', 'vite', 'webpack']) {
    test(tool, async () => {
      const site = await buildWorkerPage(tool);
      for (const headers of [policy, {...policy, ...ISOLATION}]) {
        const {page} = await openPage(await serve(site, headers));
        const {threads, bytes, message} = await open(page, true);
        assert.equal(message, undefined);
        assert.ok(expected.equals(Buffer.from(bytes, 'base64')));
        assert.equal(threads, headers === policy ? 1 : await page.evaluate(() => navigator.hardwareConcurrency));
        const failed = await open(page, false);
        assert.equal(failed.code, 'WORKER');
        assert.match(failed.message, /Content-Security-Policy.* serve starfocus\/worker .*option worker/);
        await page.close();
      }
    });
  }
});

describe('node', {concurrency: AT_ONCE}, () => {
  const bundles = {
    'import.mjs': ['--format=esm', '--outfile=import.bundled.mjs'],
    'require.cjs': ['--format=cjs', '--outfile=require.bundled.cjs']
  };
  let folder;
  before(() => folder = copyTemplate('node', 'node'));
  for (const [script, options] of Object.entries(bundles)) {
    test(script, async () => {
      assert.ok(expected.equals(await run(folder, ['node', script], {encoding: 'buffer'})));
    });
    test(`${script}, bundled by esbuild`, async () => {
      const output = await run(folder, ['esbuild', script, '--bundle', '--platform=node', ...options]);
      expectNoWarning(output);
      const bundled = script.replace('.', '.bundled.');
      assert.ok(expected.equals(await run(folder, ['node', bundled], {encoding: 'buffer'})));
    });
  }

  test('the example with sharp', async () => {
    const files = copyTemplate('node', 'sharp'), {width, height} = photo;
    await sharp(photo.data, {raw: {width, height, channels: 3}}).jpeg().toFile(join(files, 'photo.jpg'));
    await sharp(depth.data, {raw: {width, height, channels: 1}}).png().toFile(join(files, 'depth.png'));
    writeFileSync(join(files, 'example.mjs'), examples[1]);
    await run(files, ['node', 'example.mjs']);
    const {data} = await sharp(join(files, 'refocused.png')).raw().toBuffer({resolveWithObject: true});
    const jpeg = await sharp(join(files, 'photo.jpg')).raw().toBuffer();
    assert.ok(data.equals(await refocus({data: jpeg, width, height}, depth, {x: width / 2, y: height / 2})));
  });
});
