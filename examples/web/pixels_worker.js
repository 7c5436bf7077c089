// SPDX-License-Identifier: Apache-2.0
// Worker that decodes, reduces and encodes pictures, so that the page does not stop. Messages are {id, name, values};
// answers are {id, result} or {id, error}.

const SAMPLE = 512;  // longest side of the copies that isGray examines
const GRAY = 8;      // largest difference of the channels of a grey pixel
const MOST_PIXELS = 2 ** 24;  // of a canvas of iOS before version 18

/** Returns the pixels of a picture file as ImageData. Larger pictures are reduced to the longest side `longest`. */
async function decode(file, {longest = Infinity} = {}) {
  const bitmap = await createImageBitmap(file, {colorSpaceConversion: 'none', premultiplyAlpha: 'none'});
  const most = Math.sqrt(MOST_PIXELS / (bitmap.width * bitmap.height));
  const scale = Math.min(1, most, longest / Math.max(bitmap.width, bitmap.height));
  const width = Math.max(1, Math.floor(bitmap.width * scale)), height = Math.max(1, Math.floor(bitmap.height * scale));
  const context = new OffscreenCanvas(width, height).getContext('2d', {willReadFrequently: true});
  context.imageSmoothingEnabled = longest < Infinity;
  context.drawImage(bitmap, 0, 0, width, height);
  bitmap.close();
  return context.getImageData(0, 0, width, height);
}

/** Returns the levels of a depth picture as {data, width, height}. A PNG with 16 bits of grey keeps its bits. */
async function decodeLevels(file) {
  const {readPng16} = await import('./png16.js'), deep = await readPng16(file);
  if (deep) return deep;
  const {data, width, height} = await decode(file);
  return {data: Uint8Array.from({length: width * height}, (_, i) => data[4 * i]), width, height};
}

/** Returns the levels in their upright position, for an EXIF orientation. */
function turn({data, width, height}, orientation) {
  if (orientation === 1) return {data, width, height};
  const swaps = orientation >= 5, fromRight = [2, 3, 7, 8].includes(orientation), fromBelow = [3, 4, 6, 7].includes(orientation);
  const [across, down] = swaps ? [height, width] : [width, height], turned = new data.constructor(data.length);
  for (let y = 0, i = 0; y < down; ++y) {
    for (let x = 0; x < across; ++x) {
      const [column, row] = swaps ? [y, x] : [x, y];
      turned[i++] = data[(fromBelow ? height - 1 - row : row) * width + (fromRight ? width - 1 - column : column)];
    }
  }
  return {data: turned, width: across, height: down};
}

/** Returns true if the subject of a mask is white, by the same rule as the program (platform/readers/dynamic_depth.cc). The
 *  subject is more often in the middle and at the lower edge than at the upper edge and the upper half of the sides. */
function hasWhiteSubject({data, width, height}) {
  let inside = 0, outside = 0, insides = 0, outsides = 0;
  data.forEach((level, i) => {
    const x = i % width, y = Math.trunc(i / width), isUpper = 2 * y < height;
    if (y === 0 || isUpper && (x === 0 || x === width - 1)) {
      outside += level;
      ++outsides;
    } else if (!isUpper && Math.abs(2 * x - width) <= Math.trunc(width / 3)) {
      inside += level;
      ++insides;
    }
  });
  return inside * outsides >= outside * insides;
}

/** Returns the matte in the levels of a mask. If `isBlack` is undefined, the end of the subject is guessed. */
function toMatte(mask, isBlack = !hasWhiteSubject(mask)) {
  const most = countLevels(mask.data) - 1;
  return {...mask, data: mask.data.map(level => isBlack ? most - level : level)};
}

/** Returns the number of levels of an array. */
const countLevels = data => data instanceof Uint16Array ? 65536 : 256;

let shown = null;    // ImageData of the full picture that the page shows

