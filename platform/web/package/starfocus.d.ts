// SPDX-License-Identifier: Apache-2.0
// Types of the npm package starfocus, which refocuses light fields of 1, 5, 9 or 17 views, and depth photos. The
// engine runs in a worker, so all calls are asynchronous.
//
//   const refocuser = await createRefocuser({width, height, views: 5, disparityMin: -9, disparityMax: 8, previews: 2});
//   await refocuser.prepare(views, depth);
//   const focus = await refocuser.focusAt(x, y);
//   const small = await refocuser.preview({focus, shift: 2});
//   const picture = await refocuser.refocus({focus});
//   context.putImageData(new ImageData(picture.data, picture.width, picture.height), 0, 0);
//
// Options, settings and parameters are the fields of starfocus_config, starfocus_params and starfocus_lens in
// starfocus/starfocus.h, with JavaScript names: max_blur is maxBlur. A field has the same meaning, range and default as
// in C, and pictures have the same bytes as pictures of the C library. An omitted field has its default.

/** How the picture is divided, and how many views are rendered (starfocus_mode). FRAME: one number of views for the
 *  whole picture. BENCHMARK: as FRAME with more views. BLOCK, the default: blocks of different sizes, each with its own
 *  number of views. BLUR: the blurred centre view, without other views. */
export declare const Mode: {readonly FRAME: 0, readonly BENCHMARK: 1, readonly BLOCK: 2, readonly BLUR: 3};
/** How views are rendered (starfocus_renderer). AUTO, the default: line scan for Mode.FRAME with 5 or more views,
 *  slices otherwise. LINE_SCAN: the paper's renderer. SLICES: slices of the scene, with fewer views. */
export declare const Renderer: {readonly AUTO: 0, readonly LINE_SCAN: 1, readonly SLICES: 2};
/** Shape of the aperture (starfocus_shape). FALL_OFF, the default: a disc that is darker towards its rim. DISC: a disc
 *  of constant brightness. POLYGON: a polygon, as of a shutter with blades. RING: a disc with a hole. */
export declare const Shape: {readonly FALL_OFF: 0, readonly DISC: 1, readonly POLYGON: 2, readonly RING: 3};
/** How the codes 0 to 255 of a picture represent light (starfocus_transfer). SRGB, the default: by the sRGB curve.
 *  NONE: light is the code itself. */
export declare const Transfer: {readonly SRGB: 0, readonly NONE: 1};

/** Settings of a refocuser, which Refocuser.configure can change. */
export interface Settings {
  /** Upper limit of the blur radius aperture * |disparity - focus| in pixels, (0, 128]; default 32. The limit does not
   *  affect the pictures. Larger values require more memory. */
  maxBlur?: number;
  /** Side of the superblocks in pixels. The engine splits superblocks into blocks. The default 0 means 128 if the width
   *  is at least 1536 pixels, and 64 otherwise. */
  superblock?: 0 | 32 | 64 | 128 | 256;
  /** Threshold of the deblocking filter in codes, an integer in [0, 255]; default 35; 0: off. */
  deblocking?: number;
  /** Model of the time that a block takes: coefficients of starfocus_timing in picoseconds, integers in
   *  [0, 100000000]. The model decides how superblocks are split, and therefore affects the pictures. */
  timing?: {block?: number, field?: number, a?: number, b?: number, c?: number, upsample?: number, span?: number, hole?: number};
  /** Factor of the number of views along the radius of the aperture, for Mode.BLOCK and Mode.FRAME, [0.5, 2];
   *  default 1. */
  nScale?: number;
  /** True, the default: Mode.BLOCK blurs smooth surfaces without rendering views. */
  gather?: boolean;
  /** Brightness of clipped lamps relative to white, [1, 64]; default 1. */
  highlights?: number;
  /** True: unknown depth values (NaN, infinite, or DepthMap.invalid) are filled from their neighbours. False, the
   *  default: prepare() rejects maps with unknown values. */
  fillUnknown?: boolean;
  /** True: lenses may be polygons and have cat's eyes, which requires larger tables. Default false. */
  shapes?: boolean;
}

