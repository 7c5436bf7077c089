// SPDX-License-Identifier: Apache-2.0
// Types of the npm package starfocus, which refocuses photos with depth, and light fields of 2 to 17 views. The engine
// runs in a worker, so all calls are asynchronous.
//
// createRefocuser gives access to all settings of the engine. Its options, settings and parameters are the fields of
// starfocus_config, starfocus_tuning, starfocus_params and starfocus_study in C, with JavaScript names: max_blur is
// maxBlur. A field has the same meaning, range and default as in C, and pictures have the same bytes as pictures of the
// C library. An omitted field has its default.

/** The instance type of a global class, or never if this environment has no such class. */
type Global<Name extends string> = typeof globalThis extends Record<Name, {prototype: infer Instance}> ? Instance : never;

/** A Uint8ClampedArray on an ArrayBuffer, which the constructor of ImageData expects. */
type Bytes = ReturnType<typeof Uint8ClampedArray.of>;
/** A Float32Array on an ArrayBuffer. */
type Floats = ReturnType<typeof Float32Array.of>;

/** The key of a well-known symbol for `using`, or never if the library of the compiler lacks the symbol. */
type DisposeKey<Name extends string> = SymbolConstructor extends Record<Name, infer Key extends symbol> ? Key : never;

/** Objects that end with `using` and `await using`. */
export type Disposables = {[Key in DisposeKey<'dispose'>]: () => void} & {[Key in DisposeKey<'asyncDispose'>]: () => Promise<void>};

/** An AbortSignal. */
export interface Signal {
  readonly aborted: boolean;
  readonly reason: any;
  addEventListener(type: 'abort', listener: () => void): void;
  removeEventListener(type: 'abort', listener: () => void): void;
}

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
  /** Side of the superblocks in pixels. The engine splits superblocks into blocks. The default 0 means 128. */
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
export interface Options extends Settings, WorkerOptions {
  /** Width of the views in pixels, an integer in [1, 65535]. */
  width: number;
  /** Height of the views in pixels, an integer in [1, 65535]. */
  height: number;
  /** Number of views: 1, 5, 9 or 17 in the order of starfocus_view_position (centre, right, left, below, above, ...), or
   *  1 to 17 with `positions`. */
  views: number;
  /** Position of each view. Default: the positions of starfocus_view_position. */
  positions?: Positions;
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
}

/** Options of the worker. */
export interface WorkerOptions {
  /** Number of threads, including the thread that receives the calls, an integer in [1, 64]. The default is the number
   *  of cores. Pages that are not cross-origin isolated cannot share memory and always use 1 thread. */
  threads?: number;
  /** Browsers: address of a copy of `starfocus/worker`, of the same version, on the page's server. The default is a
   *  worker from a blob: URL, which a Content-Security-Policy may forbid. */
  worker?: string | Global<'URL'>;
}

/** Pixels in memory: rows without gaps. `data` has 3 bytes (R, G, B) or 4 bytes (R, G, B, A) per pixel. */
export interface Pixels {
  readonly data: Uint8Array | Uint8ClampedArray;
  /** Width in pixels. */
  readonly width: number;
  /** Height in pixels. */
  readonly height: number;
}

/** A view: pixels of the picture's size, for example an ImageData, or only their bytes. All views of a light field have
 *  the same number of bytes per pixel. */
export type View = Pixels | Uint8Array | Uint8ClampedArray;

/** [u, v] of each view, from -1 to 1. u grows to the right and v downwards. The first view is at [0, 0], and no two are
 *  equal. A stereo pair has [[0, 0], [1, 0]]. */
export type Positions = readonly (readonly [number, number])[];

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
  /** True: `data` is a Uint16Array in Android's format DEPTH16. The value is the distance in millimetres in the lower 13
   *  bits, where 0 is unknown; the confidence in the upper 3 bits is ignored. Default false. */
  depth16?: boolean;
}

