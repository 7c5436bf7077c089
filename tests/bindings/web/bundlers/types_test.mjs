// SPDX-License-Identifier: Apache-2.0
// Compiles programs that use the types of the package with several versions of TypeScript, libraries and ways of
// resolving modules. Also checks the packed package with attw and publint. STARFOCUS_PACKAGE is the packed package.

import assert from 'node:assert/strict';
import {cpSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {describe, test} from 'node:test';

import {copyTemplate, modules, run} from './projects.mjs';

const AT_ONCE = 2;  // compilations that run in parallel
const LIBRARIES = {
  browsers: {lib: ['es2022', 'dom'], files: ['core.ts', 'dom.ts']},
  'no environment': {lib: ['es2022'], files: ['core.ts']},
  node: {lib: ['es2022', 'esnext.disposable'], types: ['node'], files: ['core.ts', 'node.ts']},
  'browsers with using': {lib: ['es2022', 'esnext.disposable', 'dom'], files: ['dom.ts', 'using.ts'], only: 'bundler'}
};
const RESOLUTIONS = {
  bundler: {module: 'esnext', files: ['common.cts']}, nodenext: {module: 'nodenext', files: ['common.cts', 'require.cts']},
  node10: {module: 'commonjs', files: ['common.cts', 'require.cts']}
};
const COMPILERS = ['5.4', '5.9', '7.0'];
const OLD_NODE_TYPES = {5.4: 'types-node-20'};  // newer types of node need TypeScript 5.7 or newer

async function compile(version, library, resolution) {
  const folder = copyTemplate('types', `types-${version}-${library.replaceAll(' ', '-')}-${resolution}`);
  const old = OLD_NODE_TYPES[version];
  if (old) cpSync(join(modules, old), join(folder, 'node_modules/@types/node'), {recursive: true});
  const {files, lib, types = []} = LIBRARIES[library], {module, files: more} = RESOLUTIONS[resolution];
  writeFileSync(join(folder, 'tsconfig.json'), JSON.stringify({
    compilerOptions: {
      strict: true, noEmit: true, target: 'es2022', module, moduleResolution: resolution, lib, types
    },
    files: [...files, ...more]
  }));
  await run(folder, ['node', join(modules, `typescript-${version}`, 'bin/tsc'), '-p', '.']);
}

describe('strict compilation with TypeScript', {concurrency: AT_ONCE}, () => {
  for (const version of COMPILERS) {
    for (const [library, {only}] of Object.entries(LIBRARIES)) {
      for (const resolution of Object.keys(RESOLUTIONS)) {
        if (only && resolution !== only) continue;
        if (version === '7.0' && resolution === 'node10') continue;  // TypeScript 7 has no node10
        test(`${version}, ${resolution}, ${library}`, () => compile(version, library, resolution));
      }
    }
  }
});

test('attw finds no problem', () => run('.', ['attw', process.env.STARFOCUS_PACKAGE]));

test('publint finds no problem', async () => {
  const output = await run('.', ['publint', '--strict', process.env.STARFOCUS_PACKAGE]);
  assert.match(output, /All good!/);
});
