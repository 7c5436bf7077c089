/* SPDX-License-Identifier: Apache-2.0 */
/** @file
 * Refocusing of sparse light fields: the C API of starfocus.
 *
 * The engine takes a light field: 1 to 17 rectified views, with 8 bits per sample or more, and the
 * disparity map of the centre view. The engine computes the picture that a lens would have taken
 * with another focus and another aperture. The views form the star-shaped pattern of the paper, or
 * lie at any positions, for example the positions of a stereo pair. The paper is Huang et al.,
 * "Fast Physically-Correct Refocusing for Sparse Light Fields Using Block-Based Multi-Rate View
 * Interpolation". Numbers in parentheses, such as (9), are equations of the paper.
 *
 * The following function focuses a picture at disparity 3.5:
 *
 * @code
 * #include <starfocus/starfocus.h>
 *
 * // Focuses 5 packed RGB views with float disparities from -8 to 8. Returns a starfocus_status.
 * int Refocus(const unsigned char* views[5], const float* disparity, int width, int height,
 *             unsigned char* out) {
 *   const size_t stride = 3 * (size_t)width;
 *   starfocus_config config;
 *   starfocus_config_init(&config);
 *   config.width = width;
 *   config.height = height;
 *   config.disparity_min = -8;
 *   config.disparity_max = 8;
 *   starfocus_engine* engine = NULL;
 *   starfocus_status status = starfocus_create(&config, NULL, &engine, NULL);
 *   if (status != STARFOCUS_OK) return status;
 *
 *   starfocus_light_field light_field;
 *   starfocus_light_field_init(&light_field);
 *   for (int i = 0; i < 5; ++i) light_field.views[i] = starfocus_image_rgb(views[i], stride);
 *   light_field.depth =
 *       starfocus_depth_float(disparity, sizeof(float) * (size_t)width, width, height);
 *   const starfocus_image picture = starfocus_image_rgb(out, stride);
 *   starfocus_params params;
 *   starfocus_params_init(&params);
 *   params.focus = 3.5;
 *   status = starfocus_refocus(engine, &params, &light_field, &picture, NULL);
 *   starfocus_destroy(engine);
 *   return status;
 * }
 * @endcode
 *
 * **Coordinates.** View (u, v) lies u units to the right of the centre view and v units below the
 * centre view, and |u|, |v| <= 1. Disparity d is in pixels per unit; nearer points have larger
 * disparities. A point at (x, y) of the centre view appears at (x - u d, y - v d) of view (u, v).
 * The lens blurs the point to a disc of radius aperture * |d - focus| pixels. Strides are in bytes
 * and may be larger than a row.
 *
 * **Structures.** Structures with an init function have a field `size`; the init function sets
 * `size` and the defaults. Set structures without an init function to zero, for example with
 * `= {0}`, before you set fields. If `size` is smaller than the library's structure, the missing
 * bytes get defaults. Calls return STARFOCUS_ERROR_STRUCTURE if `size` is larger than the library's
 * structure, less than 8, or not a multiple of the structure's alignment.
 *
 * **Memory.** The engine lives in one block of memory, its workspace, and allocates no other
 * memory, except in starfocus_prepare if the caller passes no memory. Either starfocus_create
 * allocates the workspace and starfocus_destroy frees it, or the caller allocates
 * starfocus_workspace_size bytes and calls starfocus_init. An engine that starfocus_init creates
 * requires no destructor.
 *
 * **Threads.** One call at a time may use an engine, from any thread. Different engines are
 * independent. The engine starts no threads; it passes jobs to the runner of
 * starfocus_set_callbacks. starfocus/pool.h provides a runner with a pool of threads, in a separate
 * library, starfocus_pool. The output bytes do not depend on the runner, the number of workers or
 * the SIMD target. Streaming rows gives the same bytes as passing whole pictures.
 *
 * **Errors.** Functions that can fail return a starfocus_status. A function checks all its
 * arguments before it writes any output. The status is the kind of error; a starfocus_problem names
 * the wrong field or argument, its value, and the allowed range. After a call with an engine,
 * starfocus_engine_problem returns the problem. Functions without an engine write the problem to
 * their last argument, unless it is null. A call that succeeds clears the earlier problem.
 *
 * **Bindings.** Compare the ABI that starfocus_version() reports with STARFOCUS_ABI, and build
 * structures from starfocus_fields(). Within one ABI, only structures with a field `size` grow, and
 * only at their end. All other layouts, and constants that determine them (STARFOCUS_MAX_VIEWS,
 * STARFOCUS_LAYERS), are frozen, also in starfocus/experimental.h. Enumerators are passed as
 * int32_t. Inline functions are not exported: instead of the init functions, call
 * starfocus_defaults.
 *
 * **Stability.** Within one ABI, the meaning of the fields of starfocus/experimental.h and the
 * values that they accept may still change: modes and renderers, tuning with its limits
 * (STARFOCUS_MAX_TIMING, STARFOCUS_MIN_N_SCALE, STARFOCUS_MAX_N_SCALE), and measurements by layer.
 * This header contains all other limits.
 */
#ifndef STARFOCUS_STARFOCUS_H_
#define STARFOCUS_STARFOCUS_H_

#include <stddef.h>
#include <stdint.h>

#include "starfocus/image.h"
#include "starfocus/version.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Marks the functions that the library exports. */
#if defined(__GNUC__)
#define STARFOCUS_API __attribute__((visibility("default")))
#else
#define STARFOCUS_API
#endif