/** Options of createRefocuser. All but the settings are fixed for the lifetime of the refocuser. */
export interface Options extends Settings {
  /** Width of the views in pixels, an integer in [1, 65535]. */
  width: number;
  /** Height of the views in pixels, an integer in [1, 65535]. */
  height: number;
  /** Number of views. */
  views: 1 | 5 | 9 | 17;
  /** Smallest disparity that a depth map may contain, in pixels, within +-500. Nearer points have larger
   *  disparities. */
  disparityMin: number;
  /** Largest disparity that a depth map may contain, in pixels, within +-500. */
  disparityMax: number;
  /** Largest shift of Refocuser.preview; default 0: no previews. Each preview size requires more memory. */
  previews?: 0 | 1 | 2 | 3;
  /** Largest layer L of Mode.BLOCK; default 2. */
  maxLayer?: 0 | 1 | 2;
  /** A value of Transfer; default Transfer.SRGB. */
  transfer?: 0 | 1;
  /** Number of threads, including the thread that receives the calls, an integer in [1, 64]. The default is the number
   *  of cores. Pages that are not cross-origin isolated cannot share memory and always use 1 thread. */
  threads?: number;
}

/** A view: an ImageData, or rows of R, G, B or of R, G, B, A without gaps, 8 bits per sample. All views of a light
 *  field have the same number of bytes per pixel. */
export type View = ImageData | Uint8Array | Uint8ClampedArray;

/** Depth map of the centre view, as large as the picture or smaller. */
export interface DepthMap {
  /** width * height values, row by row. */
  data: Float32Array | Uint16Array | Uint8Array | Uint8ClampedArray;
  /** Width of the map, an integer in [1, width of the picture]; default: the width of the picture. */
  width?: number;
  /** Height of the map, an integer in [1, height of the picture]; default: the height of the picture. */
  height?: number;
  /** Scale of the values: disparity = scale * value + offset, or scale / value + offset if `reciprocal` is true. Finite
   *  and not 0; rounded to single precision; default 1. */
  scale?: number;
  /** Offset of the disparities (see `scale`). Finite; rounded to single precision; default 0. */
  offset?: number;
  /** True: the values are distances. Default false. */
  reciprocal?: boolean;
  /** A value that stands for unknown depth, as NaN does: see Settings.fillUnknown. Default: none. */
  invalid?: number;
}

/** Options of calls that can be cancelled. */
export interface Call {
  /** Cancels the call, which then rejects with the reason of the signal. A call that has not started yet ends at
   *  once. A running call ends within a few milliseconds if memory is shared. If memory is not shared, refocus() ends
   *  after at most 512 more rows. In this case, a running prepare(), a preview, or a refocus() with `region` or
   *  `blocks` completes. */
  signal?: AbortSignal;
}

/** Parameters of one refocusing. All lens fields are checked, even if the shape does not use them. */
export interface Params extends Call {
  /** Disparity in focus, in pixels, within +-1000000; default 0. */
  focus?: number;
  /** Radius of the aperture, [0, 1]. 1, the default, reaches the outermost views; 0 gives the centre view. */
  aperture?: number;
  /** A value of Shape; default Shape.FALL_OFF. Shape.POLYGON requires Settings.shapes. */
  shape?: 0 | 1 | 2 | 3;
  /** Polygon: number of corners, an integer in [3, 12]; default 5. */
  blades?: number;
  /** Fall-off: angle in radians, [0.05 pi, 0.45 pi]; default 0.26 pi. */
  theta?: number;
  /** Polygon: clockwise rotation in degrees, [-360, 360]; default 0: a corner points up. */
  rotation?: number;
  /** Polygon: curvature of the edges, from 0, the default (straight), to 1 (a disc). */
  curvature?: number;
  /** Ring: radius of the hole divided by the radius of the disc, [0, 0.9]; default 0.5. */
  ringInner?: number;
  /** Cat's eye: distance of a second rim from the axis, in radii of the lens, as seen from a corner of the picture,
   *  [0, 1]; default 0. Values above 0 require Settings.shapes. */
  catsEye?: number;
  /** A value of Mode; default Mode.BLOCK. */
  mode?: 0 | 1 | 2 | 3;
  /** A value of Renderer; default Renderer.AUTO. */
  renderer?: 0 | 1 | 2;
  /** Part of the picture to compute, in pixels of the full picture. Four zeros, the default, mean the whole picture. */
  region?: {x: number, y: number, width: number, height: number};
  /** True: Picture.blocks lists the blocks of the picture, at most the first 65536. Default false. */
  blocks?: boolean;
}

/** A block of a picture. Positions and sizes are in pixels of the picture. */
export interface Block {
  /** Left column. */
  x: number;
  /** Top row. */
  y: number;
  /** Number of columns. */
  width: number;
  /** Number of rows. */
  height: number;
  /** Layer L: the block is rendered at 1 / 2^L of its size. */
  layer: number;
  /** Number of views along the radius of the aperture; 0: the centre view only. */
  n: number;
}

