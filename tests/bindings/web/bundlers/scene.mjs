// SPDX-License-Identifier: Apache-2.0
// A photo with depth as pixels, and the point that the tests focus at. The near half of the depth is bright, and it is
// the lower half, as in most photos.

const WIDTH = 160, HEIGHT = 120;

/** R, G, B of a pixel: a checkerboard on a gradient, so that blur changes many bytes. */
function colourOf(x, y) {
  const light = ((x >> 2) + (y >> 2)) % 2 ? 200 : 40;
  return [light, (light + x) % 256, (light + 2 * y) % 256];
}

const places = Array.from({length: WIDTH * HEIGHT}, (_, i) => [i % WIDTH, Math.trunc(i / WIDTH)]);

export const photo = {data: Uint8Array.from(places.flatMap(place => colourOf(...place))), width: WIDTH, height: HEIGHT};
export const depth = {data: Uint8Array.from(places, ([, y]) => y < HEIGHT / 2 ? 30 : 200), width: WIDTH, height: HEIGHT};
export const point = {x: 80, y: 90};
