// SPDX-License-Identifier: Apache-2.0
// Draws the canvas: the picture, its depth or its blocks, and the original picture to the left of the wipe.

const LAYERS = ['rgb(255 80 60 / 40%)', 'rgb(70 220 90 / 40%)', 'rgb(80 120 255 / 40%)'];
const LINE = '#ffc861';

// Longest side of the canvas in pixels. Larger pictures are shown reduced to the pixels of the screen.
const LONGEST = Math.min(2048, Math.max(1024, Math.ceil(screen.width * devicePixelRatio)));

/** Returns a canvas with the depth map in grey, of at most width x height pixels. Near points are bright. */
function drawDepth({data, width, height, low, high}, canvas) {
  const across = Math.min(width, canvas.width), down = Math.min(height, canvas.height);
  const image = new ImageData(across, down), pixels = new Uint32Array(image.data.buffer);
  for (let y = 0; y < down; ++y) {
    const row = Math.floor((y + 0.5) * height / down) * width;
    for (let x = 0; x < across; ++x) {
      const share = (data[row + Math.floor((x + 0.5) * width / across)] - low) / (high - low || 1);
      const level = Math.round(255 * Math.max(0, Math.min(1, share)));
      pixels[y * across + x] = 0xFF000000 | 0x10101 * level;
    }
  }
  const result = new OffscreenCanvas(across, down);
  result.getContext('2d').putImageData(image, 0, 0);
  return result;
}

export class Viewer {
  #context;
  #frame = 0;
  #show = 'picture';
  #wipe = 0;
  #cross = null;
  // The open photo: its size, the sharp photo in the size of the canvas, the current picture, its blocks, and
  // the depth in grey.
  #open = {width: 1, height: 1, original: null, picture: null, blocks: [], depth: null};

  constructor(canvas) {
    this.canvas = canvas;
    this.#context = canvas.getContext('2d', {alpha: false});
  }

  get width() {
    return this.#open.width;
  }

  get height() {
    return this.#open.height;
  }

  /** The open photo and its picture. Setting an earlier state shows the earlier photo again. */
  get state() {
    return this.#open;
  }

  set state(state) {
    this.#open = state;
    this.#resize();
    this.#drawNow();
  }

  /** Shows the sharp photo, an ImageBitmap, at once, and closes the bitmap. */
  showPhoto(bitmap) {
    const {width, height} = bitmap;
    this.#open = {width, height, original: null, picture: null, blocks: [], depth: null};
    this.#resize();
    const original = new OffscreenCanvas(this.canvas.width, this.canvas.height), context = original.getContext('2d');
    context.imageSmoothingQuality = 'medium';
    context.drawImage(bitmap, 0, 0, original.width, original.height);
    bitmap.close();
    this.#open.original = original;
    this.showSharp();
  }

  /** Shows the sharp photo again. Its depth is unknown until setDepth. */
  showSharp() {
    this.#cross = null;
    this.#open = {...this.#open, picture: this.#open.original, blocks: [], depth: null};
    this.#drawNow();
  }

  /** Shows a refocused picture or preview, an ImageBitmap, scaled to the canvas, and keeps its list of blocks. */
  showPicture(bitmap, blocks = []) {
    Object.assign(this.#open, {picture: bitmap, blocks});
    this.#draw();
  }

  /** Sets the disparity map, {data, width, height, low, high}, that is shown as depth, or null for an unknown map. */
  setDepth(map) {
    this.#open.depth = map && drawDepth(map, this.canvas);
    this.#draw();
  }

  get hasDepth() {
    return this.#open.depth !== null;
  }

  #resize() {
    const {width, height} = this.#open, scale = Math.min(1, LONGEST / Math.max(width, height));
    this.canvas.width = Math.max(1, Math.round(width * scale));
    this.canvas.height = Math.max(1, Math.round(height * scale));
    this.canvas.classList.add('filled');
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

  /** The cross of the keyboard, {x, y} in pixels of the photo, or null. */
  set cross(point) {
    this.#cross = point;
    this.#draw();
  }

  get cross() {
    return this.#cross;
  }

  /** Returns the pixel of the photo under a pointer, or null if the pointer is outside the picture. */
  toPixel({clientX, clientY}) {
    const {width, height} = this.#open, box = this.canvas.getBoundingClientRect();
    const scale = Math.min(box.width / width, box.height / height);
    const x = Math.floor((clientX - box.left - (box.width - width * scale) / 2) / scale);
    const y = Math.floor((clientY - box.top - (box.height - height * scale) / 2) / scale);
    return x >= 0 && x < width && y >= 0 && y < height ? {x, y} : null;
  }

  #draw() {
    this.#frame ||= requestAnimationFrame(() => {
      this.#frame = 0;
      this.#drawNow();
    });
  }

  #drawNow() {
    const {width, height} = this.canvas, {picture, depth} = this.#open;
    if (!picture) return;
    this.#context.drawImage(this.#show === 'depth' && depth ? depth : picture, 0, 0, width, height);
    if (this.#show === 'blocks') this.#drawBlocks();
    if (this.#wipe > 0) this.#drawWipe(Math.round(this.#wipe * width));
    if (this.#cross) this.#drawCross(this.#cross);
  }

  #drawBlocks() {
    const context = this.#context, scale = this.canvas.width / this.#open.width;
    context.lineWidth = 1;
    context.strokeStyle = 'rgb(0 0 0 / 60%)';
    for (const {x, y, width, height, layer} of this.#open.blocks) {
      context.fillStyle = LAYERS[layer];
      context.fillRect(x * scale, y * scale, width * scale, height * scale);
      context.strokeRect(x * scale + .5, y * scale + .5, width * scale, height * scale);
    }
  }

  #drawWipe(column) {
    const {width, height} = this.canvas, context = this.#context;
    context.save();
    context.beginPath();
    context.rect(0, 0, column, height);
    context.clip();
    context.drawImage(this.#open.original, 0, 0, width, height);
    context.restore();
    context.fillStyle = LINE;
    context.fillRect(column - 1, 0, 2, height);
  }

  #drawCross(point) {
    const size = Math.max(10, this.canvas.width / 50), context = this.#context;
    const x = point.x * this.canvas.width / this.#open.width, y = point.y * this.canvas.height / this.#open.height;
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