const calls = {
  /** Returns whether green and blue differ little from red at every pixel. */
  async isGray({file}) {
    const {data} = await decode(file, {longest: SAMPLE});
    for (let i = 0; i < data.length; i += 4) {
      if (Math.abs(data[i] - data[i + 1]) > GRAY || Math.abs(data[i] - data[i + 2]) > GRAY) return false;
    }
    return true;
  },

  /** Returns whether any pixel is transparent. */
  async hasAlpha({file}) {
    const {data} = await decode(file, {longest: SAMPLE});
    return data.some((value, i) => i % 4 === 3 && value < 255);
  },

  /** Returns the farthest levels of a depth picture that are no outliers, from 0 to 1: the quantiles of 0.1 % and
   *  99.9 %, which openPhoto also uses. */
  async measure({file}) {
    const {data} = await decodeLevels(file), counts = new Uint32Array(countLevels(data));
    for (const level of data) ++counts[level];
    const beyond = Math.trunc((data.length - 1) / 1000);
    const levelAt = rank => counts.findIndex(count => (rank -= count) < 0) / (counts.length - 1);
    return {low: levelAt(beyond), high: levelAt(data.length - 1 - beyond)};
  },

  /** Returns the levels of a depth picture, turned by the EXIF orientation of its photo. */
  async levels({file, orientation = 1}) {
    return turn(await decodeLevels(file), orientation);
  },

  /** Returns a matte with its colours and alpha, turned by the EXIF orientation of its photo. */
  async turn({file, orientation}) {
    const {data, width, height} = await decode(file), turned = turn({data: new Uint32Array(data.buffer), width, height}, orientation);
    return {...turned, data: new Uint8ClampedArray(turned.data.buffer)};
  },

  /** Returns the matte in a mask that a photo stores, turned by the EXIF orientation of the photo. */
  async mask({file, orientation, isBlack}) {
    return toMatte(turn(await decodeLevels(file), orientation), isBlack);
  },

  /** Converts a depth picture of distances from `first` to `last` to inverse distances. NaN is unknown. */
  async invert({file, orientation, first, last}) {
    const {data, width, height} = turn(await decodeLevels(file), orientation), count = countLevels(data);
    const table = Float32Array.from({length: count}, (_, level) => {
      const distance = first + level / (count - 1) * (last - first);
      return distance > 0 ? 1 / distance : NaN;
    });
    return {data: Float32Array.from(data, level => table[level]), width, height};
  },

  /** Converts the demo's disparities, which are codes of 16 bits in the channels R (high) and G (low). */
  async disparities({file, scale, offset}) {
    const {data, width, height} = await decode(file);
    const codes = Float32Array.from({length: width * height}, (_, i) => (data[4 * i] << 8 | data[4 * i + 1]) * scale + offset);
    return {data: codes, width, height};
  },

  /** Returns the right picture of a stereo photo at the heights of the left picture, or null if it has these heights. */
  async align({left, right}) {
    const {align} = await import('./align.js');
    return align(await decode(left), await decode(right));
  },

  /** Keeps a full picture for `encode`, and returns an ImageBitmap of at most across x down pixels. */
  async show({data, width, height, across, down}) {
    shown = new ImageData(data, width, height);
    const options = {premultiplyAlpha: 'none', colorSpaceConversion: 'none'};
    if (width <= across && height <= down) return createImageBitmap(shown, options);
    return createImageBitmap(shown, {...options, resizeWidth: across, resizeHeight: down, resizeQuality: 'medium'});
  },

  /** Returns a picture file, or the picture of the last `show`, as a JPEG without metadata. */
  async encode({file}) {
    const image = file ? await decode(file) : shown, canvas = new OffscreenCanvas(image.width, image.height);
    canvas.getContext('2d').putImageData(image, 0, 0);
    return canvas.convertToBlob({type: 'image/jpeg', quality: 0.92});
  }
};

onmessage = async ({data: {id, name, values}}) => {
  try {
    const result = await calls[name](values);
    const isBitmap = result instanceof ImageBitmap;
    postMessage({id, result}, isBitmap ? [result] : result?.data ? [result.data.buffer] : []);
  } catch (error) {
    postMessage({id, error: error.message});
  }
};
