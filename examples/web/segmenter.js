// SPDX-License-Identifier: Apache-2.0
// Worker that finds the person in one photo with @mediapipe/selfie_segmentation, which toolchains/site/web copies to the
// folder segmenter. The message is the photo, a Blob or an ImageBitmap. The answer is {result}, the matte as a grey PNG
// file, or {error}.

const NAME = 'selfie_segmentation', SOLUTION = `${NAME}_solution_simd_wasm_bin`;
const FILES = {
  [`${NAME}.js`]: 'text/javascript', [`${SOLUTION}.js`]: 'text/javascript', [`${SOLUTION}.wasm`]: 'application/wasm',
  [`${NAME}.binarypb`]: '', [`${NAME}.tflite`]: ''
};
const SIDE = 256;     // side of the square picture that the model examines
const SUBJECT = 128;  // least alpha of a subject

// The package expects a page, in which it creates canvases and elements that load its scripts.
self.window = self;
self.document = {
  createElement: name => name === 'canvas' ? new OffscreenCanvas(1, 1) : {
    setAttribute(attribute, value) {
      this[attribute] = value;
    },
    addEventListener(event, listener) {
      this[event] = listener;
    }
  },
  body: {
    appendChild({src, load}) {
      importScripts(src);
      load();
    }
  },
  addEventListener() {}
};

/** Loads a file, which is stored compressed because not all servers compress files. Returns a blob: address. */
async function load(file) {
  const response = await fetch(`segmenter/${file}.gzip`).catch(() => Promise.reject(Error('the connection failed')));
  if (!response.ok) throw new Error(`the server returned status ${response.status}`);
  const content = await new Response(response.body.pipeThrough(new DecompressionStream('gzip'))).arrayBuffer();
  return URL.createObjectURL(new Blob([content], {type: FILES[file]}));
}

/** Returns the photo with a shortest side of SIDE pixels. A larger picture gives the same matte. */
async function shrink(photo) {
  const bitmap = await createImageBitmap(photo), {width, height} = bitmap, scale = SIDE / Math.min(width, height);
  const small = await createImageBitmap(bitmap, {
    resizeWidth: Math.round(width * scale), resizeHeight: Math.round(height * scale), resizeQuality: 'medium'
  });
  bitmap.close();
  return small;
}

/** Returns the alpha of the person in a picture, as an ImageData whose alpha channel counts. */
async function segment(image, addresses) {
  importScripts(addresses[`${NAME}.js`]);
  const segmenter = new SelfieSegmentation({locateFile: file => addresses[file]});
  let mask;
  segmenter.setOptions({modelSelection: 0, useCpuInference: true});
  segmenter.onResults(({segmentationMask}) => mask = segmentationMask);
  await segmenter.send({image});
  const context = new OffscreenCanvas(mask.width, mask.height).getContext('2d');
  context.drawImage(mask, 0, 0);
  return context.getImageData(0, 0, mask.width, mask.height);
}

/** Returns the matte as a grey PNG file. The model computes probabilities. Doubling their contrast around 1/2 makes wide
 *  doubtful parts, which no subject has, smaller. */
async function encode({data, width, height}) {
  const canvas = new OffscreenCanvas(width, height), grey = new ImageData(width, height);
  grey.data.forEach((_, i) => grey.data[i] = i % 4 === 3 ? 255 : 2 * data[i | 3] - SUBJECT);  // clamped to 0 to 255
  canvas.getContext('2d').putImageData(grey, 0, 0);
  return canvas.convertToBlob({type: 'image/png'});
}

onmessage = async ({data: photo}) => {
  try {
    if (!new OffscreenCanvas(1, 1).getContext('webgl2')) throw new Error('this browser has no WebGL in workers');
    const names = Object.keys(FILES), files = await Promise.all(names.map(load));
    const addresses = Object.fromEntries(names.map((name, index) => [name, files[index]]));
    const matte = await segment(await shrink(photo), addresses);
    if (!matte.data.some((value, i) => i % 4 === 3 && value >= SUBJECT)) throw new Error('there is no person in the photo');
    postMessage({result: await encode(matte)});
  } catch (error) {
    postMessage({error: error.message ?? String(error)});
  }
};