/** Options of calls that can be cancelled. */
export interface Call {
  /** Cancels the call, which rejects at once with the reason of the signal. The worker ends the computation within a
   *  few milliseconds if memory is shared. Otherwise it ends after at most 512 more rows of the picture; in prepare(),
   *  openPhoto() and estimateDisparity(), another worker replaces it. */
  signal?: Signal;
}

/** Options of calls that report their progress. If the function throws, the call is cancelled and rejects with the
 *  thrown value. */
export interface Progress {
  /** Receives the finished part, as `done` of `total` steps: every 50 ms if memory is shared, otherwise every 512
   *  rows of a refocusing. */
  onProgress?: (done: number, total: number) => void;
}

/** The lens. All fields are checked, even if the shape does not use them. */
export interface Lens {
  /** Disparity in focus, in pixels, within +-1000000; default 0. */
  focus?: number;
  /** Extent of the range in focus on the near side of `focus`: disparities from focus to focus + focusNearer are sharp,
   *  and the blur of larger disparities grows with the distance from the range; [0, 1000000 - focus]; default 0. */
  focusNearer?: number;
  /** Extent of the range in focus on the far side of `focus`: disparities from focus - focusFarther to focus are sharp;
   *  [0, 1000000 + focus]; default 0. */
  focusFarther?: number;
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
}

/** Parameters of one refocusing. */
export interface Params extends Lens, Call {
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

/** A refocused picture. The caller owns the picture, and the package keeps no reference to it. */
export interface Picture {
  /** Rows of R, G, B, A without gaps. A is the alpha of the centre view. A is 255 in previews, if the views have no alpha,
   *  and if the depth was repaired. */
  readonly data: Bytes;
  /** Width in pixels. */
  readonly width: number;
  /** Height in pixels. */
  readonly height: number;
  /** The picture has 1 / 2^shift of the full size; 0 for full pictures. */
  readonly shift: number;
  /** The blocks, if Params.blocks is true. */
  readonly blocks?: Block[];
  /** Elapsed time in the worker, in milliseconds. */
  readonly milliseconds: number;
  /** Browsers: returns an ImageData that shares `data`.
   *  @throws StarfocusError with the code UNSUPPORTED in node */
  toImageData(): Global<'ImageData'>;
  /** Browsers: returns an ImageBitmap, which canvases draw at any size.
   *  @throws StarfocusError with the code UNSUPPORTED in node */
  toImageBitmap(): Promise<Global<'ImageBitmap'>>;
  /** Browsers: encodes the picture.
   *  @param options `type`: 'image/jpeg', the default, or another type that canvases can encode; `quality`: 0 to 1,
   *      default 0.92
   *  @throws StarfocusError with the code UNSUPPORTED in node */
  toBlob(options?: {type?: string, quality?: number}): Promise<Global<'Blob'>>;
}

/** Codes of StarfocusError.
 *  ARGUMENT: an argument has the wrong type, is missing or has an unknown name. RANGE: a value is out of range.
 *  FEATURE: the parameter requires a setting, for example `shapes`. BLUR: the blur of the lens exceeds `maxBlur`.
 *  DISPARITY: a disparity is outside disparityMin and disparityMax. NOT_FINITE: a disparity is unknown, or all are.
 *  STATE: no light field is prepared. CLOSED: close() was called. MEMORY: memory could not be allocated. DECODE: a
 *  picture file could not be decoded. UNSUPPORTED: this environment lacks a feature. WORKER: the worker could not be
 *  loaded. INTERNAL: an error of the package. */
export type ErrorCode = 'ARGUMENT' | 'RANGE' | 'FEATURE' | 'BLUR' | 'DISPARITY' | 'NOT_FINITE' | 'STATE' | 'CLOSED' |
    'MEMORY' | 'DECODE' | 'UNSUPPORTED' | 'WORKER' | 'INTERNAL';
export declare const ErrorCode: {readonly [Code in ErrorCode]: Code};

/** Every error of the package, except the reason of an aborted signal and values that onProgress throws. */
export declare class StarfocusError extends Error {
  /** Kind of the error. */
  readonly code: ErrorCode;
  /** Option, parameter or argument that is wrong, for example 'fStop' or 'views[2]'; '' if no single one is wrong. */
  readonly field: string;
  /** The wrong value, if it is known. */
  readonly value: unknown;
}

/** An engine in a worker, with at most one light field. Calls may be made at any time, and run one at a time in the
 *  order in which they were made. Create a refocuser with createRefocuser, and free it with close(). */
export interface Refocuser extends Disposables {
  /** Version of the library, for example "0.1.0". */
  readonly version: string;
  /** Number of threads. */
  readonly threads: number;

