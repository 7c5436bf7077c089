// SPDX-License-Identifier: Apache-2.0
// Decodes the pictures that callers of openPhoto pass.

import {readPng16} from './png16.js';

function fail(code, field, message) {
  throw Object.assign(new Error(`${field}: ${message}`), {code, field});
}

/** Returns the pixels of an ImageBitmap or a picture file as {data, width, height, channels}. */
async function drawPixels(source, what) {
  if (typeof OffscreenCanvas !== 'function') {
    fail('UNSUPPORTED', what, 'picture files cannot be decoded here; pass {data, width, height}.');
  }
  let bitmap = source;
  if (source instanceof Blob) {
    bitmap = await createImageBitmap(source, {colorSpaceConversion: 'none', premultiplyAlpha: 'none'}).catch(() =>
      fail('DECODE', what, `${source.name ? `${source.name} is` : 'this is'} not a picture that this browser can decode.`));
  }
  const {width, height} = bitmap, canvas = new OffscreenCanvas(width, height);
  const context = canvas.getContext('2d', {willReadFrequently: true});
  context.drawImage(bitmap, 0, 0);
  bitmap.close();
  return {data: context.getImageData(0, 0, width, height).data, width, height, channels: 4};
}

/** Returns the pixels of a picture: a Blob, an ImageBitmap, or {data, width, height, channels}. */
export async function decodePicture(source, what) {
  return source.data ? source : drawPixels(source, what);
}

/** Returns the pixels of a depth picture. A PNG with 16 bits of grey keeps its bits. */
export async function decodeDepth(source) {
  if (source.data) return source;
  const grey = source.arrayBuffer && await readPng16(source);
  return grey ?? drawPixels(source, 'depth');
}
