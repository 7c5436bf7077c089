// SPDX-License-Identifier: Apache-2.0
// starfocus: refocuses light fields of 1, 5, 9 or 17 views, and depth photos, in a worker.
//
//   const refocuser = await createRefocuser({width, height, views: 5, disparityMin: -9, disparityMax: 8});
//   await refocuser.prepare(views, depth);
//   const focus = await refocuser.focusAt(x, y);
//   const small = await refocuser.preview({focus, shift: 2});
//   const picture = await refocuser.refocus({focus});
//   context.putImageData(new ImageData(picture.data, picture.width, picture.height), 0, 0);
//
// Fields that are not explained here are those of starfocus_config, starfocus_params and starfocus_lens in starfocus/starfocus.h,
// written as JavaScript writes names, with its defaults. Bytes are those of the library and of its program.

/** How the picture is made; default BLOCK. */
export declare const Mode: {readonly FRAME: 0, readonly BENCHMARK: 1, readonly BLOCK: 2, readonly BLUR: 3};
/** How many views a blur needs. */
export declare const Renderer: {readonly AUTO: 0, readonly LINE_SCAN: 1, readonly SLICES: 2};
/** The opening of the lens; default FALL_OFF. */
export declare const Shape: {readonly FALL_OFF: 0, readonly DISC: 1, readonly POLYGON: 2, readonly RING: 3};
/** How the codes of a picture stand for light; default SRGB. */
export declare const Transfer: {readonly SRGB: 0, readonly NONE: 1};

/** What a refocuser can be told at any time. */
export interface Settings {
  /** Largest blur radius in pixels that will be asked for; default 32. */
  maxBlur?: number;
  superblock?: 0 | 32 | 64 | 128 | 256;
  deblocking?: number;
  timing?: {block?: number, field?: number, a?: number, b?: number, c?: number, upsample?: number, span?: number, hole?: number};
  nScale?: number;
  gather?: boolean;
  /** How many times white the lamps are that the pictures clip, from 1 to 64; default 1. */
  highlights?: number;
  fillUnknown?: boolean;
  /** True: lenses may be polygons and have cat's eyes, for which memory is reserved. */
  shapes?: boolean;
}

export interface Options extends Settings {
  /** Pixels of every view. */
  width: number;
  height: number;
  views: 1 | 5 | 9 | 17;
  /** The range that all disparities lie in, pixels. */
  disparityMin: number;
  disparityMax: number;
  /** Largest shift of preview(); default 0, none. */
  previews?: 0 | 1 | 2 | 3;
  maxLayer?: 0 | 1 | 2;
  transfer?: 0 | 1;
  /** Workers that share the work, the one that answers among them; default: as many as there are cores. Where
   *  memory cannot be shared, in pages that are not cross-origin isolated, it is always 1. */
  threads?: number;
}

/** A picture as a canvas has it, or rows of R, G, B or R, G, B, A without gaps; all views of one kind. */
export type View = ImageData | Uint8Array | Uint8ClampedArray;

/** A map of the centre view, as large as the picture or smaller. */
export interface DepthMap {
  data: Float32Array | Uint16Array | Uint8Array | Uint8ClampedArray;
  /** Default: the picture's. */
  width?: number;
  height?: number;
  /** Disparity = scale * value + offset, or scale / value + offset if it is reciprocal. Default 1 and 0. */
  scale?: number;
  offset?: number;
  reciprocal?: boolean;
  /** A value that stands for an unknown depth, as NaN does; fillUnknown takes such maps. */
  invalid?: number;
}

export interface Call {
  /** Ends the call, which then rejects with the signal's reason. A call that waits for others ends at once; one
   *  that runs within a few milliseconds where memory is shared, else at the next rows of blocks. */
  signal?: AbortSignal;
}

export interface Params extends Call {
  /** Disparity in focus; default 0. */
  focus?: number;
  /** Radius of the lens, from 0 to 1, which is that of the outermost views; default 1. */
  aperture?: number;
  /** POLYGON, and catsEye above 0, need `shapes`. */
  shape?: 0 | 1 | 2 | 3;
  blades?: number;
  theta?: number;
  rotation?: number;
  curvature?: number;
  ringInner?: number;
  catsEye?: number;
  mode?: 0 | 1 | 2 | 3;
  renderer?: 0 | 1 | 2;
  /** Only this part of the picture, in its pixels; four zeros: the whole picture. */
  region?: {x: number, y: number, width: number, height: number};
  /** True: the picture has a list of its blocks, of the first 65536 of them. */
  blocks?: boolean;
}

export interface Block {
  x: number;
  y: number;
  width: number;
  height: number;
  /** L: refocused at 1 / 2^L of the size. */
  layer: number;
  /** N: views along the radius; 0: none but the centre. */
  n: number;
}

export interface Picture {
  /** R, G, B and 255, or the alpha of the centre view. */
  data: Uint8ClampedArray;
  width: number;
  height: number;
  blocks?: Block[];
  /** Time it took in the worker. */
  milliseconds: number;
}

/** What the library refuses; `status` is the starfocus_status, `field` what is at fault ("": no single one). Wrong kinds of values are TypeErrors. */
export declare class StarfocusError extends Error {
  readonly status: number;
  readonly field: string;
}

/** Answers its calls in their order. */
export interface Refocuser {
  /** Version of the library, such as "0.1.0". */
  readonly version: string;
  readonly threads: number;

  /** Takes a light field: the views in the order of starfocus_view_position (the centre, then right, left, below,
   *  above), and its depth, disparities if it is a Float32Array. `coverage` has a byte for each pixel: how
   *  much of it the nearer of two surfaces covers, 255: all, as a matting network finds it; near depth edges
   *  it decides over the depth. All are copied; with `transfer` their buffers are handed over instead, and
   *  are empty afterwards. */
  prepare(views: View[], depth: Float32Array | DepthMap,
          options?: Call & {coverage?: Uint8Array | Uint8ClampedArray, transfer?: boolean}): Promise<{milliseconds: number}>;

  /** Changes settings, for which it makes another engine; the light field stays. */
  configure(settings: Settings): Promise<void>;

  /** Refocuses at 1 / 2^shift of the size; default 1. */
  preview(params?: Params & {shift?: 1 | 2 | 3}): Promise<Picture>;

  refocus(params?: Params & {onProgress?: (rowsDone: number, rows: number) => void}): Promise<Picture>;

  /** The focus for what is at that pixel of the depth map. */
  focusAt(x: number, y: number): Promise<number>;

  /** Ends its workers; calls that have not been answered reject. */
  close(): void;
}

export declare function createRefocuser(options: Options): Promise<Refocuser>;