  /** Prepares a light field for refocusing. The new light field replaces the previous one, even if the call fails or is
   *  cancelled.
   *  @param views views in the order of Options.positions, or of starfocus_view_position
   *  @param depth depth map; a Float32Array contains disparities and has the size of the picture
   *  @param options `coverage`: optional alpha of the foreground, one byte per pixel of the centre view, as matting
   *      networks compute it: the part of the pixel that the nearer of two surfaces covers (255: all). Near depth
   *      edges, coverage takes precedence over the depth map. `repair`: if true, noise and misplaced edges of the map
   *      are corrected (starfocus_repair_disparity), which takes about a second per megapixel; default false. Maps of
   *      several views with Options.positions cannot be repaired.
   *      `transfer`: if true, the buffers of all arrays are transferred to the worker and are empty afterwards. Default
   *      false: arrays are copied.
   *  @return elapsed time in the worker, in milliseconds
   *  @throws StarfocusError, for example with the code DISPARITY and the position of a disparity outside
   *      [disparityMin, disparityMax] */
  prepare(views: readonly View[], depth: Float32Array | DepthMap,
          options?: Call & Progress & {coverage?: Uint8Array | Uint8ClampedArray, repair?: boolean, transfer?: boolean}):
      Promise<{milliseconds: number}>;

  /** Changes settings. Creates a new engine and keeps the light field. Omitted settings keep their values.
   *  @throws StarfocusError for values out of range or if memory is too small, after which all settings keep their
   *      values, and for options that are fixed */
  configure(settings: Settings): Promise<void>;

  /** Refocuses at 1 / 2^shift of the size, which takes about 1 / 4^shift of the time. All parameters are in pixels of
   *  the full picture.
   *  @param params parameters; `shift` is at most Options.previews and has the default 1
   *  @throws StarfocusError for values out of range, or if no light field is prepared */
  preview(params?: Params & {shift?: 1 | 2 | 3}): Promise<Picture>;

  /** Refocuses at full size.
   *  @throws StarfocusError for values out of range, or if no light field is prepared */
  refocus(params?: Params & Progress): Promise<Picture>;

  /** Returns the disparity to focus at for a point of the picture, for example where a user tapped: the median
   *  disparity of the surface there.
   *  @param point position in pixels of the picture, 0 <= x < width and 0 <= y < height
   *  @throws StarfocusError if the point is outside the picture, or all disparities up to 3 pixels away are unknown */
  focusAt(point: Point): Promise<number>;

  /** Returns a copy of the disparity map of the light field, after a repair. */
  disparity(): Promise<{data: Floats, width: number, height: number}>;