/** A refocused picture. The caller owns the picture, and the refocuser keeps no reference to it. */
export interface Picture {
  /** Rows of R, G, B, A without gaps. A is the alpha of the centre view, or 255 if the views have no alpha. In
   *  previews, A is 255. */
  data: Uint8ClampedArray;
  /** Width in pixels. */
  width: number;
  /** Height in pixels. */
  height: number;
  /** The blocks, if Params.blocks is true. */
  blocks?: Block[];
  /** Elapsed time in the worker, in milliseconds. */
  milliseconds: number;
}

/** An error that the C library reports. Arguments of the wrong type are reported as TypeError. */
export declare class StarfocusError extends Error {
  /** The starfocus_status of the C call. */
  readonly status: number;
  /** Field or argument that is wrong, with its C name; "" if no single one is wrong. */
  readonly field: string;
}

/** An engine in a worker, with at most one light field. Calls may be made at any time, and run one at a time in the
 *  order in which they were made. Create a refocuser with createRefocuser, and free it with close(). */
export interface Refocuser {
  /** Version of the library, for example "0.1.0". */
  readonly version: string;
  /** Number of threads. */
  readonly threads: number;

  /** Prepares a light field for refocusing. The new light field replaces the previous one, even if the engine rejects
   *  the new light field.
   *  @param views views in the order of starfocus_view_position (centre, right, left, below, above, ...)
   *  @param depth depth map; a Float32Array contains disparities and has the size of the picture
   *  @param options `coverage`: optional alpha of the foreground, one byte per pixel of the centre view, as matting
   *      networks compute it: the part of the pixel that the nearer of two surfaces covers (255: all). Near depth
   *      edges, coverage takes precedence over the depth map. `transfer`: if true, the buffers of all arrays are
   *      transferred to the worker and are empty afterwards; a depth map that must be converted is copied. Default
   *      false: arrays are copied.
   *  @return elapsed time in the worker, in milliseconds
   *  @throws TypeError for arrays of the wrong type or size; StarfocusError, for example if a disparity is outside
   *      [disparityMin, disparityMax] or memory could not be allocated */
  prepare(views: View[], depth: Float32Array | DepthMap,
          options?: Call & {coverage?: Uint8Array | Uint8ClampedArray, transfer?: boolean}): Promise<{milliseconds: number}>;

  /** Changes settings. Creates a new engine and keeps the light field. Omitted settings keep their values.
   *  @throws StarfocusError for values out of range, after which all settings keep their values; TypeError for options
   *      that are fixed */
  configure(settings: Settings): Promise<void>;

  /** Refocuses at 1 / 2^shift of the size, which takes about 1 / 4^shift of the time. All parameters are in pixels of
   *  the full picture.
   *  @param params parameters; `shift` is at most Options.previews and has the default 1
   *  @throws TypeError if no light field is prepared; StarfocusError for values out of range */
  preview(params?: Params & {shift?: 1 | 2 | 3}): Promise<Picture>;

  /** Refocuses at full size.
   *  @param params parameters. `onProgress` receives the number of finished rows and of all rows: every 50 ms if memory
   *      is shared, otherwise every 512 rows, and then not for calls with `region` or `blocks`
   *  @throws TypeError if no light field is prepared; StarfocusError for values out of range */
  refocus(params?: Params & {onProgress?: (rowsDone: number, rows: number) => void}): Promise<Picture>;

  /** Returns the disparity to focus at for a pixel of the depth map, for example where a user tapped: the median
   *  disparity of the surface at this pixel.
   *  @param x column of the depth map, an integer in [0, its width)
   *  @param y row of the depth map, an integer in [0, its height)
   *  @throws TypeError if x or y is not an integer, or no light field is prepared; StarfocusError if the pixel is
   *      outside the map, or a disparity up to 3 pixels away is unknown */
  focusAt(x: number, y: number): Promise<number>;

  /** Ends the workers and frees their memory. Calls that have not completed reject with an Error. */
  close(): void;
}

/** Starts the workers and creates a refocuser.
 *  @throws TypeError for unknown options, and if the environment does not support WebAssembly with SIMD; StarfocusError
 *      for values out of range; Error if a worker could not be loaded */
export declare function createRefocuser(options: Options): Promise<Refocuser>;
