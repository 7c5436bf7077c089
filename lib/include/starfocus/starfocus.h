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
 *   1. starfocus_config_init, fill the fields in, starfocus_workspace_size.
 *   2. Allocate that many bytes, aligned to STARFOCUS_ALIGNMENT, and starfocus_init. The engine
 * lives in that memory: it never allocates, owns nothing else and needs no destructor. Free the
 * memory when no call is running. Or starfocus_create, which has an allocator do that, and
 * starfocus_destroy.
 *   3. starfocus_refocus with whole pictures, or starfocus_stream_begin / starfocus_stream_push /
 * starfocus_stream_pull with rows. Both give the same bytes. For many pictures of one light field
 * there is starfocus_prepare, for a part of one starfocus_params.region, for frames of a video
 * starfocus_params.previous.
 *
 * Conventions: u grows to the right, v downwards; no view lies beyond |u|, |v| = 1, where the
 * star's outermost ones are. Disparity d is in pixels per unit u, larger is nearer: a point seen at
 * (x, y) in the centre view is seen at (x - u*d, y - v*d) in view (u, v). The lens blurs it to a
 * disc of radius aperture * |d - focus| pixels. Strides are in bytes and may exceed the row length.
 * Zero all structures that have no init function, as by `= {0}`, and set what you need.
 *
 * Threads: an engine is used by one call at a time, of any thread; several engines are independent.
 * The engine starts no threads; it hands jobs to the runner of starfocus_set_callbacks, for which
 * starfocus/pool.h is one. Output bytes depend on neither the runner, the number of workers, the
 * SIMD target nor the way the rows come in.
 *
 * Errors: every function checks all its arguments before it writes anything but its own state. It
 * returns a starfocus_status, which says what kind of error it is. A starfocus_problem says which
 * field or argument was refused, what its value was and what was expected: set
 * starfocus_config.problem and starfocus_depth_config.problem for calls that take a configuration,
 * and ask starfocus_engine_problem after calls with an engine. STARFOCUS_ERROR_STRUCTURE leaves
 * starfocus_config.problem as it is.
 *
 * Bindings: refuse to run if starfocus_abi_version() is not STARFOCUS_ABI_VERSION. Structures with
 * `size` may get fields at their end without a new version, all others are fixed within one.
 * Enumerators are passed as int. static inline functions are not exported: bindings call those with
 * _sized instead.
 */
#ifndef STARFOCUS_STARFOCUS_H_
#define STARFOCUS_STARFOCUS_H_

#include <stddef.h>
#include <stdint.h>

#include "starfocus/callbacks.h"
#include "starfocus/image.h"
#include "starfocus/lens.h"
#include "starfocus/status.h"
#include "starfocus/tuning.h"
#include "starfocus/version.h"

