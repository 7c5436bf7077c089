// SPDX-License-Identifier: Apache-2.0
// usage: bundle.mjs ESBUILD MODULE FOLDER
// Bundles the scripts of the npm package into FOLDER. MODULE is the WebAssembly module. starfocus.js contains the
// compressed module and the script of the worker; node.js contains the script of the worker for node.

import {execFileSync} from 'node:child_process';
import {mkdirSync, readFileSync, writeFileSync} from 'node:fs';
import {dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';
import {deflateSync} from 'node:zlib';

const [esbuild, module, folder] = process.argv.slice(2);
const sources = dirname(fileURLToPath(import.meta.url)), scratch = dirname(module);
const licence = '/*! SPDX-License-Identifier: Apache-2.0 */';

/** Bundles a source file. `options` are options of esbuild. */
function bundle(source, output, ...options) {
  execFileSync(esbuild, [
    join(sources, source), `--outfile=${output}`, '--bundle', '--minify', '--target=es2022', '--log-level=warning',
    `--banner:js=${licence}`, ...options
  ], {stdio: 'inherit'});
}

const path = name => join(process.cwd(), scratch, name);
const workerOptions = port => ['--format=iife', `--alias:worker-port=${join(sources, 'worker', port)}`];
const withWorker = file => [`--alias:worker-source=${file}`, '--loader:.txt=text'];

mkdirSync(folder, {recursive: true});
writeFileSync(path('module.deflated'), deflateSync(readFileSync(module), {level: 9}));
bundle('worker/worker.js', join(folder, 'worker/worker.js'), ...workerOptions('port.js'));
writeFileSync(path('worker.txt'), readFileSync(join(folder, 'worker/worker.js')));
bundle('worker/worker.js', path('worker_node.txt'), '--platform=node', ...workerOptions('port_node.js'));
bundle('api/starfocus.js', join(folder, 'starfocus.js'), '--format=esm', ...withWorker(path('worker.txt')),
       '--loader:.deflated=base64', `--alias:engine-module=${path('module.deflated')}`);
bundle('api/node.js', join(folder, 'node.js'), '--format=esm', '--platform=node', '--external:./starfocus.js',
       ...withWorker(path('worker_node.txt')));
bundle('api/starfocus.cjs', join(folder, 'starfocus.cjs'), '--format=cjs', '--external:#entry');
