// SPDX-License-Identifier: Apache-2.0
// Decodes picture files with the decoders of the browser.

/** Returns the ImageData of a picture file, without conversion of colours. */
export async function decode(file, name = file.name) {
  let bitmap;
  try {
    bitmap = await createImageBitmap(file, {colorSpaceConversion: 'none', premultiplyAlpha: 'none'});
  } catch {
    const kind = /\.hei[cf]$/i.test(name) ? 'a HEIC picture, which this browser cannot read' :
                                            'not a picture that this browser can read';
    throw new Error(`${name} is ${kind}.`);
  }
  const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
  const context = canvas.getContext('2d', {willReadFrequently: true});
  context.drawImage(bitmap, 0, 0);
  bitmap.close();
  return context.getImageData(0, 0, canvas.width, canvas.height);
}

/** Returns the red code of each pixel, 0 to 255, which is the grey value in a grey picture. */
export function redOf(image) {
  return Uint8Array.from({length: image.width * image.height}, (_, i) => image.data[4 * i]);
}

/** Returns true if green and blue differ from red by at most 8 at every pixel. */
export function isGray({data}) {
  for (let i = 0; i < data.length; i += 4) {
    if (Math.abs(data[i] - data[i + 1]) > 8 || Math.abs(data[i] - data[i + 2]) > 8) return false;
  }
  return true;
}
