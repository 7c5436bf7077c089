// SPDX-License-Identifier: Apache-2.0
// Makes the projects of the test in the current folder. Each project is a folder with the README's example, and has a
// command that builds the project.

import assert from 'node:assert/strict';
import {execFile} from 'node:child_process';
import {cpSync, mkdirSync, readFileSync, writeFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';
import {promisify} from 'node:util';
import sharp from 'sharp';

import {depth, photo} from './scene.mjs';

const templates = dirname(fileURLToPath(import.meta.url));
export const modules = join(templates, '..', 'node_modules');
export const installed = join(modules, 'starfocus');

/** The blocks of JavaScript in the README: the example for browsers, and the example for node. */
export const examples = [...readFileSync(join(installed, 'README.md'), 'utf8').matchAll(/```js\n(.*?)```/gs)]
    .map(([, code]) => code);

const raw = ({width, height}, channels) => ({raw: {width, height, channels}});

/** Writes photo.png and depth.png, which have exactly the pixels of the scene. */
export async function writePictures(folder) {
  mkdirSync(folder, {recursive: true});
  await sharp(photo.data, raw(photo, 3)).png().toFile(join(folder, 'photo.png'));
  await sharp(depth.data, raw(depth, 1)).png().toFile(join(folder, 'depth.png'));
}

/** Runs a program of node_modules/.bin, or node, in a folder. Returns what the program prints. */
export async function run(folder, [program, ...values], options = {}) {
  const path = program === 'node' ? process.execPath : join(modules, '.bin', program);
  try {
    const {stdout, stderr} = await promisify(execFile)(path, values, {
      cwd: folder, maxBuffer: 2 ** 26, ...options, env: {...process.env, NEXT_TELEMETRY_DISABLED: '1', NODE_ENV: undefined}
    });
    return options.encoding ? stdout : stdout + stderr;
  } catch (error) {
    assert.fail(`${program} ${values.join(' ')}: ${error.message}\n${error.stdout}`);
  }
}

/** Copies a template to a new folder of this name, together with the scene. Returns the folder. */
export function copyTemplate(template, name) {
  const folder = join(templates, 'projects', name);
  cpSync(join(templates, template), folder, {recursive: true});
  cpSync(join(templates, 'scene.mjs'), join(folder, 'scene.mjs'));
  return folder;
}

/** Makes a project whose entry src/index.js is the README's example, and whose page is dist/index.html. */
async function makePage(name) {
  const folder = copyTemplate('page', name), site = join(folder, 'dist');
  mkdirSync(join(folder, 'src'));
  writeFileSync(join(folder, 'src/index.js'), examples[0]);
  await writePictures(site);
  cpSync(join(folder, 'index.html'), join(site, 'index.html'));
  return {folder, site};
}

const COMMANDS = {
  webpack: ['webpack', '--mode', 'production'],
  esbuild: ['esbuild', 'src/index.js', '--bundle', '--minify', '--format=esm', '--outfile=dist/main.js'],
  rollup: ['rollup', 'src/index.js', '-p', '@rollup/plugin-node-resolve', '-f', 'es', '-o', 'dist/main.js']
};

async function bundlePage(name) {
  const {folder, site} = await makePage(name);
  return {site, output: await run(folder, COMMANDS[name])};
}

async function scriptPage() {
  const {folder, site} = await makePage('script');
  cpSync(join(folder, 'src/index.js'), join(site, 'main.js'));
  cpSync(join(installed, 'starfocus.js'), join(site, 'starfocus.js'));
  return {site, output: ''};
}

async function vitePage() {
  const folder = copyTemplate('vite', 'vite');
  writeFileSync(join(folder, 'example.js'), examples[0]);
  await writePictures(join(folder, 'public'));
  return {site: join(folder, 'dist'), output: await run(folder, ['vite', 'build'])};
}

/** Functions that build pages. Each returns the folder of the page's files, and what the tool printed. */
export const pages = {
  script: scriptPage, vite: vitePage, webpack: () => bundlePage('webpack'), esbuild: () => bundlePage('esbuild'),
  rollup: () => bundlePage('rollup')
};

/** Builds a project of next with a bundler, 'turbopack' or 'webpack'. */
export async function buildNext(bundler) {
  const folder = copyTemplate('next', `next-${bundler}`);
  writeFileSync(join(folder, 'example.js'), examples[0]);
  await writePictures(join(folder, 'public'));
  return {folder, output: await run(folder, ['next', 'build', ...(bundler === 'webpack' ? ['--webpack'] : [])])};
}

/** Makes the page of csp/ with a tool, which decides how the page refers to starfocus/worker. Returns the folder of the
 *  page's files. */
export async function buildWorkerPage(tool) {
  const folder = copyTemplate('csp', `csp-${tool}`), site = join(folder, 'dist');
  await writePictures(tool === 'vite' ? join(folder, 'public') : site);
  if (tool === 'vite') {
    cpSync(join(folder, 'vite.js'), join(folder, 'main.js'));
    await run(folder, ['vite', 'build']);
    return site;
  }
  cpSync(join(folder, 'index.html'), join(site, 'index.html'));
  if (tool === 'webpack') {
    await run(folder, ['webpack', '--mode', 'production', '--entry', './webpack.js']);
    return site;
  }
  cpSync(join(folder, 'files.js'), join(site, 'main.js'));
  cpSync(join(installed, 'starfocus.js'), join(site, 'starfocus.js'));
  cpSync(createRequire(import.meta.url).resolve('starfocus/worker'), join(site, 'worker.js'));
  return site;
}
