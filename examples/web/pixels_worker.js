// SPDX-License-Identifier: Apache-2.0
// Worker that decodes, reduces and encodes pictures, so that the page does not stop. Messages are {id, name, values};
// answers are {id, result} or {id, error}.

const SAMPLE = 512;  // longest side of the copies that isGray examines
const GRAY = 8;      // largest difference of the channels of a grey pixel

/** Returns the pixels of a picture file as ImageData. Pictures longer than `longest` are reduced. */
async function decode(file, {longest = Infinity, orientation = 1} = {}) {
  const bitmap = await createImageBitmap(file, {colorSpaceConversion: 'none', premultiplyAlpha: 'none'});
  const scale = Math.min(1, longest / Math.max(bitmap.width, bitmap.height));
  const width = Math.max(1, Math.round(bitmap.width * scale)), height = Math.max(1, Math.round(bitmap.height * scale));
  const [across, down] = orientation >= 5 ? [height, width] : [width, height];
  const context = new OffscreenCanvas(across, down).getContext('2d', {willReadFrequently: true});
  turn(context, orientation, width, height);
  context.drawImage(bitmap, 0, 0, width, height);
  bitmap.close();
  return context.getImageData(0, 0, across, down);
}

/** Sets the transformation of a picture of width x height pixels with an EXIF orientation to its upright position. */
function turn(context, orientation, width, height) {
  const matrices = {
    2: [-1, 0, 0, 1, width, 0], 3: [-1, 0, 0, -1, width, height], 4: [1, 0, 0, -1, 0, height], 5: [0, 1, 1, 0, 0, 0],
    6: [0, 1, -1, 0, height, 0], 7: [0, -1, -1, 0, height, width], 8: [0, -1, 1, 0, 0, width]
  };
  if (matrices[orientation]) context.setTransform(...matrices[orientation]);
}

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

  /** Returns the farthest levels of a depth picture that are no outliers, from 0 to 1: the quantiles of 0.1 % and
   *  99.9 %, which openPhoto also uses. */
  async measure({file}) {
    const {data} = await decode(file), counts = new Uint32Array(256), pixels = data.length / 4;
    for (let i = 0; i < data.length; i += 4) ++counts[data[i]];
    const beyond = Math.trunc((pixels - 1) / 1000);
    const levelAt = rank => counts.findIndex(count => (rank -= count) < 0) / 255;
    return {low: levelAt(beyond), high: levelAt(pixels - 1 - beyond)};
  },

  /** Returns a depth picture as an array of bytes, turned by the EXIF orientation of its photo. */
  async upright({file, orientation}) {
    const {data, width, height} = await decode(file, {orientation});
    return {data: Uint8Array.from({length: width * height}, (_, i) => data[4 * i]), width, height};
  },

  /** Converts a depth picture of distances from `first` to `last` to inverse distances. NaN is unknown. */
  async invert({file, orientation, first, last}) {
    const {data, width, height} = await decode(file, {orientation});
    const table = Float32Array.from({length: 256}, (_, level) => {
      const distance = first + level / 255 * (last - first);
      return distance > 0 ? 1 / distance : NaN;
    });
    return {data: Float32Array.from({length: width * height}, (_, i) => table[data[4 * i]]), width, height};
  },

  /** Converts the demo's disparities, which are codes of 16 bits in the channels R (high) and G (low). */
  async disparities({file, scale, offset}) {
    const {data, width, height} = await decode(file);
    const codes = Float32Array.from({length: width * height}, (_, i) => (data[4 * i] << 8 | data[4 * i + 1]) * scale + offset);
    return {data: codes, width, height};
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
    postMessage({id, result}, isBitmap ? [result] : result.data ? [result.data.buffer] : []);
  } catch (error) {
    postMessage({id, error: error.message});
  }
};
