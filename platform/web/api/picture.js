// SPDX-License-Identifier: Apache-2.0
// A refocused picture, which browsers can convert to their own kinds of pictures.

import {StarfocusError} from './errors.js';

const PIXELS = 'a page or a worker of a browser';

/** Throws unless this environment has the class `name`. */
function need(name, call) {
  if (typeof globalThis[name] === 'function') return;
  throw new StarfocusError('UNSUPPORTED', `${call}: expected ${PIXELS}; there is no ${name} here.`);
}

/** See starfocus.d.ts. */
export class Picture {
  constructor({data, width, height, blocks, milliseconds, shift}) {
    Object.assign(this, {data, width, height, shift, milliseconds});
    if (blocks) this.blocks = blocks;
  }

  toImageData() {
    need('ImageData', 'toImageData');
    return new ImageData(this.data, this.width, this.height);
  }

  async toImageBitmap() {
    need('createImageBitmap', 'toImageBitmap');
    return createImageBitmap(this.toImageData(), {premultiplyAlpha: 'none', colorSpaceConversion: 'none'});
  }

  async toBlob({type = 'image/jpeg', quality = 0.92} = {}) {
    need('OffscreenCanvas', 'toBlob');
    const canvas = new OffscreenCanvas(this.width, this.height);
    canvas.getContext('2d').putImageData(this.toImageData(), 0, 0);
    return canvas.convertToBlob({type, quality});
  }
}
