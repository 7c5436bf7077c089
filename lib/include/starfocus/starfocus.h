/* SPDX-License-Identifier: Apache-2.0 */
/* starfocus: refocusing for sparse light fields. C ABI.
 *
 * Given 1 to 17 rectified 8-bit views, those of the paper's star or any others such as a stereo
 * pair, and the disparity map of the centre view, the engine computes the picture that a lens of
 * aperture radius `aperture`, focused at disparity `focus`, would have taken (Huang et al., "Fast
 * Physically-Correct Refocusing for Sparse Light Fields Using Block-Based Multi-Rate View
 * Interpolation"; equations are cited as in the paper).
 *
 * Use:
 *   1. sf_config_init, fill the fields in, sf_workspace_size.
 *   2. Allocate that many bytes, aligned to SF_ALIGNMENT, and sf_init. The engine lives in that
 *      memory: it never allocates, owns nothing else and needs no destructor. Free the memory when
 *      no call is running. Or sf_create, which has an allocator do that, and sf_destroy.
 *   3. sf_refocus with whole pictures, or sf_stream_begin / sf_stream_push / sf_stream_pull with
 *      rows. Both give the same bytes. For many pictures of one light field there is sf_prepare,
 *      for a part of one sf_params.region, for frames of a video sf_params.previous.
 *
 * Conventions: u grows to the right, v downwards; no view lies beyond |u|, |v| = 1, where the
 * star's outermost ones are. Disparity d is in pixels per unit u, larger is nearer: a point seen at
 * (x, y) in the centre view is seen at (x - u*d, y - v*d) in view (u, v). The lens blurs it to a
 * disc of radius aperture * |d - focus| pixels. Strides are in bytes and may exceed the row length.
 * Zero all structures that have no init function, as by `= {0}`, and set what you need.
 *
 * Threads: an engine is used by one call at a time, of any thread; several engines are independent.
 * The engine starts no threads; it hands jobs to the runner of sf_set_callbacks, for which
 * starfocus/pool.h is one. Output bytes depend on neither the runner, the number of workers, the
 * SIMD target nor the way the rows come in.
 *
 * Errors: every function checks all its arguments before it writes anything but its own state. It
 * returns an sf_status, which says what kind of error it is. An sf_problem says which field or
 * argument was refused, what its value was and what was expected: set sf_config.problem and
 * sf_depth_config.problem for calls that take a configuration, and ask sf_engine_problem after
 * calls with an engine. SF_ERROR_STRUCTURE leaves sf_config.problem as it is.
 *
 * Bindings: refuse to run if sf_abi_version() is not SF_ABI_VERSION. Structures with `size` may get
 * fields at their end without a new version, all others are fixed within one. Enumerators are
 * passed as int. static inline functions are not exported: bindings call those with _sized instead.
 */
#ifndef STARFOCUS_STARFOCUS_H_
#define STARFOCUS_STARFOCUS_H_

#include <stddef.h>
#include <stdint.h>

#include "starfocus/callbacks.h"
#include "starfocus/image.h"
#include "starfocus/status.h"
#include "starfocus/tuning.h"
#include "starfocus/version.h"