  /** Ends the workers and frees their memory. Calls that have not completed reject with the code CLOSED. An open
   *  refocuser does not keep node running. */
  close(): void;
}

/** A position in pixels of the picture. Fractions are allowed. */
export interface Point {
  readonly x: number;
  readonly y: number;
}

/** Starts the workers and creates a refocuser.
 *  @throws StarfocusError for wrong options, with the code UNSUPPORTED if the environment does not support WebAssembly
 *      with SIMD, or with the code WORKER if a worker could not be loaded */
export declare function createRefocuser(options: Options): Promise<Refocuser>;

/** A picture for openPhoto: pixels in memory in all environments; picture files (Blob, File), images, bitmaps and
 *  canvases in browsers. */
export type Source = Pixels | Global<'Blob'> | Global<'ImageBitmap'> | Global<'HTMLImageElement'> |
    Global<'HTMLCanvasElement'> | Global<'OffscreenCanvas'>;

/** Depth for openPhoto: a source whose red channel, or only channel, is the depth. In a PNG file with 16 bits of grey,
 *  all bits are used. */
export type DepthSource = Source | {
  /** width * height values, or 3 or 4 bytes per pixel. NaN is unknown. */
  readonly data: Uint8Array | Uint8ClampedArray | Uint16Array | Float32Array;
  /** Width in pixels, at most the width of the picture. */
  readonly width: number;
  /** Height in pixels, at most the height of the picture. */
  readonly height: number;
};

/** A matte for openPhoto: the alpha of the subject, of any size with the proportions of the picture, or square. In
 *  pictures, the alpha channel counts unless it is opaque everywhere. Otherwise, grey levels count. */
export type MatteSource = Source | {
  /** width * height values from 0 (background) to 1 (floats) or to the largest integer (subject); or 3 or 4 bytes per
   *  pixel. */
  readonly data: Uint8Array | Uint8ClampedArray | Uint16Array | Float32Array;
  /** Width in samples. */
  readonly width: number;
  /** Height in samples. */
  readonly height: number;
};

/** Options of openPhoto for a photo with a matte and without depth. */
export interface MatteOptions extends WorkerOptions, Call, Progress {
  /** Alpha of the subject. */
  matte: MatteSource;
  /** True: the background comes nearer towards the lower edge of the picture, so that the ground on which the subject
   *  stands stays sharp. Default false: the background is infinitely far. */
  floor?: boolean;
  /** Blur radius at f/1 of the background if the subject is in focus (see PhotoOptions.blur). */
  blur?: number;
}

/** Options of openPhoto. */
export interface PhotoOptions extends WorkerOptions, Call, Progress {
  /** The end of the depth values that is near: 'bright', the large values, or 'dark'. Default: 'bright' if the lower
   *  third of the depth picture is brighter than the upper third. Photo.near has the result. */
  near?: 'bright' | 'dark';
  /** Blur radius at f/1 of the farthest point if the nearest point is in focus, divided by the diagonal of the picture,
   *  (0, 1]. The default, 0.0193, is the blur of a 50 mm lens on full frame if the nearest point is 1.5 m away. */
  blur?: number;
  /** True: depth values are disparities in pixels, as in light fields, within +-499, and `near` and `blur` do not apply.
   *  Default false: depth values have any unit. */
  disparity?: boolean;
  /** Position of each view, for 2 to 17 views. Default: the positions of starfocus_view_position. */
  positions?: Positions;
  /** True: the depth is repaired (see Refocuser.prepare). Default: true unless `disparity` is true. */
  repair?: boolean;
  /** Alpha of the subject. At the outlines of the subject, the matte takes precedence over the depth
   *  (starfocus_matte_coverage). Default: none. With a matte, disparities that are not repaired must be known. */
  matte?: MatteSource;
}

/** Lens of Photo.refocus. */
export interface PhotoLens extends Lens {
  /** Disparity in focus, from Photo.focusMin (far) to Photo.focusMax (near), or up to one pixel beyond. */
  focus: number;
  /** f-stop, at least Photo.fStopMin. The default is 1.8, or 1 if PhotoOptions.disparity is true, or Photo.fStopMin if
   *  that is larger. The aperture is 1 / fStop, unless `aperture` is present. */
  fStop?: number;
  /** Brightness of clipped lamps relative to white, [1, 64]; default 1. */
  highlights?: number;
  /** True: Picture.blocks lists the blocks of the full picture. Default false. */
  blocks?: boolean;
}

/** A refocusing that has been requested, and starts when it is iterated or awaited. The iteration yields a preview and
 *  then the full picture; the promise resolves with the full picture. If Photo.refocus is called again, the iteration
 *  ends without further pictures, and the promise rejects with an AbortError. */
export interface Refocusing extends PromiseLike<Picture>, AsyncIterable<Picture> {
  catch<Other>(reject: (reason: any) => Other | PromiseLike<Other>): Promise<Picture | Other>;
  finally(settled: () => void): Promise<Picture>;
}

/** A photo with depth, or a light field, that is ready to be refocused. */
export interface Photo extends Disposables {
  /** Width of the picture in pixels. */
  readonly width: number;
  /** Height of the picture in pixels. */
  readonly height: number;
  /** Focus of the farthest point. */
  readonly focusMin: number;
  /** Focus of the nearest point. */
  readonly focusMax: number;
  /** Focus of the subject of the matte, or undefined without a matte or if the depth there is unknown. */
  readonly subjectFocus?: number;
  /** Smallest f-stop: 1, or more if the blur at f/1 would exceed 128 pixels. */
  readonly fStopMin: number;
  /** The end of the depth values that is near. For a photo with a matte and without depth: 'bright'. */
  readonly near: 'bright' | 'dark';
  /** Version of the library. */
  readonly version: string;
  /** Number of threads. */
  readonly threads: number;
  /** Returns the focus for a point of the picture, as Refocuser.focusAt. The call waits for earlier requests. A signal
   *  can cancel a running request, so that the focus is known at once. */
  focusAt(point: Point): Promise<number>;
  /** Requests a picture. A new request cancels the previous one.
   *  @throws StarfocusError for a missing focus and values out of range */
  refocus(lens: PhotoLens, options?: Call & Progress): Refocusing;
  /** Returns a copy of the disparity map, after a repair. */
  disparity(): Promise<{data: Floats, width: number, height: number}>;
  /** Ends the workers and frees their memory. An open photo does not keep node running. */
  close(): void;
}

/** Opens a photo with depth: decodes the pictures, converts and repairs the depth, and prepares the engine, so that the
 *  first refocusing is fast.
 *  @param image the photo; or, with the option `disparity`, an array of 5, 9 or 17 views in the order of
 *      starfocus_view_position, or of as many views as the option `positions` has
 *  @param depth the depth of the photo, at most as large as the photo
 *  @param options options
 *  @throws StarfocusError, for example with the code DECODE if a file is not a picture; the reason of `signal` if the
 *      signal is aborted */
export declare function openPhoto(image: Source | readonly Source[], depth: DepthSource, options?: PhotoOptions): Promise<Photo>;
/** Opens a photo with a matte and without depth. The subject and the background become two surfaces, and the matte their
 *  coverage. */
export declare function openPhoto(image: Source, options: MatteOptions): Promise<Photo>;

/** Options of estimateDisparity. */
export interface EstimateOptions extends WorkerOptions, Call, Progress {
  /** Position of each view. Default: the positions of starfocus_view_position, for 5, 9 or 17 views. */
  positions?: Positions;
  /** Smallest disparity, in pixels, within +-500. Default: the smallest disparity that is found in reduced views, at
   *  least minus an eighth of the width. */
  disparityMin?: number;
  /** Largest disparity, in pixels, within +-500. Default: the largest disparity that is found in reduced views, at most
   *  an eighth of the width. */
  disparityMax?: number;
}

/** Estimates the disparities of several views (starfocus_estimate_disparity), for openPhoto with the option
 *  `disparity`. The views must be rectified: points must have equal heights in views beside each other.
 *  @param images views, of which the first is the centre
 *  @param options options
 *  @return the map of the first view
 *  @throws StarfocusError, for example for views of different sizes; the reason of `signal` if the signal is aborted */
export declare function estimateDisparity(images: readonly Source[], options?: EstimateOptions): Promise<{data: Floats, width: number, height: number}>;