/** Status that an API call returns. */
typedef enum starfocus_status {
  STARFOCUS_OK = 0,              /**< Success. */
  STARFOCUS_ERROR_NULL = 1,      /**< A required pointer is null. */
  STARFOCUS_ERROR_STRUCTURE = 2, /**< A structure was not initialized by its init function. */
  STARFOCUS_ERROR_RANGE = 3,     /**< A field or an argument is out of range. */
  STARFOCUS_ERROR_FEATURE = 4,   /**< The engine lacks a required feature or view. */
  STARFOCUS_ERROR_STATE = 5,     /**< No stream is active, or only some rows have coverage. */
  STARFOCUS_ERROR_WORKSPACE = 6, /**< The given memory is too small or not aligned. */
  STARFOCUS_ERROR_TOO_LARGE = 7, /**< The configuration requires more memory than is addressable. */
  STARFOCUS_ERROR_MEMORY = 8,    /**< Memory could not be allocated. */
  STARFOCUS_ERROR_STRIDE = 9,    /**< A stride is smaller than a row, or a stride or a map is not
                                      aligned. */
  STARFOCUS_ERROR_OVERLAP = 10,  /**< An output overlaps an input or the workspace. */
  STARFOCUS_ERROR_BLUR = 11,     /**< The blur radius aperture * |d - focus| exceeds max_blur at
                                      disparity_min or disparity_max. */
  STARFOCUS_ERROR_DISPARITY = 12,   /**< A disparity is outside the configured range. */
  STARFOCUS_ERROR_NOT_FINITE = 13,  /**< A disparity is NaN or infinite. */
  STARFOCUS_ERROR_ALL_INVALID = 14, /**< The disparity map has no finite value. */
  STARFOCUS_ERROR_PREPARED = 15,    /**< The prepared light field has another configuration. */
  STARFOCUS_ERROR_RUNNER = 16,      /**< The runner failed or misused its jobs; the output is
                                         incomplete. */
  STARFOCUS_ERROR_CANCELLED = 17    /**< The progress callback cancelled the call; the output is
                                         incomplete. */
} starfocus_status;

/** The cause of an error. The strings `field` and `expected` are in static storage and never
 *  null. */
typedef struct starfocus_problem {
  int32_t status; /**< starfocus_status that the call returned. */
  int32_t index;  /**< Index of the array element, if `field` contains []; otherwise 0. */
  /** Wrong field or argument; "" if no single field is wrong. Fields of starfocus_config,
   *  starfocus_params and starfocus_light_field have no prefix: "width", "views[].strides". Fields
   *  `size`, nested fields and fields of other structures have one: "params.size", "region.x". */
  const char* field;
  const char* expected; /**< Allowed values in words, for example "1 to 65535". */
  double value;         /**< Value that was given; NaN for pointers, and if unknown. */
  double low;           /**< Smallest allowed value; NaN if there is no range. */
  double high;          /**< Largest allowed value; NaN if there is no range. */
  int32_t
      x; /**< Column of the first wrong disparity in the depth map; -1 if no disparity is wrong. */
  int32_t y; /**< Row of the same disparity, from the top of the whole map. */
} starfocus_problem;

/** Describes a status.
 *  @param status status; any value
 *  @return a sentence in English, in static storage; never null */
STARFOCUS_API const char* starfocus_status_string(starfocus_status status);

/** Alignment of workspaces and prepared light fields in bytes: the size of the widest vector
 *  (AVX-512). */
#define STARFOCUS_ALIGNMENT 64
/** Largest number of captured views. */
#define STARFOCUS_MAX_VIEWS 17
/** Largest width and height of a picture in pixels. */
#define STARFOCUS_MAX_SIZE 65535
/** Largest absolute disparity in pixels per unit of u. */
#define STARFOCUS_MAX_DISPARITY 500.0
/** Largest blur radius in pixels. */
#define STARFOCUS_MAX_BLUR 128.0
/** Largest number of workers. */
#define STARFOCUS_MAX_WORKERS 64
/** Largest value of starfocus_config.highlights. */
#define STARFOCUS_MAX_HIGHLIGHTS 64.0
/** Largest value of starfocus_params.preview_shift. */
#define STARFOCUS_MAX_PREVIEW 3
/** Smallest starfocus_params.theta, 0.05 pi. */
#define STARFOCUS_MIN_THETA 0.15707963267948966
/** Largest starfocus_params.theta, 0.45 pi. */
#define STARFOCUS_MAX_THETA 1.413716694115407
/** Largest absolute starfocus_params.focus. */
#define STARFOCUS_MAX_FOCUS 1.0e6
/** Smallest starfocus_params.blades. */
#define STARFOCUS_MIN_BLADES 3
/** Largest starfocus_params.blades. */
#define STARFOCUS_MAX_BLADES 12
/** Largest starfocus_params.ring_inner. */
#define STARFOCUS_MAX_RING_INNER 0.9

/** Bits of starfocus_config.features. Each bit reserves memory in the workspace for what it adds.
 *  Only STARFOCUS_FEATURE_COVERAGE changes pictures; calls that lack another bit are rejected.
 *  @{ */
/** Separates hair and thin structures from the background; reads starfocus_light_field.coverage. */
#define STARFOCUS_FEATURE_COVERAGE 1u
/** Enables the functions starfocus_stream_* and reserves ring buffers of rows. */
#define STARFOCUS_FEATURE_STREAMING 2u
/** Enables image formats other than packed RGB. Enables depth maps that are smaller than the
 *  picture or have another format than starfocus_depth_float describes. */
#define STARFOCUS_FEATURE_IMAGES 4u
/** Enables polygons and cat's eyes, and reserves larger tables. Without this feature, calls reject
 *  polygons and cat's eyes with STARFOCUS_ERROR_FEATURE. */
#define STARFOCUS_FEATURE_SHAPES 8u
/** Enables pictures of more than 8 bits, light up to 64 times white, and alpha, besides the formats
 *  of STARFOCUS_FEATURE_IMAGES. Light has 15 bits up to white, and 9 to 15 bits beyond. 8-bit
 *  outputs are dithered where they are smooth. */
#define STARFOCUS_FEATURE_DEEP 16u
/** @} */

/** Treatment of unknown values of disparity maps: NaN, infinite, or the map's invalid value. */
typedef enum starfocus_unknown {
  /** Calls reject unknown values with STARFOCUS_ERROR_NOT_FINITE. Alternatives to filling are
   *  starfocus_repair_disparity, which finds the values from the views, and
   *  starfocus_fill_disparity, which fills a whole map. */
  STARFOCUS_UNKNOWN_REFUSE = 0,
  /** An unknown value between two known values of its row gets the smaller value. At the ends of a
   *  row, an unknown value gets the nearest known value. A row without a known value gets
   *  disparity_min. */
  STARFOCUS_UNKNOWN_FILL = 1
} starfocus_unknown;

