// SPDX-License-Identifier: Apache-2.0
// Draws the canvas: the picture, its depth or its blocks, and the original picture to the left of the wipe.

const LAYERS = ['rgb(255 80 60 / 40%)', 'rgb(70 220 90 / 40%)', 'rgb(80 120 255 / 40%)'];
const LINE = '#ffc861';

/** Returns a canvas that contains the picture. */
function toCanvas({data, width, height}) {
  const canvas = new OffscreenCanvas(width, height);
  canvas.getContext('2d').putImageData(new ImageData(data, width, height), 0, 0);
  return canvas;
}

/** Returns a canvas with the depth map in grey. Near points are bright. */
function drawDepth({depth: {data, width, height}, low, high}) {
  const pixels = new Uint8ClampedArray(4 * width * height);
  for (let i = 0; i < data.length; ++i) {
    pixels.fill(Math.round((data[i] - low) / (high - low || 1) * 255), 4 * i, 4 * i + 3);
    pixels[4 * i + 3] = 255;
  }
  return toCanvas({data: pixels, width, height});
}

export class Viewer {
  #context;
  #field = null;
  #original = null;
  #depth = null;
  #frame = 0;
  #picture = null;
  #blocks = [];
  #show = 'picture';
  #wipe = 0;
  #cross = null;

  constructor(canvas) {
    this.canvas = canvas;
    this.#context = canvas.getContext('2d', {alpha: false});
  }

  /** Shows the centre view of a light field. showField can add the depth later. */
  showView(view) {
    this.canvas.width = view.width;
    this.canvas.height = view.height;
    this.#original = toCanvas(view);
    this.#picture = this.#original;
    this.#depth = this.#field = this.#cross = null;
    this.#blocks = [];
    this.#draw();
  }

  showField(field) {
    this.showView(field.views[0]);
    this.#field = field;
  }

  /** Shows a refocused picture or preview, scaled to the canvas, and keeps its list of blocks. */
  showPicture(picture) {
    this.#picture = toCanvas(picture);
    this.#blocks = picture.blocks ?? [];
    this.#draw();
  }

  set show(what) {
    this.#show = what;
    this.#draw();
  }

  /** Fraction of the width, from the left edge, that shows the original picture, 0 to 1. */
  set wipe(share) {
    this.#wipe = share;
    this.#draw();
  }

  /** The cross of the keyboard, {x, y} in pixels, or null. */
  set cross(point) {
    this.#cross = point;
    this.#draw();
  }

  get cross() {
    return this.#cross;
  }

  /** Returns the pixel under a pointer, or null if the pointer is outside the picture. */
  toPixel({clientX, clientY}) {
    const {width, height} = this.canvas, box = this.canvas.getBoundingClientRect();
    const scale = Math.min(box.width / width, box.height / height);
    const x = Math.floor((clientX - box.left - (box.width - width * scale) / 2) / scale);
    const y = Math.floor((clientY - box.top - (box.height - height * scale) / 2) / scale);
    return x >= 0 && x < width && y >= 0 && y < height ? {x, y} : null;
  }

  /** Returns the picture as a JPEG. */
  toJpeg() {
    return this.#picture.convertToBlob({type: 'image/jpeg', quality: 0.92});
  }

  #draw() {
    this.#frame ||= requestAnimationFrame(() => {
      this.#frame = 0;
      this.#drawNow();
    });
  }

  #drawNow() {
    const {width, height} = this.canvas, context = this.#context;
    if (!this.#picture) return;
    if (this.#show === 'depth' && this.#field) {
      this.#depth ??= drawDepth(this.#field);
      context.drawImage(this.#depth, 0, 0, width, height);
    } else {
      context.drawImage(this.#picture, 0, 0, width, height);
    }
    if (this.#show === 'blocks') this.#drawBlocks();
    if (this.#wipe > 0) this.#drawWipe(Math.round(this.#wipe * width));
    if (this.#cross) this.#drawCross(this.#cross);
  }

  #drawBlocks() {
    const context = this.#context;
    context.lineWidth = 1;
    context.strokeStyle = 'rgb(0 0 0 / 60%)';
    for (const {x, y, width, height, layer} of this.#blocks) {
      context.fillStyle = LAYERS[layer];
      context.fillRect(x, y, width, height);
      context.strokeRect(x + .5, y + .5, width, height);
    }
  }

  #drawWipe(column) {
    const {height} = this.canvas, context = this.#context;
    context.drawImage(this.#original, 0, 0, column, height, 0, 0, column, height);
    context.fillStyle = LINE;
    context.fillRect(column - 1, 0, 2, height);
  }

  #drawCross({x, y}) {
    const size = Math.max(10, this.canvas.width / 50), context = this.#context;
    for (const [style, width] of [['#000', 5], [LINE, 2]]) {
      context.strokeStyle = style;
      context.lineWidth = width;
      context.beginPath();
      context.moveTo(x - size, y + .5);
      context.lineTo(x + size, y + .5);
      context.moveTo(x + .5, y - size);
      context.lineTo(x + .5, y + size);
      context.stroke();
    }
  }
}