#ifdef __cplusplus
extern "C" {
#endif

#define STARFOCUS_ABI_VERSION \
  1u /**< grows when a public structure or the meaning of a call changes */
#define STARFOCUS_ALIGNMENT 64        /**< of the workspace, bytes: the widest vector (AVX-512) */
#define STARFOCUS_MAX_VIEWS 17        /**< largest number of captured views */
#define STARFOCUS_MAX_SIZE 65535      /**< largest width and height in pixels */
#define STARFOCUS_MAX_DISPARITY 500.0 /**< largest |disparity| in pixels per unit u */
#define STARFOCUS_MAX_BLUR \
  128.0                    /**< largest blur radius in pixels that a configuration may ask for */
#define STARFOCUS_LAYERS 3 /**< number of subsampled layers, the original one included */
#define STARFOCUS_MAX_WORKERS 64 /**< largest number of workers */

/** STARFOCUS_ABI_VERSION the library was built with. */
STARFOCUS_API uint32_t starfocus_abi_version(void);

/** STARFOCUS_VERSION_STRING the library was built with, e.g. "0.1.0"; static storage. */
STARFOCUS_API const char* starfocus_version(void);

/** Size in bytes of a public structure in the library, by its name, such as "starfocus_config"; 0
 * for unknown names. Bindings compare it with the structures they declare. */
STARFOCUS_API size_t starfocus_struct_size(const char* name);

#define STARFOCUS_MAX_HIGHLIGHTS 64.0
#define STARFOCUS_MAX_PREVIEW 3
#define STARFOCUS_FEATURE_LINE_SCAN 1u /**< the paper's renderer, STARFOCUS_RENDERER_LINE_SCAN */
#define STARFOCUS_FEATURE_COVERAGE \
  2u /**< separates hair and thin structures from what is behind them */
#define STARFOCUS_FEATURE_STREAMING 4u /**< starfocus_stream_*: reserves rings of rows */
#define STARFOCUS_FEATURE_IMAGES \
  8u /**< formats other than rows of R, G, B and of float disparities */
/** NaN and infinite values of disparity maps are unknown: each takes the nearest known value of its
 *  row; between two, that of the farther surface. A row without any is at disparity_min. Without
 * the feature they are refused, STARFOCUS_ERROR_NOT_FINITE. starfocus_repair_disparity finds what
 * the views show there, and starfocus_fill_disparity fills whole maps. */
#define STARFOCUS_FEATURE_FILL_UNKNOWN 16u
/** Lenses may be polygons and have cat's eyes: reserves larger tables. Without it such lenses are
 *  refused, STARFOCUS_ERROR_FEATURE. */
#define STARFOCUS_FEATURE_SHAPES 32u

/** Where a captured view lies, in units of u. */
typedef struct starfocus_position {
  double u; /**< grows to the right */
  double v; /**< grows downwards */
} starfocus_position;

/** How the codes 0 to 255 of a picture stand for light, which is what a lens adds. A picture of one
 *  code keeps it; docs/library.md says when dark pixels may be one code off. */
typedef enum starfocus_transfer {
  STARFOCUS_TRANSFER_SRGB = 0, /**< the curve of sRGB (IEC 61966-2-1), as in pictures of cameras:
                             codes are decoded to light of 15 bits as they are read, and light is
                             coded where a picture is written */
  STARFOCUS_TRANSFER_NONE =
      1 /**< light is the code itself: codes are averaged as they are (the paper's) */
} starfocus_transfer;

/** What a workspace is made for. Call starfocus_config_init first: it sets `size` and the defaults.
 * A program whose header has fewer fields than the library gets their defaults; one whose header
 * has more is refused, STARFOCUS_ERROR_STRUCTURE. */
typedef struct starfocus_config {
  uint32_t size;  /**< of the structure in bytes, set by starfocus_config_init */
  int32_t width;  /**< pixels, [1, STARFOCUS_MAX_SIZE] */
  int32_t height; /**< pixels, [1, STARFOCUS_MAX_SIZE]; the workspace does not depend on it */
  int32_t views; /**< captured views: 1, 5, 9 or 17 (see starfocus_view_position), or with positions
                      any number from 1 to STARFOCUS_MAX_VIEWS; default 5 */
  double disparity_min; /**< smallest disparity any map may hold; default 0. A range wider than that
                            of the maps changes pictures: it raises N of the frame modes, and beyond
                            32 pixels of blur, slices get thicker */
  double disparity_max; /**< largest disparity any map may hold, >= disparity_min; default 0 */
  double max_blur;      /**< largest blur radius r = aperture * |d - focus| in pixels that will be
                             asked for, (0, STARFOCUS_MAX_BLUR]; default 32. It reserves room and changes
                             no picture */
  int32_t superblock;   /**< side of the squares that a plan of blocks starts from, pixels: 32, 64,
                           128, 256, or 0, the default: 128 from a width of 1536 on, else 64. For wide
                           pictures 128 is up to an eighth faster; a worker's memory grows with the
                           square's area, from 1.15 MiB at 64 on. starfocus_report has what 0 chose */
  int32_t max_workers;  /**< workers the runner may use, [1, STARFOCUS_MAX_WORKERS]; default 1 */
  uint32_t features;    /**< bits of STARFOCUS_FEATURE_, what the workspace has memory for; default
                           LINE_SCAN and COVERAGE. Without LINE_SCAN, STARFOCUS_RENDERER_AUTO is
                           SLICES in all modes, and STARFOCUS_RENDERER_LINE_SCAN is refused,
                           STARFOCUS_ERROR_FEATURE */
  int32_t
      previews;     /**< largest starfocus_params.preview_shift, [0, STARFOCUS_MAX_PREVIEW]:
                       starfocus_prepare then     keeps the light field at 1/2, 1/4 and 1/8 of its
                       size,     up to that; default     0: none. The workspace does not grow by it */
  int32_t transfer; /**< starfocus_transfer: how codes of the pictures stand for light; default
                       STARFOCUS_TRANSFER_SRGB */
  double
      highlights; /**< how many times white the lamps are that pictures clip,
                    [1, STARFOCUS_MAX_HIGHLIGHTS]; default 1: as white as they look. Pixels two of
                    whose codes are 251 or more count, the brighter the more, up to clipped ones.
                    White areas wider and higher than a 32nd of the picture's width (16 to 128
                    pixels) count less, from twice as much on not at all: walls do not glow */
  /** Where the `views` captured views lie: each coordinate in [-1, 1], rounded to 1/16384, no two
   *  alike, the first one (0, 0). All 0, the default: where starfocus_view_position tells. What
   * lies behind an edge is read from the best view that sees it, and filled where none does.
   *  STARFOCUS_RENDERER_LINE_SCAN and starfocus/depth.h need the star. */
  starfocus_position positions[STARFOCUS_MAX_VIEWS];
  starfocus_tuning tuning; /**< in the structure, so that copies of a configuration need no care */
  /** Where a call with this configuration tells what it refuses; null, the default: nowhere. Calls
   *  with an engine do not use it: see starfocus_engine_problem. */
  starfocus_problem* problem;
} starfocus_config;

/** Sets the first `size` bytes of a configuration, as many as the caller's header knows. For
 *  bindings; programs in C and C++ call starfocus_config_init. */
STARFOCUS_API void starfocus_config_init_sized(starfocus_config* config, uint32_t size);

static inline void starfocus_config_init(starfocus_config* config) {
  starfocus_config_init_sized(config, (uint32_t)sizeof(starfocus_config));
}

/** Position (u, v) of view `index` of the star; those of 1, 5 and 9 are the first of the 17:
 *  0 centre; 1-4 (+1,0) (-1,0) (0,+1) (0,-1); 5-8 (+1,+1) (-1,+1) (+1,-1) (-1,-1); 9-16 the same
 *  eight at half the distance. False when index is outside [0, STARFOCUS_MAX_VIEWS) or u or v is
 * null. */
STARFOCUS_API int starfocus_view_position(int32_t index, double* u, double* v);

/** Bytes of workspace for `config` into *bytes. Independent of config->height. */
STARFOCUS_API starfocus_status starfocus_workspace_size(const starfocus_config* config,
                                                        size_t* bytes);

/** The engine; lives inside the caller's workspace. */
typedef struct starfocus_engine starfocus_engine;

/** Makes an engine in `workspace` (`bytes` long, aligned to STARFOCUS_ALIGNMENT), which stays the
 *  caller's and must outlive the engine's use. *engine is null on error. */
STARFOCUS_API starfocus_status starfocus_init(const starfocus_config* config, void* workspace,
                                              size_t bytes, starfocus_engine** engine);

/** What the engine's last call refused, in the engine's memory; null if `engine` is. The next call
 *  with the engine overwrites it. */
STARFOCUS_API const starfocus_problem* starfocus_engine_problem(const starfocus_engine* engine);

/** Sets the functions that all later calls with this engine use, in place of those set before; also
 *  between the calls of a stream. An engine starts without any. The structure need not stay. */
STARFOCUS_API starfocus_status starfocus_set_callbacks(starfocus_engine* engine,
                                                       const starfocus_callbacks* callbacks);

/** Where starfocus_create takes memory from. */
typedef struct starfocus_allocator {
  void* data; /**< passed to both */
  /** Returns `bytes` of memory aligned to `alignment`, STARFOCUS_ALIGNMENT, or null without any. */
  void* (*allocate)(void* data, size_t bytes, size_t alignment);
  /** Takes back what allocate gave, with the same `bytes`; never null. */
  void (*release)(void* data, void* memory, size_t bytes);
} starfocus_allocator;

/** starfocus_workspace_size and starfocus_init in one: makes an engine in memory that it takes from
 * `allocator` (null: malloc and free), in one piece, and that starfocus_destroy gives back. Nothing
 * else ever allocates. *engine is null on error: one of those two functions',
 * STARFOCUS_ERROR_MEMORY when there is no memory, STARFOCUS_ERROR_NULL when a function of the
 * allocator is null. */
STARFOCUS_API starfocus_status starfocus_create(const starfocus_config* config,
                                                const starfocus_allocator* allocator,
                                                starfocus_engine** engine);

/** Ends an engine of starfocus_create's, in which no call may be running, and gives its memory
 * back. Of null and of engines of starfocus_init's, whose memory is the caller's, it does nothing.
 */
STARFOCUS_API void starfocus_destroy(starfocus_engine* engine);

typedef enum starfocus_mode {
  STARFOCUS_MODE_FRAME = 0, /**< one N for the whole picture, from (9) */
  STARFOCUS_MODE_BENCHMARK =
      1, /**< one N = 2 * ceil(r_max): the paper's objective quality benchmark; the
            renderer says whether views show fine slices or are rendered line by line */
  STARFOCUS_MODE_BLOCK = 2, /**< blocks of variable size, each with its own N and layer (section V).
                        Half-band filters of layers 1 and 2 overshoot: a picture may leave the
                        range of its views' light by 4 % of that range with slices and
                        13 % with line scans, 4 and 40 % through other openings than the
                        default. With STARFOCUS_TRANSFER_SRGB dark codes differ by more: 4 %
                        of white are the codes up to 56. The other modes stay in the range */
  STARFOCUS_MODE_BLUR =
      3 /**< the centre view alone, blurred by (4): up to ten times the time of blocks */
} starfocus_mode;

/** What renders views, and so how many of them a blur radius needs. */
typedef enum starfocus_renderer {
  STARFOCUS_RENDERER_AUTO =
      0, /**< LINE_SCAN for STARFOCUS_MODE_FRAME of a star of 5 or more views, else SLICES */
  STARFOCUS_RENDERER_LINE_SCAN = 1, /**< the paper's: views at most a pixel or so apart (9),
                                  rendered line by line (IV). Needs STARFOCUS_FEATURE_LINE_SCAN and
                                  the views of starfocus_view_position */
  STARFOCUS_RENDERER_SLICES = 2 /**< each view stands for its subaperture, however wide, and shows
                              slices of the scene */
} starfocus_renderer;

/** A rectangle inside the picture, in pixels; all 0: the whole picture. */
typedef struct starfocus_region {
  int32_t x, y, width, height; /**< its left and top pixel, >= 0, and its size, >= 1 */
} starfocus_region;

/** A light field. All views have the configured width and height; their formats may differ. */
typedef struct starfocus_light_field {
  starfocus_image views[STARFOCUS_MAX_VIEWS]; /**< the configured number, in the order of
                                     starfocus_view_position or starfocus_config.positions */
  starfocus_depth_map depth;                  /**< of the centre view */
  /** How much of each pixel of the centre view the nearer of two surfaces covers that meet there,
   *  255: all; as a matting network finds it. Within 32 pixels of depth edges of over 5 pixels it
   *  decides over the map. Null: there is none. Not looked at without STARFOCUS_FEATURE_COVERAGE.
   */
  const uint8_t* coverage;
  size_t coverage_stride; /**< bytes from row to row, >= width */
} starfocus_light_field;

/** The frame before: a light field of the same configuration, and what was made of it with the same
 *  starfocus_params but for `previous`. That is not checked: the picture of another lens is copied
 * where nothing changed. */
typedef struct starfocus_previous {
  starfocus_light_field light_field; /**< only compared */
  starfocus_image out;               /**< the picture, or region, that starfocus_refocus wrote */
} starfocus_previous;

/** What to render. Call starfocus_params_init first: it sets `size` and the defaults. Structures of
 * other sizes are treated as those of starfocus_config. */
typedef struct starfocus_params {
  uint32_t size;           /**< of the structure in bytes, set by starfocus_params_init */
  int32_t mode;            /**< starfocus_mode; default STARFOCUS_MODE_BLOCK */
  int32_t renderer;        /**< starfocus_renderer; STARFOCUS_MODE_BLUR ignores it; default
                              STARFOCUS_RENDERER_AUTO */
  starfocus_region region; /**< what is written; streaming: all 0; default all 0 */
  starfocus_lens lens;     /**< what focuses the picture */
  int32_t preview_shift;   /**< starfocus_refocus_prepared: at 1 / 2^shift of the size; default 0 */
  /** starfocus_refocus: superblocks that depend on no pixel that changed since are copied from
   * here, for the same bytes. Both light fields and both pictures are of the formats that need no
   *  STARFOCUS_FEATURE_IMAGES (else STARFOCUS_ERROR_FEATURE). Default null: nothing is known of a
   * frame before.
   */
  const starfocus_previous* previous;
} starfocus_params;

/** Sets the first `size` bytes of params, as many as the caller's header knows. For bindings;
 *  programs in C and C++ call starfocus_params_init. */
STARFOCUS_API void starfocus_params_init_sized(starfocus_params* params, uint32_t size);

static inline void starfocus_params_init(starfocus_params* params) {
  starfocus_params_init_sized(params, (uint32_t)sizeof(starfocus_params));
}

/** What the blocks of one layer did. */
typedef struct starfocus_layer_report {
  uint64_t blocks; /**< number of blocks */
  uint64_t pixels; /**< picture pixels they cover */
  uint64_t views;  /**< rendered views, summed over the blocks: 1 of a block copied or gathered
                        whole */
  uint64_t rendered_samples; /**< R, G, B samples of those views, by slices in each of them */
  uint64_t predicted_ps;     /**< by the timing model, picoseconds */
  uint64_t measured_ns; /**< by starfocus_callbacks.clock, summed over workers; 0 without one */
} starfocus_layer_report;

/** What a refocusing did. */
typedef struct starfocus_report {
  double r_max;           /**< largest blur radius the configured disparity range allows, pixels */
  int32_t n;              /**< views along the aperture radius, N; the largest of any block */
  int32_t rendered_views; /**< views of i^2 + j^2 <= N^2 for that N */
  int32_t superblock;     /**< side of the superblocks in pixels: the configured one, or what 0
                                  chose */
  uint64_t rendered_samples; /**< R, G, B samples of all rendered views, summed over the layers */
  starfocus_layer_report layers[STARFOCUS_LAYERS]; /**< by L; frame modes use L = 0 only */
  uint64_t copied_pixels; /**< copied from the centre view: no rendered view moves them */
  uint64_t
      gathered_pixels; /**< by starfocus_tuning.gather: blurred as a whole, no view is rendered */
  uint64_t
      reused_blocks; /**< starfocus_params.previous: superblocks of which nothing was refocused */
  uint64_t unknown_pixels; /**< values that STARFOCUS_FEATURE_FILL_UNKNOWN filled, in the rows of
                              the map that were read; none of a prepared light field */
} starfocus_report;

/** Refocuses whole pictures, or the params' region of them, whose bytes are those of the whole
 *  picture there. Of a region, only the blocks of the whole picture that its pixels depend on are
 *  refocused, and only the disparity rows that these can read are checked. The light field is only
 *  read, during the call. `out` is a picture of the region's size and must overlap neither the
 * light field, `params->previous` nor the workspace. Its alpha is that of the centre view, 255 if
 * that has none; its chroma is that of its own 2 x 2 pixels, wherever the region lies. report may
 * be null. */
STARFOCUS_API starfocus_status starfocus_refocus(starfocus_engine* engine,
                                                 const starfocus_params* params,
                                                 const starfocus_light_field* light_field,
                                                 const starfocus_image* out,
                                                 starfocus_report* report);

/** What is made of a light field for every lens alike; it lives inside the caller's memory. */
typedef struct starfocus_prepared starfocus_prepared;

/** Bytes that a prepared light field of `config` takes, into *bytes: 2 per pixel of the picture for
 *  disparities and about 1.9 for layers 1 and 2, as far as max_layer allows them; and for each
 *  preview up to starfocus_config.previews 3 per view and 3 per pixel of its own. */
STARFOCUS_API starfocus_status starfocus_prepared_size(const starfocus_config* config,
                                                       size_t* bytes);

/** Checks and converts the disparities and subsamples the centre view, once for many refocusings,
 * in `memory` (`bytes` long, aligned to STARFOCUS_ALIGNMENT), which stays the caller's. The
 * refocusings read the pictures of the light field again: what light_field points to must stay as
 * it is until the last one, the structure itself need not. `memory` must overlap neither it nor the
 * workspace. *prepared is null on error; `memory` is unspecified after STARFOCUS_ERROR_CANCELLED
 * and STARFOCUS_ERROR_RUNNER.
 */
STARFOCUS_API starfocus_status starfocus_prepare(starfocus_engine* engine,
                                                 const starfocus_light_field* light_field,
                                                 void* memory, size_t bytes,
                                                 starfocus_prepared** prepared);

/** As starfocus_refocus, with the same bytes, of a prepared light field; of this engine or of any
 * of the same size, views and positions, disparity range, max_layer and transfer (else
 *  STARFOCUS_ERROR_PREPARED). Several engines may use one at a time. `params->previous` must be
 * null.
 *
 *  With a preview_shift it refocuses at 1 / S of the size, S = 2^shift, in about 1 / S^2 of the
 *  time; else `params` are in pixels of the full size as ever. `out` has the pixels that have a
 * part of the region: from x / S to (x + width - 1) / S, both rounded down, and rows likewise; its
 * alpha is 255. STARFOCUS_ERROR_PREPARED when the light field was not prepared for that shift.
 *
 *  The preview is, byte for byte, what starfocus_refocus gives of the reduced light field, by an
 * engine of its size and else of the same configuration (superblock as starfocus_report says), but
 * for a disparity range, max_blur, focus and region divided by S. There a pixel of a view is the
 * mean light, in 128ths of a 255th of white and then as a code, of the S x S pixels (fewer at the
 * right and bottom edges) that it stands for, and a disparity the median of theirs, the larger of
 * two in the middle, over S: a multiple of 1/64, halves rounded up, within the range. on_block,
 * progress and the report count pixels of the preview. The light field's pictures are not read. */
STARFOCUS_API starfocus_status starfocus_refocus_prepared(starfocus_engine* engine,
                                                          const starfocus_params* params,
                                                          const starfocus_prepared* prepared,
                                                          const starfocus_image* out,
                                                          starfocus_report* report);

/** Starts (or restarts) a streamed refocusing; the engine needs STARFOCUS_FEATURE_STREAMING. */
STARFOCUS_API starfocus_status starfocus_stream_begin(starfocus_engine* engine,
                                                      const starfocus_params* params);

/** Copies up to `rows` next rows of the light field, at most as many as are left. Planes of views
 * and coverage point to the first of them. depth.height is always that of the whole map: if that is
 * the picture's, depth.data points to the first of the rows, too; a smaller map is given whole in
 * every call. *consumed <= rows tells how many fitted: pull finished rows and push the rest. Rows
 * that share chroma come together: where a view has some, `rows` is even but at the picture's end
 * (else STARFOCUS_ERROR_RANGE), and so is *consumed. A row with a bad disparity value is refused:
 * the rows before it are consumed. Either all rows have coverage or none (else
 * STARFOCUS_ERROR_STATE). */
STARFOCUS_API starfocus_status starfocus_stream_push(starfocus_engine* engine,
                                                     const starfocus_light_field* light_field,
                                                     int32_t rows, int32_t* consumed);

/** Writes up to `rows` next finished rows to `out`, whose planes point to the first of them; where
 *  they share chroma, `rows` is even but at the picture's end. More rows than are left may be asked
 *  for. *written may be 0 until more rows are pushed. report may be null; it is complete once the
 *  last row is written.
 *  After STARFOCUS_ERROR_RUNNER and STARFOCUS_ERROR_CANCELLED the rows counted by *written are
 * good, and the next pull goes on behind them. That pull tells on_block again of blocks that were
 * half done; the report counts them once. starfocus_stream_begin and every other call with the
 * engine but starfocus_set_callbacks end the stream. progress counts rows of the whole picture. */
STARFOCUS_API starfocus_status starfocus_stream_pull(starfocus_engine* engine,
                                                     const starfocus_image* out, int32_t rows,
                                                     int32_t* written, starfocus_report* report);

/** What starfocus_measure_disparity finds in a disparity map. */
typedef struct starfocus_disparity_stats {
  double min, max; /**< smallest and largest finite value; 0 when there is none */
  int64_t invalid; /**< number of NaN and infinite values */
} starfocus_disparity_stats;

STARFOCUS_API starfocus_status starfocus_measure_disparity(const float* disparity, size_t stride,
                                                           int32_t width, int32_t height,
                                                           starfocus_disparity_stats* stats);

/** Replaces every non-finite value, in place, by its nearest valid neighbour to the left or right
 *  (of one on either side, the farther surface: the smaller disparity); rows without a valid value
 *  are filled from the nearest valid rows above and below by the same rule.
 * STARFOCUS_ERROR_ALL_INVALID when no value is finite. */
STARFOCUS_API starfocus_status starfocus_fill_disparity(float* disparity, size_t stride,
                                                        int32_t width, int32_t height);

/** The focus for what is at pixel (x, y) of a disparity map, into *focus: the median of the pixels
 *  up to 3 away whose disparities lie within 0.75 of that pixel's surface. Where none of its 8
 *  neighbours lies within 0.75 of it, its value is taken for wrong, and the surface that most of
 *  these pixels are of counts. STARFOCUS_ERROR_RANGE when (x, y) is outside the map,
 *  STARFOCUS_ERROR_NOT_FINITE when one of these pixels is NaN or infinite; no other pixel is read.
 */
STARFOCUS_API starfocus_status starfocus_focus_at(const float* disparity, size_t stride,
                                                  int32_t width, int32_t height, int32_t x,
                                                  int32_t y, double* focus);

/** The aperture of a lens stopped down to `f_stop`, widest / f_stop, into *aperture. `widest` is
 *  the f-stop of aperture 1: the focal length over the diameter of the lens whose rim views (1, 0)
 *  and (-1, 0) lie on. With 1, f-stops are relative to that lens.
 *  STARFOCUS_ERROR_RANGE unless 0 < widest <= f_stop < infinity. */
STARFOCUS_API starfocus_status starfocus_aperture_of_f_stop(double f_stop, double widest,
                                                            double* aperture);

/** Name of the SIMD target the kernels run on here, e.g. "AVX2"; static storage. */
STARFOCUS_API const char* starfocus_simd_target(void);

#ifdef __cplusplus
}
#endif

#endif /* STARFOCUS_STARFOCUS_H_ */