#ifdef __cplusplus
extern "C" {
#endif

#define SF_ABI_VERSION 1u /**< grows when a public structure or the meaning of a call changes */
#define SF_ALIGNMENT 64   /**< of the workspace, bytes: the widest vector (AVX-512) */
#define SF_MAX_VIEWS 17   /**< largest number of captured views */
#define SF_MAX_SIZE 65535 /**< largest width and height in pixels */
#define SF_MAX_DISPARITY 500.0 /**< largest |disparity| in pixels per unit u */
#define SF_MAX_BLUR 128.0 /**< largest blur radius in pixels that a configuration may ask for */
#define SF_LAYERS 3       /**< number of subsampled layers, the original one included */
#define SF_MAX_WORKERS 64 /**< largest number of workers */

/** SF_ABI_VERSION the library was built with. */
SF_API uint32_t sf_abi_version(void);

/** SF_VERSION_STRING the library was built with, e.g. "0.1.0"; static storage. */
SF_API const char* sf_version(void);

/** Size in bytes of a public structure in the library, by its name, such as "sf_config"; 0 for
 *  unknown names. Bindings compare it with the structures they declare. */
SF_API size_t sf_struct_size(const char* name);

#define SF_MIN_THETA 0.15707963267948966 /**< 0.05 pi */
#define SF_MAX_THETA 1.413716694115407   /**< 0.45 pi */
#define SF_MAX_FOCUS 1.0e6
#define SF_MAX_HIGHLIGHTS 64.0
#define SF_MAX_PREVIEW 3
#define SF_MIN_BLADES 3
#define SF_MAX_BLADES 12
#define SF_MAX_RING_INNER 0.9
#define SF_FEATURE_LINE_SCAN 1u /**< the paper's renderer, SF_RENDERER_LINE_SCAN */
#define SF_FEATURE_COVERAGE 2u  /**< separates hair and thin structures from what is behind them */
#define SF_FEATURE_STREAMING 4u /**< sf_stream_*: reserves rings of rows */
#define SF_FEATURE_IMAGES 8u    /**< formats other than rows of R, G, B and of float disparities */
/** NaN and infinite values of disparity maps are unknown: each takes the nearest known value of its
 *  row; between two, that of the farther surface. A row without any is at disparity_min. Without
 * the feature they are refused, SF_ERROR_NOT_FINITE. sf_repair_disparity finds what the views show
 *  there, and sf_fill_disparity fills whole maps. */
#define SF_FEATURE_FILL_UNKNOWN 16u
/** Lenses may be polygons and have cat's eyes: reserves larger tables. Without it such lenses are
 *  refused, SF_ERROR_FEATURE. */
#define SF_FEATURE_SHAPES 32u

/** Where a captured view lies, in units of u. */
typedef struct sf_position {
  double u; /**< grows to the right */
  double v; /**< grows downwards */
} sf_position;

/** How the codes 0 to 255 of a picture stand for light, which is what a lens adds. A picture of one
 *  code keeps it; docs/library.md says when dark pixels may be one code off. */
typedef enum sf_transfer {
  SF_TRANSFER_SRGB = 0, /**< the curve of sRGB (IEC 61966-2-1), as in pictures of cameras: codes are
                             decoded to light of 15 bits as they are read, and light is coded where
                             a picture is written */
  SF_TRANSFER_NONE =
      1 /**< light is the code itself: codes are averaged as they are (the paper's) */
} sf_transfer;

/** What a workspace is made for. Call sf_config_init first: it sets `size` and the defaults. A
 * program whose header has fewer fields than the library gets their defaults; one whose header has
 * more is refused, SF_ERROR_STRUCTURE. */
typedef struct sf_config {
  uint32_t size;        /**< of the structure in bytes, set by sf_config_init */
  int32_t width;        /**< pixels, [1, SF_MAX_SIZE] */
  int32_t height;       /**< pixels, [1, SF_MAX_SIZE]; the workspace does not depend on it */
  int32_t views;        /**< captured views: 1, 5, 9 or 17 (see sf_view_position), or with positions
                             any number from 1 to SF_MAX_VIEWS; default 5 */
  double disparity_min; /**< smallest disparity any map may hold; default 0. A range wider than that
                            of the maps changes pictures: it raises N of the frame modes, and beyond
                            32 pixels of blur, slices get thicker */
  double disparity_max; /**< largest disparity any map may hold, >= disparity_min; default 0 */
  double max_blur;      /**< largest blur radius r = aperture * |d - focus| in pixels that will be
                             asked for, (0, SF_MAX_BLUR]; default 32. It reserves room and changes
                             no picture */
  int32_t superblock;   /**< side of the squares that a plan of blocks starts from, pixels: 32, 64,
                           128, 256, or 0, the default: 128 from a width of 1536 on, else 64. For wide
                           pictures 128 is up to an eighth faster; a worker's memory grows with the
                           square's area, from 1.15 MiB at 64 on. sf_report has what 0 chose */
  int32_t max_workers;  /**< workers the runner may use, [1, SF_MAX_WORKERS]; default 1 */
  uint32_t features; /**< bits of SF_FEATURE_, what the workspace has memory for; default LINE_SCAN
                        and COVERAGE. Without LINE_SCAN, SF_RENDERER_AUTO is SUBAPERTURE in all
                        modes, and SF_RENDERER_LINE_SCAN is refused, SF_ERROR_FEATURE */
  int32_t previews;  /**< largest sf_params.preview_shift, [0, SF_MAX_PREVIEW]: sf_prepare then
                        keeps the light field at 1/2, 1/4 and 1/8 of its size, up to that; default
                        0: none. The workspace does not grow by it */
  int32_t transfer;  /**< sf_transfer: how codes of the pictures stand for light; default
                        SF_TRANSFER_SRGB */
  double highlights; /**< how many times white the lamps are that pictures clip,
                       [1, SF_MAX_HIGHLIGHTS]; default 1: as white as they look. Pixels two of whose
                       codes are 251 or more count, the brighter the more, up to clipped ones.
                       White areas wider and higher than a 32nd of the picture's width (16 to 128
                       pixels) count less, from twice as much on not at all: walls do not glow */
  /** Where the `views` captured views lie: each coordinate in [-1, 1], rounded to 1/16384, no two
   *  alike, the first one (0, 0). All 0, the default: where sf_view_position tells. What lies
   *  behind an edge is read from the best view that sees it, and filled where none does.
   *  SF_RENDERER_LINE_SCAN and starfocus/depth.h need the star. */
  sf_position positions[SF_MAX_VIEWS];
  sf_tuning tuning; /**< in the structure, so that copies of a configuration need no care */
  /** Where a call with this configuration tells what it refuses; null, the default: nowhere. Calls
   *  with an engine do not use it: see sf_engine_problem. */
  sf_problem* problem;
} sf_config;

/** Sets the first `size` bytes of a configuration, as many as the caller's header knows. For
 *  bindings; programs in C and C++ call sf_config_init. */
SF_API void sf_config_init_sized(sf_config* config, uint32_t size);

static inline void sf_config_init(sf_config* config) {
  sf_config_init_sized(config, (uint32_t)sizeof(sf_config));
}

/** Position (u, v) of view `index` of the star; those of 1, 5 and 9 are the first of the 17:
 *  0 centre; 1-4 (+1,0) (-1,0) (0,+1) (0,-1); 5-8 (+1,+1) (-1,+1) (+1,-1) (-1,-1); 9-16 the same
 *  eight at half the distance. False when index is outside [0, SF_MAX_VIEWS) or u or v is null. */
SF_API int sf_view_position(int32_t index, double* u, double* v);

/** Bytes of workspace for `config` into *bytes. Independent of config->height. */
SF_API sf_status sf_workspace_size(const sf_config* config, size_t* bytes);

/** The engine; lives inside the caller's workspace. */
typedef struct sf_engine sf_engine;

/** Makes an engine in `workspace` (`bytes` long, aligned to SF_ALIGNMENT), which stays the
 *  caller's and must outlive the engine's use. *engine is null on error. */
SF_API sf_status sf_init(const sf_config* config, void* workspace, size_t bytes,
                         sf_engine** engine);

/** What the engine's last call refused, in the engine's memory; null if `engine` is. The next call
 *  with the engine overwrites it. */
SF_API const sf_problem* sf_engine_problem(const sf_engine* engine);

/** Sets the functions that all later calls with this engine use, in place of those set before; also
 *  between the calls of a stream. An engine starts without any. The structure need not stay. */
SF_API sf_status sf_set_callbacks(sf_engine* engine, const sf_callbacks* callbacks);

/** Where sf_create takes memory from. */
typedef struct sf_allocator {
  void* data; /**< passed to both */
  /** Returns `bytes` of memory aligned to `alignment`, SF_ALIGNMENT, or null without any. */
  void* (*allocate)(void* data, size_t bytes, size_t alignment);
  /** Takes back what allocate gave, with the same `bytes`; never null. */
  void (*release)(void* data, void* memory, size_t bytes);
} sf_allocator;

/** sf_workspace_size and sf_init in one: makes an engine in memory that it takes from `allocator`
 *  (null: malloc and free), in one piece, and that sf_destroy gives back. Nothing else ever
 *  allocates. *engine is null on error: one of those two functions', SF_ERROR_MEMORY when there is
 * no memory, SF_ERROR_NULL when a function of the allocator is null. */
SF_API sf_status sf_create(const sf_config* config, const sf_allocator* allocator,
                           sf_engine** engine);

/** Ends an engine of sf_create's, in which no call may be running, and gives its memory back. Of
 * null and of engines of sf_init's, whose memory is the caller's, it does nothing. */
SF_API void sf_destroy(sf_engine* engine);

typedef enum sf_mode {
  SF_MODE_FRAME = 0, /**< one N for the whole picture, from (9) */
  SF_MODE_BENCHMARK =
      1,             /**< one N = 2 * ceil(r_max): the paper's objective quality benchmark; the
                        renderer says whether views show fine slices or are rendered line by line */
  SF_MODE_BLOCK = 2, /**< blocks of variable size, each with its own N and layer (section V).
                        Half-band filters of layers 1 and 2 overshoot: a picture may leave the
                        range of its views' light by 4 % of that range with slices and
                        13 % with line scans, 4 and 40 % through other openings than the
                        default. With SF_TRANSFER_SRGB dark codes differ by more: 4 %
                        of white are the codes up to 56. The other modes stay in the range */
  SF_MODE_BLUR = 3 /**< the centre view alone, blurred by (4): up to ten times the time of blocks */
} sf_mode;

/** What renders views, and so how many of them a blur radius needs. */
typedef enum sf_renderer {
  SF_RENDERER_AUTO =
      0, /**< LINE_SCAN for SF_MODE_FRAME of a star of 5 or more views, else SLICES */
  SF_RENDERER_LINE_SCAN = 1, /**< the paper's: views at most a pixel or so apart (9), rendered line
                                  by line (IV). Needs SF_FEATURE_LINE_SCAN and the views of
                                  sf_view_position */
  SF_RENDERER_SLICES = 2     /**< each view stands for its subaperture, however wide, and shows
                                  slices of the scene */
} sf_renderer;

/** A rectangle inside the picture, in pixels; all 0: the whole picture. */
typedef struct sf_region {
  int32_t x, y, width, height; /**< its left and top pixel, >= 0, and its size, >= 1 */
} sf_region;

/** What the opening of the lens looks like, in the disc of radius u_t. */
typedef enum sf_shape {
  SF_SHAPE_FALL_OFF = 0, /**< the paper's (3): the disc, darker towards its rim by theta */
  SF_SHAPE_DISC = 1,     /**< the disc, as bright everywhere */
  SF_SHAPE_POLYGON = 2,  /**< of `blades` blades, `rotation` and `curvature`; its corners lie on
                            the disc's rim. Needs SF_FEATURE_SHAPES */
  SF_SHAPE_RING = 3      /**< the disc less one of radius `ring_inner`: a mirror lens */
} sf_shape;

/** The lens of a refocusing. It may differ from call to call; the engine makes its tables again for
 *  the first call after any of shape, blades, theta, rotation, curvature and ring_inner changed.
 *  All fields are checked, also those that other shapes have. */
typedef struct sf_lens {
  double focus;    /**< disparity d_t in focus, finite, |d_t| <= SF_MAX_FOCUS; default 0 */
  double aperture; /**< radius u_t, [0, 1]; 0: the centre view to the byte; default 1 */
  int32_t shape;   /**< sf_shape; default SF_SHAPE_FALL_OFF. theta belongs to that alone, the fields
                      below to the others. With a polygon and with cats_eye nothing is gathered */
  int32_t blades;  /**< of a polygon, [SF_MIN_BLADES, SF_MAX_BLADES]; default 5 */
  double theta;    /**< fall-off of the aperture (3) in radians, [SF_MIN_THETA, SF_MAX_THETA];
                      default 0.26 pi */
  double rotation; /**< of a polygon in degrees, [-360, 360]; 0, the default: a corner at the top of
                     the lens, (0, -1); more turns it clockwise, to the right */
  double curvature;  /**< of a polygon's edges, the disc's radius over theirs, [0, 1]; default 0:
                       straight; 1: the disc */
  double ring_inner; /**< of a ring: radius of its hole over u_t, [0, SF_MAX_RING_INNER]; default
                       0.5 */
  double cats_eye; /**< how far a second rim, as wide as the disc, lies beside the lens in radii, as
                     it is seen from the picture's corners, [0, 1]; less towards the middle: light
                     passes both. Pictures do not get darker by it, SF_MODE_BLUR does without it.
                     Above 0 it needs SF_FEATURE_SHAPES; default 0: there is none */
} sf_lens;

/** A light field. All views have the configured width and height; their formats may differ. */
typedef struct sf_light_field {
  sf_image views[SF_MAX_VIEWS]; /**< the configured number, in the order of sf_view_position or
                                     sf_config.positions */
  sf_depth_map depth;           /**< of the centre view */
  /** How much of each pixel of the centre view the nearer of two surfaces covers that meet there,
   *  255: all; as a matting network finds it. Within 32 pixels of depth edges of over 5 pixels it
   *  decides over the map. Null: there is none. Not looked at without SF_FEATURE_COVERAGE. */
  const uint8_t* coverage;
  size_t coverage_stride; /**< bytes from row to row, >= width */
} sf_light_field;

/** The frame before: a light field of the same configuration, and what was made of it with the same
 *  sf_params but for `previous`. That is not checked: the picture of another lens is copied where
 *  nothing changed. */
typedef struct sf_previous {
  sf_light_field light_field; /**< only compared */
  sf_image out;               /**< the picture, or region, that sf_refocus wrote */
} sf_previous;

/** What to render. Call sf_params_init first: it sets `size` and the defaults. Structures of other
 *  sizes are treated as those of sf_config. */
typedef struct sf_params {
  uint32_t size;         /**< of the structure in bytes, set by sf_params_init */
  int32_t mode;          /**< sf_mode; default SF_MODE_BLOCK */
  int32_t renderer;      /**< sf_renderer; SF_MODE_BLUR ignores it; default SF_RENDERER_AUTO */
  sf_region region;      /**< what is written; streaming: all 0; default all 0 */
  sf_lens lens;          /**< what focuses the picture */
  int32_t preview_shift; /**< sf_refocus_prepared: at 1 / 2^shift of the size; default 0 */
  /** sf_refocus: superblocks that depend on no pixel that changed since are copied from here, for
   *  the same bytes. Both light fields and both pictures are of the formats that need no
   *  SF_FEATURE_IMAGES (else SF_ERROR_FEATURE). Default null: nothing is known of a frame before.
   */
  const sf_previous* previous;
} sf_params;

/** Sets the first `size` bytes of params, as many as the caller's header knows. For bindings;
 *  programs in C and C++ call sf_params_init. */
SF_API void sf_params_init_sized(sf_params* params, uint32_t size);

static inline void sf_params_init(sf_params* params) {
  sf_params_init_sized(params, (uint32_t)sizeof(sf_params));
}

/** What the blocks of one layer did. */
typedef struct sf_layer_report {
  uint64_t blocks; /**< number of blocks */
  uint64_t pixels; /**< picture pixels they cover */
  uint64_t views;  /**< rendered views, summed over the blocks: 1 of a block copied or gathered
                        whole */
  uint64_t rendered_samples; /**< R, G, B samples of those views, by slices in each of them */
  uint64_t predicted_ps;     /**< by the timing model, picoseconds */
  uint64_t measured_ns;      /**< by sf_callbacks.clock, summed over workers; 0 without one */
} sf_layer_report;

/** Work that was left out because its result is known; all 0 with sf_tuning.skips = 0. */
typedef struct sf_skipped {
  uint64_t copied_blocks; /**< no rendered view moves a pixel: copied from the centre view */
  uint64_t copied_pixels; /**< picture pixels they cover */
  uint64_t filled_blocks, filled_pixels; /**< always 0: blocks of one colour are rendered */
  uint64_t layer_columns; /**< layers, columns of superblocks and stripes that no block reads */
  uint64_t boundaries;    /**< always 0: stripes of one layer are deblocked like others */
} sf_skipped;

/** What a refocusing did. */
typedef struct sf_report {
  double r_max;           /**< largest blur radius the configured disparity range allows, pixels */
  int32_t n;              /**< views along the aperture radius, N; the largest of any block */
  int32_t rendered_views; /**< views of i^2 + j^2 <= N^2 for that N */
  int32_t superblock;     /**< side of the superblocks in pixels: the configured one, or what 0
                                  chose */
  uint64_t rendered_samples; /**< R, G, B samples of all rendered views, summed over the layers */
  sf_layer_report layers[SF_LAYERS]; /**< by L; frame modes use L = 0 only */
  sf_skipped skipped;
  uint64_t centre_bytes; /**< read of the centre view, counted every time: by blocks with what lies
                              around them, and for layers 1 and 2; not what skips look at */
  uint64_t disparity_bytes; /**< read of the disparity map: nothing of a prepared light field. Rows
                                 of whole pictures and regions are read twice, first to be
                                 checked */
  uint64_t side_bytes;      /**< read of the views beside the centre, counted every time: in holes,
                                 beside depth edges and beyond the edges of the picture only */
  uint64_t gathered_pixels; /**< by sf_tuning.gather: blurred as a whole, no view is rendered */
  uint64_t reused_blocks;   /**< sf_params.previous: superblocks of which nothing was refocused */
  uint64_t unknown_pixels;  /**< values that SF_FEATURE_FILL_UNKNOWN filled, in the rows of the map
                                 that were read; none of a prepared light field */
} sf_report;

/** Refocuses whole pictures, or the params' region of them, whose bytes are those of the whole
 *  picture there. Of a region, only the blocks of the whole picture that its pixels depend on are
 *  refocused, and only the disparity rows that these can read are checked. The light field is only
 *  read, during the call. `out` is a picture of the region's size and must overlap neither the
 * light field, `params->previous` nor the workspace. Its alpha is that of the centre view, 255 if
 * that has none; its chroma is that of its own 2 x 2 pixels, wherever the region lies. report may
 * be null. */
SF_API sf_status sf_refocus(sf_engine* engine, const sf_params* params,
                            const sf_light_field* light_field, const sf_image* out,
                            sf_report* report);

/** What is made of a light field for every lens alike; it lives inside the caller's memory. */
typedef struct sf_prepared sf_prepared;

/** Bytes that a prepared light field of `config` takes, into *bytes: 2 per pixel of the picture for
 *  disparities and about 1.9 for layers 1 and 2, as far as max_layer allows them; and for each
 *  preview up to sf_config.previews 3 per view and 3 per pixel of its own. */
SF_API sf_status sf_prepared_size(const sf_config* config, size_t* bytes);

/** Checks and converts the disparities and subsamples the centre view, once for many refocusings,
 * in `memory` (`bytes` long, aligned to SF_ALIGNMENT), which stays the caller's. The refocusings
 * read the pictures of the light field again: what light_field points to must stay as it is until
 * the last one, the structure itself need not. `memory` must overlap neither it nor the workspace.
 * *prepared is null on error; `memory` is unspecified after SF_ERROR_CANCELLED and SF_ERROR_RUNNER.
 */
SF_API sf_status sf_prepare(sf_engine* engine, const sf_light_field* light_field, void* memory,
                            size_t bytes, sf_prepared** prepared);

/** As sf_refocus, with the same bytes, of a prepared light field; of this engine or of any of the
 *  same size, views and positions, disparity range, max_layer and transfer (else
 *  SF_ERROR_PREPARED). Several engines may use one at a time. `params->previous` must be null.
 *
 *  With a preview_shift it refocuses at 1 / S of the size, S = 2^shift, in about 1 / S^2 of the
 *  time; else `params` are in pixels of the full size as ever. `out` has the pixels that have a
 * part of the region: from x / S to (x + width - 1) / S, both rounded down, and rows likewise; its
 * alpha is 255. SF_ERROR_PREPARED when the light field was not prepared for that shift.
 *
 *  The preview is, byte for byte, what sf_refocus gives of the reduced light field, by an engine of
 *  its size and else of the same configuration (superblock as sf_report says), but for a
 *  disparity range, max_blur, focus and region divided by S. There a pixel of a view is the mean
 *  light, in 128ths of a 255th of white and then as a code, of the S x S pixels (fewer at the right
 *  and bottom edges) that it stands for, and a disparity the median of theirs, the larger of two in
 *  the middle, over S: a multiple of 1/64, halves rounded up, within the range. on_block, progress
 *  and the report count pixels of the preview. The light field's pictures are not read. */
SF_API sf_status sf_refocus_prepared(sf_engine* engine, const sf_params* params,
                                     const sf_prepared* prepared, const sf_image* out,
                                     sf_report* report);

/** Starts (or restarts) a streamed refocusing; the engine needs SF_FEATURE_STREAMING. */
SF_API sf_status sf_stream_begin(sf_engine* engine, const sf_params* params);

/** Copies up to `rows` next rows of the light field, at most as many as are left. Planes of views
 * and coverage point to the first of them. depth.height is always that of the whole map: if that is
 * the picture's, depth.data points to the first of the rows, too; a smaller map is given whole in
 * every call. *consumed <= rows tells how many fitted: pull finished rows and push the rest. Rows
 * that share chroma come together: where a view has some, `rows` is even but at the picture's end
 * (else SF_ERROR_RANGE), and so is *consumed. A row with a bad disparity value is refused: the rows
 * before it are consumed. Either all rows have coverage or none (else SF_ERROR_STATE). */
SF_API sf_status sf_stream_push(sf_engine* engine, const sf_light_field* light_field, int32_t rows,
                                int32_t* consumed);

/** Writes up to `rows` next finished rows to `out`, whose planes point to the first of them; where
 *  they share chroma, `rows` is even but at the picture's end. More rows than are left may be asked
 *  for. *written may be 0 until more rows are pushed. report may be null; it is complete once the
 *  last row is written.
 *  After SF_ERROR_RUNNER and SF_ERROR_CANCELLED the rows counted by *written are good, and the next
 *  pull goes on behind them. That pull tells on_block again of blocks that were half done; the
 * report counts them once (only centre_bytes may grow). sf_stream_begin and every other call with
 * the engine but sf_set_callbacks end the stream. progress counts rows of the whole picture. */
SF_API sf_status sf_stream_pull(sf_engine* engine, const sf_image* out, int32_t rows,
                                int32_t* written, sf_report* report);

/** What sf_measure_disparity finds in a disparity map. */
typedef struct sf_disparity_stats {
  double min, max; /**< smallest and largest finite value; 0 when there is none */
  int64_t invalid; /**< number of NaN and infinite values */
} sf_disparity_stats;

SF_API sf_status sf_measure_disparity(const float* disparity, size_t stride, int32_t width,
                                      int32_t height, sf_disparity_stats* stats);

/** Replaces every non-finite value, in place, by its nearest valid neighbour to the left or right
 *  (of one on either side, the farther surface: the smaller disparity); rows without a valid value
 *  are filled from the nearest valid rows above and below by the same rule. SF_ERROR_ALL_INVALID
 * when no value is finite. */
SF_API sf_status sf_fill_disparity(float* disparity, size_t stride, int32_t width, int32_t height);

/** The focus for what is at pixel (x, y) of a disparity map, into *focus: the median of the pixels
 *  up to 3 away whose disparities lie within 0.75 of that pixel's surface. Where none of its 8
 *  neighbours lies within 0.75 of it, its value is taken for wrong, and the surface that most of
 *  these pixels are of counts. SF_ERROR_RANGE when (x, y) is outside the map,
 *  SF_ERROR_NOT_FINITE when one of these pixels is NaN or infinite; no other pixel is read. */
SF_API sf_status sf_focus_at(const float* disparity, size_t stride, int32_t width, int32_t height,
                             int32_t x, int32_t y, double* focus);

/** The aperture of a lens stopped down to `f_stop`, widest / f_stop, into *aperture. `widest` is
 *  the f-stop of aperture 1: the focal length over the diameter of the lens whose rim views (1, 0)
 *  and (-1, 0) lie on. With 1, f-stops are relative to that lens.
 *  SF_ERROR_RANGE unless 0 < widest <= f_stop < infinity. */
SF_API sf_status sf_aperture_of_f_stop(double f_stop, double widest, double* aperture);

/** Name of the SIMD target the kernels run on here, e.g. "AVX2"; static storage. */
SF_API const char* sf_simd_target(void);

#ifdef __cplusplus
}
#endif

#endif /* STARFOCUS_STARFOCUS_H_ */