/** Returns the version of the library.
 *  @param abi receives the STARFOCUS_ABI that the library was built with; may be null. A program
 *         whose STARFOCUS_ABI differs must not call other functions
 *  @return the STARFOCUS_VERSION_STRING that the library was built with, for example "0.1.0", in
 *         static storage */
STARFOCUS_API const char* starfocus_version(uint32_t* abi);

/** Sets a structure to its defaults, and its field `size`. This function is for bindings; programs
 *  in C and C++ call the function of the structure, for example starfocus_config_init.
 *  @param structure name of a structure with a field `size`, for example "starfocus_config"
 *  @param to structure; no-op if null
 *  @param size size in bytes of the structure that the caller knows, which becomes the field
 *         `size`. With a size below 4, nothing is written. Bytes that the library does not know
 *         become 0
 *  @return STARFOCUS_OK, or STARFOCUS_ERROR_NULL or STARFOCUS_ERROR_RANGE if the name is null or
 *         unknown */
STARFOCUS_API starfocus_status starfocus_defaults(const char* structure, void* to, uint32_t size);

/** Function of the engine that runs one job of a set. The runner calls this function once with
 *  every index in [0, count). An invalid call of this function does nothing, and the API call that
 *  started the jobs returns STARFOCUS_ERROR_RUNNER.
 *  @param job_data pointer that the runner received
 *  @param index index of the job
 *  @param worker worker in [0, max_workers). Jobs that run at the same time must use different
 *         workers */
typedef void (*starfocus_job)(void* job_data, int32_t index, int32_t worker);

/** Runs a set of jobs in any order and returns when all jobs are done. Jobs with small indices take
 *  the longest time. If the runner returns before all jobs are done, the engine waits for running
 *  jobs and rejects jobs that start later. In this case, the engine's call returns
 *  STARFOCUS_ERROR_RUNNER.
 *  @param runner_data starfocus_callbacks.runner_data
 *  @param job function to call
 *  @param job_data first argument of `job`
 *  @param count number of jobs, > 0
 *  @return 0 for success; another value makes the engine's call return STARFOCUS_ERROR_RUNNER */
typedef int (*starfocus_runner)(void* runner_data, starfocus_job job, void* job_data,
                                int32_t count);

/** Receives the progress of a call and may cancel the call. The engine calls this callback at every
 *  job and about every 500,000 samples, which take a fraction of a millisecond on a desktop. With a
 *  runner, any thread that runs a job may call the callback, but only one thread at a time does so.
 *  The callback must not use the engine or the engine's memory.
 *
 *  After cancellation the callback is not called again, and the engine's call returns
 *  STARFOCUS_ERROR_CANCELLED as soon as all workers have stopped. The output of a cancelled call is
 *  unspecified, and the engine can be used again. For streams, see starfocus_stream_pull.
 *  @param data starfocus_callbacks.progress_data
 *  @param rows_done number of finished rows, which never decreases within a call and ends at
 *         `rows`. In functions that write a picture, except streams, the first `rows_done` rows of
 *         the output are complete and do not change again
 *  @param rows number of all rows
 *  @return 0 to continue; another value cancels the call */
typedef int (*starfocus_progress)(void* data, int32_t rows_done, int32_t rows);

/** Callbacks of an engine, or of a call of starfocus/depth.h. Each function may be null. All
 *  functions that the library calls, also those of observers and allocators, must return normally:
 *  not by an exception or longjmp. */
typedef struct starfocus_callbacks {
  starfocus_runner runner;     /**< Runs jobs; null: the calling thread runs them as worker 0. */
  void* runner_data;           /**< Passed to `runner`. */
  starfocus_progress progress; /**< Receives finished rows of the picture, region or preview. */
  void* progress_data;         /**< Passed to `progress`. */
  /** Measures an engine (starfocus/experimental.h); may be null. Calls of starfocus/depth.h do not
   *  read it. */
  const struct starfocus_observer* observer;
} starfocus_callbacks;

/** Position of a captured view in units of u. */
typedef struct starfocus_position {
  double u; /**< Distance to the right of the centre view, [-1, 1]. */
  double v; /**< Distance below the centre view, [-1, 1]. */
} starfocus_position;

/** Relation between the codes 0 to 255 of a picture and light. A lens adds light, so the engine
 *  converts codes to light before it averages pixels. Refocusing a picture of one colour does not
 *  change the codes. */
typedef enum starfocus_transfer {
  /** The sRGB curve (IEC 61966-2-1), as in most photographs. Light has 15 bits; docs/library.md
   *  states when dark pixels may differ by one code. */
  STARFOCUS_TRANSFER_SRGB = 0,
  /** Codes are averaged without conversion to light, as in the paper. Pictures of linear light have
   *  this transfer. */
  STARFOCUS_TRANSFER_NONE = 1,
  STARFOCUS_TRANSFER_PQ = 2, /**< SMPTE ST 2084 (PQ); white is 203 cd/m2, as in ITU-R BT.2408. */
  STARFOCUS_TRANSFER_HLG = 3 /**< ARIB STD-B67 (HLG), light of the scene; white is code 0.75. */
} starfocus_transfer;

