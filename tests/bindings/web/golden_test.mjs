// SPDX-License-Identifier: Apache-2.0
// Checks that the package computes the same bytes as the library, by all checksums of tests/lib/golden.txt. The
// names in that file encode the light field and the lens, as tests/lib/golden_bytes_test.cc defines them.

import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import test from 'node:test';
import {createRefocuser, Mode, Renderer, Shape, Transfer} from 'starfocus';

import {dropAlpha} from './pictures.mjs';

// Light fields that are computed with integers only, as by tests/support/scenes.h.

const mask = 0xFFFFFFFFFFFFFFFFn;

/** Random numbers by xorshift64*, with the same sequence as test::Random. */
class Random {
  constructor(seed) {
    this.state = (BigInt(seed) * 0x9E3779B97F4A7C15n + 0x1234567n) & mask;
  }

  next() {
    let state = this.state;
    state ^= state >> 12n;
    state ^= (state << 25n) & mask;
    state ^= state >> 27n;
    this.state = state;
    return Number(((state * 0x2545F4914F6CDD1Dn) & mask) >> 32n);
  }

  /** Returns an integer in [low, high]. */
  int(low, high) {
    return low + this.next() % (high - low + 1);
  }
}

const disparityAt = {
  layers: (x, y) => {
    const near = (Math.trunc(x / 19) + Math.trunc(y / 23)) % 3 === 0, middle = (2 * x + y) % 71 < 24;
    return (near ? 250 : middle ? 37 : -130) / 64;
  },
  slanted: (x, y) => (3 * x - 2 * y) / 160,
  noise: (x, y, random) => random.int(-21, 21) / 7
};

function makeIntegerScene(width, height, count, depth) {
  const random = new Random(10 * count + ['layers', 'slanted', 'noise'].indexOf(depth));
  const views = Array.from({length: count}, (_, view) => {
    const pixels = new Uint8Array(3 * width * height);
    for (let i = 0; i < pixels.length; ++i) {
      const c = i % 3, x = Math.trunc(i / 3) % width, y = Math.trunc(i / (3 * width));
      const shade = 5 * x + 3 * y * (c + 1) + 29 * view;
      const edge = (Math.trunc((x + 2 * view) / 9) + Math.trunc(y / 7)) % 2 * 90;
      pixels[i] = Math.trunc(shade / 4) % 126 + edge + random.int(0, 40);
    }
    return pixels;
  });
  const disparity = Float32Array.from(
      {length: width * height},
      (_, i) => disparityAt[depth](i % width, Math.trunc(i / width), random));
  return {width, height, views, disparity, low: -4, high: 4};
}

function makeLevelScene(side, levels, range) {
  const random = new Random(1000 * range + levels);
  const disparities = Array.from({length: levels}, () => random.int(-64 * range, 64 * range) / 64);
  const pixels = Uint8Array.from({length: 3 * side * side}, () => random.next() >>> 24);
  const disparity = Float32Array.from({length: side * side},
                                      () => disparities[random.int(0, levels - 1)]);
  return {width: side, height: side, views: [pixels], disparity, low: -range, high: range};
}

const modes = {frame: Mode.FRAME, benchmark: Mode.BENCHMARK, block: Mode.BLOCK, blur: Mode.BLUR};
const shapes = {
  'disc': {shape: Shape.DISC},
  'pentagon': {shape: Shape.POLYGON},
  'curved-hexagon': {shape: Shape.POLYGON, blades: 6, rotation: 17.5, curvature: 0.5},
  'ring': {shape: Shape.RING},
  'cats-eye': {catsEye: 0.75},
  'pentagon-cats-eye': {shape: Shape.POLYGON, catsEye: 0.5}
};
const apertures = {'1.125': 0.8, '2.5': 1, '-27.5': 1};  // apertures of the cases with a shape, by focus

const scenes = new Map();
function integerScene(views, depth) {
  const name = `${views}-${depth}`;
  if (!scenes.has(name)) scenes.set(name, makeIntegerScene(97, 70, views, depth));
  return scenes.get(name);
}

/** Returns the scene, configuration and parameters that a name in golden.txt encodes. */
function readCase(name) {
  const levels = /^levels-(\d+)-(\d+)-(\d+)$/.exec(name);
  if (levels) {
    const [count, range, block] = levels.slice(1).map(Number);
    return {
      scene: makeLevelScene(block, count, range),
      config: {superblock: block, nScale: 0.5},
      params: {mode: Mode.FRAME, focus: 0, aperture: 1, renderer: Renderer.SLICES}
    };
  }
  const number = '(-?[\\d.]+)', mode = `(${Object.keys(modes).join('|')})`;
  const plain = RegExp(`^(\\d+)-(\\w+)-${mode}-${number}-${number}-(\\d+)$`).exec(name);
  const shaped = RegExp(`^([a-z-]+)-${mode}-${number}-(\\d+)$`).exec(name);
  const [views, depth, modeName, focus, aperture, block] =
      plain?.slice(1) ?? [5, 'layers', shaped[2], shaped[3], apertures[shaped[3]], shaped[4]];
  return {
    scene: integerScene(Number(views), depth),
    transfer: depth === 'slanted' ? Transfer.NONE : Transfer.SRGB,
    config: {
      superblock: Number(block),
      gather: Number(views) !== 9
    },
    params: {
      mode: modes[modeName],
      focus: Number(focus),
      aperture: Number(aperture),
      renderer: Number(block) === 32 ? Renderer.LINE_SCAN : Renderer.AUTO,
      ...(shaped && shapes[shaped[1]])
    }
  };
}

/** Returns the 64-bit FNV-1a checksum. */
function hash(bytes) {
  let sum = 0xCBF29CE484222325n;
  for (const byte of bytes) sum = ((sum ^ BigInt(byte)) * 0x100000001B3n) & mask;
  return sum.toString(16).padStart(16, '0');
}

const golden = readFileSync(process.env.STARFOCUS_GOLDEN_FILE, 'utf8')
                   .trim().split('\n').map(line => line.split(' '));

/** Compares the pictures of cases. Consecutive cases share a refocuser if they have the same light field. */
async function compare(cases, options) {
  const wrong = [];
  let open, refocuser;
  try {
    for (const [name, expected] of cases) {
      const {scene, transfer, config, params} = readCase(name);
      if (scene !== open) {
        refocuser?.close();
        const {width, height, views, disparity, low, high} = open = scene;
        refocuser = await createRefocuser({
          width, height, views: views.length, disparityMin: low, disparityMax: high, maxBlur: 43, transfer, shapes: true, ...options
        });
        await refocuser.prepare(views, disparity);
      }
      await refocuser.configure({nScale: 1, ...config});
      if (hash(dropAlpha((await refocuser.refocus(params)).data)) !== expected) wrong.push(name);
    }
  } finally {
    refocuser?.close();  // without close(), the workers would keep node running
  }
  assert.ok(cases.length > 10);
  assert.deepEqual(wrong, []);
}

test('every checksum', () => compare(golden, {threads: 1}));
const some = golden.filter((_, i) => i % 5 === 0);
test('every fifth checksum with threads', () => compare(some, {threads: 3}));
