// SPDX-License-Identifier: Apache-2.0
// Reduces photos that are larger than a canvas may be on phones.

import {call} from './pixels.js';

const MOST = 2 ** 24;  // pixels: the largest canvas of iOS before version 18

/** Returns a depth map with the nearest values for a picture of another size. `factor` converts disparities. */
function sample({data, width, height}, across, down, factor) {
  const result = new data.constructor(across * down);
  for (let y = 0, i = 0; y < down; ++y) {
    const row = Math.trunc((y + 0.5) * height / down) * width;
    for (let x = 0; x < across; ++x) result[i++] = factor * data[row + Math.trunc((x + 0.5) * width / across)];
  }
  return {data: result, width: across, height: down};
}

/** Returns what open() of open.js found, with a photo of at most MOST pixels and a depth map that is not larger. No
 *  canvas is needed for this. */
export async function reduce(found) {
  const {bitmap, images, depth, options, name} = found, {width, height} = bitmap;
  const scale = Math.sqrt(MOST / (width * height));
  if (scale >= 1) return found;
  const across = Math.floor(width * scale), down = Math.floor(height * scale);
  const size = {resizeWidth: across, resizeHeight: down, resizeQuality: 'medium', colorSpaceConversion: 'none', premultiplyAlpha: 'none'};
  bitmap.close();
  const reduced = [];
  for (const image of images) reduced.push(await createImageBitmap(image, size));
  const map = !depth || depth.data ? depth : await call('levels', {file: depth});
  const isSmall = !map || map.width <= across && map.height <= down && !options.disparity;
  return {
    ...found, images: reduced, bitmap: await createImageBitmap(reduced[0]), name: `${name}, reduced from ${width} x ${height}`,
    depth: isSmall ? map : sample(map, Math.min(map.width, across), Math.min(map.height, down), options.disparity ? across / width : 1)
  };
}