/** Configuration of an engine. Call starfocus_config_init first. */
typedef struct starfocus_config {
  uint32_t size;  /**< Size of the structure in bytes; set by starfocus_config_init. */
  int32_t width;  /**< Width of the views in pixels, [1, STARFOCUS_MAX_SIZE]. */
  int32_t height; /**< Height of the views in pixels, [1, STARFOCUS_MAX_SIZE]; the size of the
                       workspace does not depend on the height. */
  /** Number of captured views. Without `positions`: 1, 5, 9 or 17, in the order of
   *  starfocus_view_position. With `positions`: 1 to STARFOCUS_MAX_VIEWS. Default 5. */
  int32_t views;
  /** Smallest disparity that a map may contain; default 0. A range wider than the range of the maps
   *  may change the refocused pictures. A wider range increases the number of views in the frame
   *  modes. If the blur exceeds 32 pixels, a wider range also makes slices thicker. */
  double disparity_min;
  double
      disparity_max; /**< Largest disparity that a map may contain, >= disparity_min; default 0. */
  /** Upper limit of the blur radius aperture * |d - focus| in pixels, (0, STARFOCUS_MAX_BLUR];
   *  default 32. The limit affects the size of the workspace, but not the pictures. */
  double max_blur;
  /** Side of the superblocks, from which blocks are split, in pixels: 32, 64, 128, 256, or 0. The
   *  default 0 selects 128. Superblocks of 128 pixels are up to an eighth faster than superblocks
   *  of 64 pixels. The memory of a worker grows with the superblock, and is 1.15 MiB with
   *  superblocks of 64 pixels and 2.1 MiB with superblocks of 128 pixels.
   *  starfocus_report.superblock reports the selected side. */
  int32_t superblock;
  int32_t max_workers; /**< Number of workers, [1, STARFOCUS_MAX_WORKERS]; default 1. */
  uint32_t features;   /**< Bits STARFOCUS_FEATURE_*; default COVERAGE. */
  int32_t unknown;     /**< starfocus_unknown; default STARFOCUS_UNKNOWN_REFUSE. */
  /** Largest starfocus_params.preview_shift, [0, STARFOCUS_MAX_PREVIEW]; default 0. With a value s
   *  > 0, starfocus_prepare additionally stores reduced light fields, down to 1 / 2^s of the size.
   *  Previews do not enlarge the workspace. */
  int32_t previews;
  int32_t transfer; /**< starfocus_transfer; default STARFOCUS_TRANSFER_SRGB. */
  /** Brightness of clipped lamps relative to white, [1, STARFOCUS_MAX_HIGHLIGHTS]; default 1. A
   *  pixel is part of a lamp if at least two of its codes are 251 or more. White areas that are
   *  wider and higher than a limit of 1/32 of the picture's width (16 to 128 pixels) are brightened
   *  less. White areas of at least twice this limit are not brightened, so that walls do not
   *  glow. */
  double highlights;
  /** Positions of the views, rounded to 1/16384. The first position must be (0, 0), and all
   *  positions must differ. Default all 0, which selects the positions of starfocus_view_position.
   *  starfocus_repair_disparity and STARFOCUS_RENDERER_LINE_SCAN require these positions. */
  starfocus_position positions[STARFOCUS_MAX_VIEWS];
  /** Trade-offs between time and error (starfocus/experimental.h), copied when an engine is made;
   *  default null, which selects the defaults of starfocus_tuning_init. */
  const struct starfocus_tuning* tuning;
} starfocus_config;

/** Sets a configuration to the defaults.
 *  @param config configuration; no-op if null */
static inline void starfocus_config_init(starfocus_config* config) {
  starfocus_defaults("starfocus_config", config, (uint32_t)sizeof *config);
}

/** Returns the position of a view in the star-shaped pattern of the paper. Sets of 1, 5 and 9 views
 *  are the first views of the set of 17: view 0 is the centre; 1 to 4 are (1, 0), (-1, 0), (0, 1),
 *  (0, -1); 5 to 8 are (1, 1), (-1, 1), (1, -1), (-1, -1); 9 to 16 are views 1 to 8 at half the
 *  distance.
 *  @param index index of the view, [0, STARFOCUS_MAX_VIEWS)
 *  @param u,v receive the position
 *  @param problem receives the cause of an error; may be null
 *  @return STARFOCUS_OK, STARFOCUS_ERROR_RANGE or STARFOCUS_ERROR_NULL */
STARFOCUS_API starfocus_status starfocus_view_position(int32_t index, double* u, double* v,
                                                       starfocus_problem* problem);

/** Computes the size of the workspace of a configuration.
 *  @param config configuration
 *  @param bytes receives the size in bytes
 *  @param problem receives the cause of an error; may be null
 *  @return STARFOCUS_OK, or an error of the configuration */
STARFOCUS_API starfocus_status starfocus_workspace_size(const starfocus_config* config,
                                                        size_t* bytes, starfocus_problem* problem);

/** An engine, which lives in its workspace. */
typedef struct starfocus_engine starfocus_engine;

/** Creates an engine in memory of the caller. An engine in memory of the caller requires no
 *  destructor.
 *  @param config configuration; the engine keeps a copy
 *  @param workspace memory aligned to STARFOCUS_ALIGNMENT, which must outlive the engine
 *  @param bytes size of the workspace, at least starfocus_workspace_size
 *  @param engine receives the engine, or null on error
 *  @param problem receives the cause of an error; may be null
 *  @return STARFOCUS_OK, STARFOCUS_ERROR_WORKSPACE, or an error of the configuration */
STARFOCUS_API starfocus_status starfocus_init(const starfocus_config* config, void* workspace,
                                              size_t bytes, starfocus_engine** engine,
                                              starfocus_problem* problem);

/** Returns the problem that the engine's last call reported. The problem is stored in the
 *  workspace, and the next call with the engine overwrites this problem.
 *  @param engine engine
 *  @return the problem, with status STARFOCUS_OK if the call succeeded; null if `engine` is null */
STARFOCUS_API const starfocus_problem* starfocus_engine_problem(const starfocus_engine* engine);

/** Sets the callbacks of all later calls with the engine, and replaces earlier callbacks. Callbacks
 *  may be replaced between two calls of a stream. A new engine has no callbacks.
 *  @param engine engine
 *  @param callbacks callbacks; the engine keeps a copy, also of the observer
 *  @return STARFOCUS_OK, STARFOCUS_ERROR_NULL, or STARFOCUS_ERROR_STRUCTURE if the observer was not
 *          initialized */
STARFOCUS_API starfocus_status starfocus_set_callbacks(starfocus_engine* engine,
                                                       const starfocus_callbacks* callbacks);

/** Allocator of starfocus_create and of starfocus_prepare. The library copies the structure. `data`
 *  and the functions must outlive the engine and the light fields that it prepared. */
typedef struct starfocus_allocator {
  void* data; /**< Passed to `allocate` and `release`. */
  /** Returns `bytes` bytes aligned to `alignment` (STARFOCUS_ALIGNMENT), or null on failure. */
  void* (*allocate)(void* data, size_t bytes, size_t alignment);
  /** Frees memory that `allocate` returned. `memory` is not null, and `bytes` is the size that was
   *  requested from `allocate`.
   */
  void (*release)(void* data, void* memory, size_t bytes);
} starfocus_allocator;

