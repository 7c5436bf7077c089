// SPDX-License-Identifier: Apache-2.0
// JavaScript version of tests/support/integer_scene.h: light fields that are computed with integers only.

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

export function makeIntegerScene(width, height, count, depth) {
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

export function makeLevelScene(side, levels, range) {
  const random = new Random(1000 * range + levels);
  const disparities = Array.from({length: levels}, () => random.int(-64 * range, 64 * range) / 64);
  const pixels = Uint8Array.from({length: 3 * side * side}, () => random.next() >>> 24);
  const disparity = Float32Array.from({length: side * side},
                                      () => disparities[random.int(0, levels - 1)]);
  return {width: side, height: side, views: [pixels], disparity, low: -range, high: range};
}
