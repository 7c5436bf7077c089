// SPDX-License-Identifier: Apache-2.0
// Finds out why a file cannot be opened, and writes the messages of the page. Messages never contain the names of
// options or functions.

import {isJpeg, latin, readJpeg} from './jpeg.js';

const HEIF_BRANDS = /^(hei[cxms]|hev[cxms]|mif1|msf1)$/;
const DEPTH_TYPE = /urn:(mpeg:(hevc:2015:auxid:2|mpegB:cicp:systems:auxiliary:depth)|com:apple:photo:2018:aux:portraiteffectsmatte)\0/;
// Auxiliary pictures of Apple, and items of ISO 21496-1, whose type follows the version, flags and number of the item.
const GAIN_TYPE = /urn:com:apple:photo:2020:aux:hdrgainmap\0|infe[\x02\x03][^]{7,9}tmap/;

/** Returns true if the bytes start a HEIC file. */
export const isHeif = bytes => latin(bytes.subarray(4, 8)) === 'ftyp' && HEIF_BRANDS.test(latin(bytes.subarray(8, 12)));

/** Returns true if a HEIC file names the type of auxiliary pictures with depth or the matte of a person. */
export const namesDepth = bytes => DEPTH_TYPE.test(latin(bytes));

/** Returns true if a HEIC file names the type of gain maps. */
export const namesGainMap = bytes => GAIN_TYPE.test(latin(bytes));

/** Returns true if a PNG file starts at this position. */
export const isPng = (bytes, at = 0) => bytes[at] === 0x89 && latin(bytes.subarray(at + 1, at + 4)) === 'PNG';

const isWebp = bytes => latin(bytes.subarray(0, 4)) === 'RIFF' && latin(bytes.subarray(8, 12)) === 'WEBP';

function isCutOff(bytes) {
  if (isJpeg(bytes)) return readJpeg(bytes).end === 0;
  if (isPng(bytes)) return !latin(bytes.subarray(-1024)).includes('IEND');
  return isWebp(bytes) && new DataView(bytes.buffer, bytes.byteOffset).getUint32(4, true) + 8 > bytes.length;
}

/** Returns the reason why the browser cannot decode a picture file, as the end of a sentence. */
function reasonOf(bytes) {
  if (!bytes.length) return 'is empty';
  if (isHeif(bytes)) return 'is a HEIC picture, which this browser cannot read. Export the picture as JPEG';
  if (isCutOff(bytes)) return 'is cut off: the end of the file is missing';
  if (isJpeg(bytes) || isPng(bytes) || isWebp(bytes)) return 'is a damaged picture, or of a kind that this browser cannot read';
  return 'is not a picture';
}

/** Decodes a picture file, and returns its ImageBitmap. If that fails, throws a sentence in which the file has this
 *  name. */
export async function checkPicture(file, name = file.name) {
  const bytes = new Uint8Array(await file.arrayBuffer());
  // Browsers may decode the first rows of a file that is cut off.
  if (!isCutOff(bytes)) {
    try {
      return await createImageBitmap(file, {colorSpaceConversion: 'none', premultiplyAlpha: 'none'});
    } catch {
      // reasonOf finds the reason.
    }
  }
  throw new Error(`${name} ${reasonOf(bytes)}.`);
}

const SENTENCES = {
  NOT_FINITE: name => `The depth of ${name} is unknown or the same everywhere, so there is nothing to focus on.`,
  DISPARITY: name => `The depth of ${name} is out of range: expected disparities from -499 to 499 pixels.`,
  MEMORY: name => `There is not enough memory for ${name}.`,
  WORKER: () => 'The engine could not be started. Reload the page, or check that it may start workers.',
  UNSUPPORTED: () => 'This browser cannot run the engine. Use a newer browser.'
};

/** Returns the message for an error of the engine while `name` was opened or refocused. */
export function toSentence(error, name) {
  if (error.name !== 'StarfocusError') return error.message;
  if (error.code === 'UNSUPPORTED' && /SIMD/.test(error.message)) {
    return 'WebAssembly has no SIMD here, which the engine needs. Use a newer browser.';
  }
  if (/^matte/.test(error.field)) return error.message.replace(/^[\w.]+/, `The matte of ${name} cannot be used`);
  return SENTENCES[error.code]?.(name) ?? `${name} cannot be refocused here.`;
}