/** Allocates a workspace and creates an engine in it. Free the engine with starfocus_destroy.
 *  @param config configuration; the engine keeps a copy
 *  @param allocator allocator; null: malloc and free
 *  @param engine receives the engine, or null on error
 *  @param problem receives the cause of an error; may be null
 *  @return STARFOCUS_OK, STARFOCUS_ERROR_MEMORY, STARFOCUS_ERROR_NULL if a function of the
 *  allocator is null, or an error of the configuration */
STARFOCUS_API starfocus_status starfocus_create(const starfocus_config* config,
                                                const starfocus_allocator* allocator,
                                                starfocus_engine** engine,
                                                starfocus_problem* problem);

/** Frees an engine that starfocus_create created. No call with the engine may be running.
 *  @param engine engine; no-op for a null pointer and for engines that starfocus_init created */
STARFOCUS_API void starfocus_destroy(starfocus_engine* engine);

/** A rectangle inside the picture, in pixels. If all fields are 0, the region is the whole
 *  picture. */
typedef struct starfocus_region {
  int32_t x;      /**< Left column, >= 0. */
  int32_t y;      /**< Top row, >= 0. */
  int32_t width;  /**< Number of columns, >= 1. */
  int32_t height; /**< Number of rows, >= 1. */
} starfocus_region;

/** A light field. All views have the configured size, but their formats may differ. Call
 *  starfocus_light_field_init first, or set `size` to sizeof(starfocus_light_field) and all other
 *  fields to zero. */
typedef struct starfocus_light_field {
  uint32_t size; /**< Size of the structure in bytes; set by starfocus_light_field_init. */
  /** The configured number of views, in the order of starfocus_view_position or
   *  starfocus_config.positions. */
  starfocus_image views[STARFOCUS_MAX_VIEWS];
  starfocus_depth_map depth; /**< Depth map of the centre view. */
  /** Optional alpha of the foreground, in the form that matting networks compute. For each pixel of
   *  the centre view, the alpha is the part of the pixel that the nearer of two surfaces covers,
   *  from 0 (no part) to 255 (the whole pixel). Within 32 pixels of depth edges of more than 5
   *  pixels, the alpha takes precedence over the map. If null, the light field has no alpha.
   *  Engines without STARFOCUS_FEATURE_COVERAGE ignore the alpha. */
  const uint8_t* coverage;
  size_t coverage_stride; /**< Bytes from row to row of `coverage`, >= width. */
} starfocus_light_field;

/** Makes a light field without views, depth and coverage. All fields except `size` are 0. In
 *  `depth`, also set `scale`, as starfocus_depth_float does; calls reject 0.
 *  @param light_field light field; no-op if null */
static inline void starfocus_light_field_init(starfocus_light_field* light_field) {
  starfocus_defaults("starfocus_light_field", light_field, (uint32_t)sizeof *light_field);
}

/** The previous frame of a video: its light field and its picture. The light field and the picture
 *  must belong to the current configuration and to the current starfocus_params, except for the
 *  field `previous`. The engine does not check this condition. Where the light field did not
 *  change, the engine copies pixels of the previous picture. Call starfocus_previous_init first. */
typedef struct starfocus_previous {
  uint32_t size; /**< Size of the structure in bytes; set by starfocus_previous_init. */
  const starfocus_light_field* light_field; /**< Light field of the previous frame. */
  /** Picture or region that starfocus_refocus wrote for `light_field`. */
  const starfocus_image* out;
} starfocus_previous;

/** Sets both pointers to null; calls reject null pointers.
 *  @param previous previous frame; no-op if null */
static inline void starfocus_previous_init(starfocus_previous* previous) {
  starfocus_defaults("starfocus_previous", previous, (uint32_t)sizeof *previous);
}

/** Shape of the aperture within the disc of its radius. */
typedef enum starfocus_shape {
  STARFOCUS_SHAPE_FALL_OFF = 0, /**< The paper's disc (3), which is darker towards its rim. */
  STARFOCUS_SHAPE_DISC = 1,     /**< A disc of constant brightness. */
  STARFOCUS_SHAPE_POLYGON = 2,  /**< A polygon with corners on the rim of the disc, like a diaphragm
                                   with blades. Requires STARFOCUS_FEATURE_SHAPES. */
  STARFOCUS_SHAPE_RING = 3      /**< A disc with a hole, like the opening of a mirror lens. */
} starfocus_shape;

/** Parameters of one refocusing: the lens, and which part of the picture to compute. Call
 *  starfocus_params_init first. A call reads the structures that `previous` and `study` point to
 *  only until it returns. The first call after a change of shape, blades, theta, rotation,
 *  curvature or ring_inner computes tables for the new aperture. Every call checks all fields,
 *  including the fields that the shape does not use. */
typedef struct starfocus_params {
  uint32_t size; /**< Size of the structure in bytes; set by starfocus_params_init. */
  int32_t shape; /**< starfocus_shape; default STARFOCUS_SHAPE_FALL_OFF. Polygons and cat's eyes are
                    slower, because their blur is not gathered (starfocus_tuning.gather). */
  int32_t blades; /**< Polygon: number of corners, [STARFOCUS_MIN_BLADES, STARFOCUS_MAX_BLADES];
                       default 5. */
  /** For starfocus_refocus_prepared: the picture has 1 / 2^preview_shift of the full size. Range
   *  [0, starfocus_config.previews of the engine that prepared the light field]; default 0. */
  int32_t preview_shift;
  double focus; /**< Disparity in focus (d_t), |focus| <= STARFOCUS_MAX_FOCUS; default 0. */
  /** Extent of the range in focus on the near side of `focus`. Disparities from focus to focus +
   *  focus_nearer are sharp. The blur of larger disparities grows with their distance from focus +
   *  focus_nearer. Range [0, STARFOCUS_MAX_FOCUS - focus]; default 0. */
  double focus_nearer;
  /** Extent of the range in focus on the far side of `focus`. Disparities from focus -
   *  focus_farther to focus are sharp. Range [0, STARFOCUS_MAX_FOCUS + focus]; default 0. */
  double focus_farther;
  /** Radius of the aperture (u_t), [0, 1]; default 1. At 0 the result is the centre view: byte for
   *  byte, or with STARFOCUS_FEATURE_DEEP with its light rounded to 1/32640 of white. */
  double aperture;
  double theta; /**< Fall-off: angle of (3) in radians, [STARFOCUS_MIN_THETA, STARFOCUS_MAX_THETA];
                     default 0.26 pi. */
  double rotation;   /**< Polygon: rotation in degrees, clockwise, [-360, 360]; default 0: a corner
                          points up. */
  double curvature;  /**< Polygon: radius of the disc divided by the radius of the edges, [0, 1]; 0,
                        the default: straight edges; 1: a disc. */
  double ring_inner; /**< Ring: radius of the hole divided by the radius of the disc, [0,
                        STARFOCUS_MAX_RING_INNER]; default 0.5. */
  /** Cat's eye: distance of a second rim from the axis, in radii of the lens, as seen from a corner
   *  of the picture, [0, 1]. Light passes only inside both rims. The distance of the second rim
   *  falls to 0 towards the middle of the picture. The cut by the second rim does not darken the
   *  picture. Values above 0 require STARFOCUS_FEATURE_SHAPES. STARFOCUS_MODE_BLUR ignores
   *  cats_eye. Default 0. */
  double cats_eye;
  /** Part of the picture to compute. All fields are 0 by default, which streams require. */
  starfocus_region region;
  /** For starfocus_refocus: the previous frame, from which unchanged superblocks are copied. The
   *  output bytes do not depend on `previous`. Both light fields and both pictures must have
   *  formats that do not require STARFOCUS_FEATURE_IMAGES. Default null. */
  const starfocus_previous* previous;
  /** Mode and renderer (starfocus/experimental.h); default null, which selects
   *  STARFOCUS_MODE_BLOCK. */
  const struct starfocus_study* study;
} starfocus_params;

