// SPDX-License-Identifier: Apache-2.0
// Tests platform/web/worker/depth.js: the range of depth maps against sorted values, and the values of DEPTH16.

import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {dirname, join} from 'node:path';
import test from 'node:test';

const path = join(dirname(process.env.STARFOCUS_SERVER), '../../platform/web/worker/depth.js');
const {measureRobustly, writeDisparities} = await import(`data:text/javascript,${encodeURIComponent(readFileSync(path, 'utf8'))}`);

/** Checks the quantiles of 0.1 % and 99.9 % of the finite values, including the sign of zero. */
function check(data, channels = 1) {
  const values = data.filter((value, i) => i % channels === 0 && Number.isFinite(value)).sort();
  const beyond = Math.trunc((values.length - 1) / 1000);
  assert.deepStrictEqual(measureRobustly({data, channels}),
                         {low: values[beyond], high: values[values.length - 1 - beyond]});
}

test('the range of floats has the values of sorting', () => {
  const tiny = 2 ** -149, largest = 3.4028234663852886e38;
  check(Float32Array.of(0));
  check(Float32Array.of(-0, 0));
  check(Float32Array.of(0, -0, NaN));
  check(Float32Array.of(-tiny, tiny, -Infinity, Infinity, NaN, -NaN));
  check(Float32Array.of(largest, -largest, Infinity, -Infinity));
  check(Float32Array.of(-2, -1));
  check(Float32Array.of(NaN, 7, 7.000001));
  for (const scale of [1, 1e-3, 1e30]) {
    const wave = Float32Array.from({length: 5003}, (_, i) => i % 11 ? scale * Math.tan(i * i) : NaN);
    for (const shift of [0, 1000 * scale, -1000 * scale]) check(wave.map(value => value + shift));
    check(wave.subarray(1, 1003));
  }
});

test('the range of integers has the values of sorting', () => {
  const codes = Uint16Array.from({length: 6000}, (_, i) => i * i % 65536);
  check(codes);
  check(codes, 3);
  check(Uint8Array.from(codes), 4);
  check(Uint8Array.of(255));
});

test('values of DEPTH16 are distances below any confidence, and 0 is unknown', () => {
  for (let confidence = 0; confidence < 8; ++confidence) {
    const data = Uint16Array.of(...[0, 1, 500, 8191].map(distance => distance + 8192 * confidence));
    const disparities = new Float32Array(4);
    writeDisparities({data, scale: 1000, reciprocal: true, depth16: true}, disparities);
    assert.deepStrictEqual(disparities, Float32Array.of(NaN, 1000, 2, 1000 / 8191));
  }
});

test('a map without finite values has no range', () => {
  const {low, high} = measureRobustly({data: Float32Array.of(NaN, Infinity, -Infinity), channels: 1});
  assert.ok(low > high);
});