/** Sets parameters to the defaults.
 *  @param params parameters; no-op if null */
static inline void starfocus_params_init(starfocus_params* params) {
  starfocus_defaults("starfocus_params", params, (uint32_t)sizeof *params);
}

/** Statistics of a refocusing. Call starfocus_report_init first. */
typedef struct starfocus_report {
  uint32_t size; /**< Size of the structure in bytes; set by starfocus_report_init. */
  int32_t n;     /**< N, the number of views along the radius of the aperture; the largest N of all
                    blocks. */
  int32_t rendered_views;    /**< Number of rendered views with `n` views along the radius. */
  int32_t superblock;        /**< Side of the superblocks, pixels. */
  double r_max;              /**< Largest blur radius that the disparity range allows, pixels. */
  uint64_t rendered_samples; /**< R, G and B samples rendered in all views and layers. */
  uint64_t copied_pixels;    /**< Pixels copied from the centre view because no view moves them. */
  uint64_t gathered_pixels;  /**< Pixels blurred without views (starfocus_tuning.gather). */
  uint64_t reused_blocks;    /**< Superblocks copied from starfocus_params.previous. */
  uint64_t unknown_pixels;   /**< Number of disparities that STARFOCUS_UNKNOWN_FILL filled in
                                the rows that were read; 0 for prepared light fields. */
  /** Receives the statistics of each layer (starfocus/experimental.h): STARFOCUS_LAYERS elements,
   *  of which frame modes use only the first. Default null. */
  struct starfocus_layer_report* layers;
  /** Pixels of the disparity map that were checked or converted; a pixel counts each time. */
  uint64_t converted_pixels;
  uint64_t measured_pixels; /**< Pixels whose blur was measured to plan blocks. */
} starfocus_report;

/** Sets all statistics to 0.
 *  @param report statistics; no-op if null */
static inline void starfocus_report_init(starfocus_report* report) {
  starfocus_defaults("starfocus_report", report, (uint32_t)sizeof *report);
}

/** Refocuses a light field. A refocused region is equal, byte for byte, to the corresponding part
 *  of the whole refocused picture. The engine computes only the blocks on which the region depends,
 *  and checks only the disparities that these blocks read.
 *  @param engine engine
 *  @param params lens and region
 *  @param light_field light field, which is read only during the call
 *  @param out picture of the region's size. The picture must not overlap the light field,
 *         `params->previous` or the workspace. Alpha is copied from the centre view, or set to 255.
 *         Chroma samples belong to 2 x 2 pixels of the output, even if the region has an odd
 *         position
 *  @param report receives statistics; may be null
 *  @return STARFOCUS_OK, or an error of the arguments (`out` is unchanged);
 *          STARFOCUS_ERROR_CANCELLED or STARFOCUS_ERROR_RUNNER (`out` is incomplete) */
STARFOCUS_API starfocus_status starfocus_refocus(starfocus_engine* engine,
                                                 const starfocus_params* params,
                                                 const starfocus_light_field* light_field,
                                                 const starfocus_image* out,
                                                 starfocus_report* report);

/** A light field that was converted for refocusing with any lens. */
typedef struct starfocus_prepared starfocus_prepared;

/** Computes the size of a prepared light field, which depends only on width, height, views,
 *  features, previews and starfocus_tuning.max_layer. Disparities take 2 bytes per pixel, and
 *  layers 1 and 2 take about 1.9 bytes per pixel (less with a smaller max_layer). Each preview
 *  takes 3 bytes per pixel of each reduced view, plus 3 bytes per pixel for disparity and coverage.
 *  @param config configuration of the engine that prepares the light field
 *  @param bytes receives the size in bytes
 *  @param problem receives the cause of an error; may be null
 *  @return STARFOCUS_OK, or an error of the configuration */
STARFOCUS_API starfocus_status starfocus_prepared_size(const starfocus_config* config,
                                                       size_t* bytes, starfocus_problem* problem);

/** Converts and checks the disparities of a light field and subsamples its centre view, so that
 *  many refocusings can share the results. Later calls read the views again, so the pixels of the
 *  views must stay unchanged until the last refocusing. The structure `light_field` may be changed
 *  after this call.
 *  @param engine engine
 *  @param light_field light field
 *  @param memory memory aligned to STARFOCUS_ALIGNMENT, which must not overlap the light field or
 *         the workspace; null: the function allocates memory with the allocator of
 *         starfocus_create, and starfocus_destroy_prepared frees the memory
 *  @param bytes size of `memory`, at least starfocus_prepared_size; ignored if `memory` is null
 *  @param prepared receives the prepared light field, or null on error
 *  @return STARFOCUS_OK, or an error of the arguments; STARFOCUS_ERROR_NULL if `memory` is null and
 *          starfocus_init created the engine; STARFOCUS_ERROR_MEMORY; STARFOCUS_ERROR_CANCELLED or
 *          STARFOCUS_ERROR_RUNNER (`memory` is unspecified) */
STARFOCUS_API starfocus_status starfocus_prepare(starfocus_engine* engine,
                                                 const starfocus_light_field* light_field,
                                                 void* memory, size_t bytes,
                                                 starfocus_prepared** prepared);

/** Frees a prepared light field that starfocus_prepare allocated. The engine may already be
 *  destroyed. No call with the prepared light field may be running.
 *  @param prepared prepared light field; no-op if null, or if the caller provided its memory */
STARFOCUS_API void starfocus_destroy_prepared(starfocus_prepared* prepared);

/** Refocuses a prepared light field. The output bytes are the same as with starfocus_refocus.
 *
 *  With a preview_shift s, the picture has 1 / S of the size, where S = 2^s, and takes about 1 /
 *  S^2 of the time. Even for a preview, all parameters are in pixels of the full size. A preview of
 *  the whole picture has width / S columns and height / S rows, both rounded up. In general, the
 *  output contains the columns from floor(x / S) to floor((x + width - 1) / S) of the reduced
 *  picture, where x and width describe the region. The rows of the output follow from y and height
 *  by the same formula. The alpha of a preview is 255, unless it is refocused. Previews read only
 * the prepared light field, and not the views.
 *
 *  A preview is the picture of a reduced light field, byte for byte. In the reduced light field a
 *  pixel of a view is the mean light of S x S pixels, in steps of 1/128 code. At the right and
 *  bottom edges, fewer pixels are averaged. In the reduced light field a disparity is the median of
 *  S x S disparities divided by S, rounded half up to 1/64. Of two middle values, the median is the
 *  larger one. A preview corresponds to a picture of an engine with the reduced size, and with the
 *  disparity range, max_blur and focus divided by S. Callbacks and the report count pixels of the
 *  preview.
 *  @param engine engine with the size, views, positions, disparity range, max_layer and transfer of
 *         the engine that prepared the light field. Several engines may use one prepared light
 *  field at the same time
 *  @param params lens and region; `params->previous` must be null
 *  @param prepared prepared light field
 *  @param out picture, as for starfocus_refocus
 *  @param report receives statistics; may be null
 *  @return as starfocus_refocus, or STARFOCUS_ERROR_PREPARED if the light field was prepared for
 *         another configuration or without this preview */
STARFOCUS_API starfocus_status starfocus_refocus_prepared(starfocus_engine* engine,
                                                          const starfocus_params* params,
                                                          const starfocus_prepared* prepared,
                                                          const starfocus_image* out,
                                                          starfocus_report* report);

/** Starts to refocus a picture by rows. An unfinished picture of an earlier stream is abandoned.
 *  After this call, push rows of the light field and pull rows of the picture in turn, until all
 *  rows are written.
 *  @param engine engine with STARFOCUS_FEATURE_STREAMING
 *  @param params lens; `region` must be all 0 and `previous` null
 *  @return STARFOCUS_OK, or an error of the arguments */
STARFOCUS_API starfocus_status starfocus_stream_begin(starfocus_engine* engine,
                                                      const starfocus_params* params);

/** Copies the next rows of the light field into the engine, up to the free space of its ring
 *  buffers.
 *  @param engine engine
 *  @param light_field rows of the light field. Planes of views and coverage point to the first new
 *         row. `depth.height` is the height of the whole map. If the map has the picture's height,
 *         `depth.data` points to the first new row as well. A map of smaller height is passed whole
 *         in every call. All pushes of a stream must pass the same map, apart from `depth.data`;
 *         the engine does not check this. Coverage must be present for all rows or for none
 *  @param rows number of rows, at most the number of rows left. If a view has chroma samples of 2 x
 *         2 pixels, `rows` must be even, except at the end of the picture
 *  @param consumed receives the number of copied rows, at most `rows`. If fewer rows were copied,
 *         pull rows before you push the rest
 *  @return STARFOCUS_OK, or an error of the arguments. After STARFOCUS_ERROR_DISPARITY and
 *         STARFOCUS_ERROR_NOT_FINITE, the rows before the invalid row are consumed. The result is
 *         STARFOCUS_ERROR_STATE if no stream is active, or if only some rows have coverage */
STARFOCUS_API starfocus_status starfocus_stream_push(starfocus_engine* engine,
                                                     const starfocus_light_field* light_field,
                                                     int32_t rows, int32_t* consumed);

/** Writes the next finished rows of the picture.
 *
 *  After STARFOCUS_ERROR_RUNNER and STARFOCUS_ERROR_CANCELLED the stream remains valid: `*written`
 *  rows are complete, and the next pull resumes after these rows. The next pull reports
 *  half-finished blocks to on_block again, but counts each block once. starfocus_refocus,
 *  starfocus_refocus_prepared and starfocus_prepare end the stream when they have accepted their
 *  arguments, before they check disparities. The progress callback counts rows of the whole
 *  picture.
 *  @param engine engine
 *  @param out image of the rows to write, whose planes point to the first of these rows. The image
 *         must not overlap the workspace
 *  @param rows largest number of rows to write; may exceed the number of rows left. If two rows
 *         share chroma samples, `rows` must be even, except at the end of the picture
 *  @param written receives the number of written rows; 0 if more rows must be pushed first
 *  @param report receives statistics, which are complete after the last row. May be null
 *  @return STARFOCUS_OK, or an error of the arguments; STARFOCUS_ERROR_CANCELLED or
 *          STARFOCUS_ERROR_RUNNER; STARFOCUS_ERROR_STATE if no stream is active */
STARFOCUS_API starfocus_status starfocus_stream_pull(starfocus_engine* engine,
                                                     const starfocus_image* out, int32_t rows,
                                                     int32_t* written, starfocus_report* report);

/** Range of the disparities of a depth map. */
typedef struct starfocus_disparity_stats {
  double min;      /**< Smallest known disparity; 0 if no disparity is known. */
  double max;      /**< Largest known disparity; 0 if no disparity is known. */
  int64_t invalid; /**< Number of values whose disparity is unknown. */
} starfocus_disparity_stats;

/** Measures the range of the disparities of a depth map. Engines with disparity_min and
 *  disparity_max of this range accept the map.
 *  @param depth map of any format, whose size is [1, STARFOCUS_MAX_SIZE]
 *  @param stats receives the range
 *  @param problem receives the cause of an error; may be null
 *  @return STARFOCUS_OK, or an error of the arguments */
STARFOCUS_API starfocus_status starfocus_measure_disparity(const starfocus_depth_map* depth,
                                                           starfocus_disparity_stats* stats,
                                                           starfocus_problem* problem);

/** Fills the values of a disparity map that are NaN or infinite, in place. Between two finite
 *  values of a row, all values are set to the smaller finite value, which belongs to the farther
 *  surface. At the ends of a row, values are set to the nearest finite value. Rows without a finite
 *  value are filled from the rows above and below, by the rule that is used for the values of a
 *  row.
 *  @param disparity map, aligned to 4 bytes
 *  @param stride bytes from row to row, a multiple of 4, >= 4 * width
 *  @param width,height size of the map in pixels, [1, STARFOCUS_MAX_SIZE]
 *  @param problem receives the cause of an error; may be null
 *  @return STARFOCUS_OK, an error of the arguments, or STARFOCUS_ERROR_ALL_INVALID if no value is
 *          finite */
STARFOCUS_API starfocus_status starfocus_fill_disparity(float* disparity, size_t stride,
                                                        int32_t width, int32_t height,
                                                        starfocus_problem* problem);

/** Finds the focus for a pixel of the picture, for example for a pixel that a user tapped. The
 *  function reads the value of the map that contains the middle of the pixel, and the known values
 *  up to 3 values away. The focus is the median of the disparities that differ from the disparity
 *  of the pixel by at most 0.75. If the disparity of the pixel is unknown, or the disparities of
 *  all 8 neighbours differ by more than 0.75, the function uses the surface to which most of the
 *  surrounding 7 x 7 values belong.
 *  @param depth map of any format, at most as wide and as high as the picture
 *  @param width,height size of the picture in pixels, [1, STARFOCUS_MAX_SIZE]
 *  @param x,y pixel inside the picture
 *  @param focus receives the disparity to focus at
 *  @param problem receives the cause of an error; may be null
 *  @return STARFOCUS_OK, an error of the arguments, or STARFOCUS_ERROR_NOT_FINITE if all 7 x 7
 *          disparities are unknown */
STARFOCUS_API starfocus_status starfocus_focus_at(const starfocus_depth_map* depth, int32_t width,
                                                  int32_t height, int32_t x, int32_t y,
                                                  double* focus, starfocus_problem* problem);

/** Computes the largest aperture that an engine accepts: the aperture at which the largest blur
 *  radius of the configured range of disparities is max_blur, but at most 1.
 *  @param engine engine
 *  @param params range in focus; the other fields are ignored
 *  @param aperture receives the aperture; may point to params->aperture
 *  @return STARFOCUS_OK, STARFOCUS_ERROR_NULL, STARFOCUS_ERROR_STRUCTURE, or STARFOCUS_ERROR_RANGE
 *          if the focus is out of range */
STARFOCUS_API starfocus_status starfocus_largest_aperture(starfocus_engine* engine,
                                                          const starfocus_params* params,
                                                          double* aperture);

/** Size of a plane of a picture, for copies of planes.
 *  @param image picture, of which format and pixel_stride are read
 *  @param plane index of the plane, [0, 2]
 *  @param width,height size of the picture in pixels, [1, STARFOCUS_MAX_SIZE]
 *  @param rows receives the number of rows; 0 if the format has no such plane
 *  @param row_bytes receives the number of bytes of a row, without padding at its end
 *  @param problem receives the cause of an error; may be null
 *  @return STARFOCUS_OK, or an error of the arguments */
STARFOCUS_API starfocus_status starfocus_plane_size(const starfocus_image* image, int32_t plane,
                                                    int32_t width, int32_t height, int32_t* rows,
                                                    size_t* row_bytes, starfocus_problem* problem);

/** Type of a field of a public structure. */
typedef enum starfocus_field_type {
  STARFOCUS_FIELD_INT32 = 0,     /**< int32_t, also for enumerations. */
  STARFOCUS_FIELD_UINT32 = 1,    /**< uint32_t, or size_t with 32 bits. */
  STARFOCUS_FIELD_INT64 = 2,     /**< int64_t. */
  STARFOCUS_FIELD_UINT64 = 3,    /**< uint64_t, or size_t with 64 bits. */
  STARFOCUS_FIELD_DOUBLE = 4,    /**< double. */
  STARFOCUS_FIELD_POINTER = 5,   /**< A pointer to data. */
  STARFOCUS_FIELD_STRUCTURE = 6, /**< A structure by value. */
  STARFOCUS_FIELD_STRING = 7,    /**< A pointer to a string that ends with a zero. */
  STARFOCUS_FIELD_FUNCTION = 8   /**< A pointer to a function. */
} starfocus_field_type;

/** A field of a public structure, in static storage. */
typedef struct starfocus_field {
  const char* name;      /**< Name of the field, for example "width". */
  const char* structure; /**< Name of the structure that the field contains or points to; null if
                            it has none, or if the structure has no public fields. */
  uint32_t offset;       /**< Bytes before the field. */
  uint32_t count;        /**< Number of elements of an array; 1 for a single field. */
  int32_t type;          /**< starfocus_field_type, of an element for arrays. */
} starfocus_field;

/** Lists the fields of a public structure, from which bindings build their structures.
 *  @param structure name of the structure, for example "starfocus_config"
 *  @param fields receives the first field, in the order of offsets; may be null
 *  @param count receives the number of fields; may be null
 *  @return the size of the structure in bytes, or 0 if the name is unknown or null */
STARFOCUS_API size_t starfocus_fields(const char* structure, const starfocus_field** fields,
                                      int32_t* count);

/** Returns the SIMD target that the kernels use on this machine.
 *  @return the name of the target, for example "AVX2", in static storage */
STARFOCUS_API const char* starfocus_simd_target(void);

#ifdef __cplusplus
}
#endif

#endif /* STARFOCUS_STARFOCUS_H_ */
