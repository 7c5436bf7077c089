/* SPDX-License-Identifier: Apache-2.0 */
/** @file
 * The modes and renderers of the paper, trade-offs between time and error, and measurements of an
 * engine. Within one ABI, the meaning of fields and the values that they accept may change. Layouts
 * and STARFOCUS_LAYERS do not change, except that structures with a field `size` may grow. The
 * conventions of starfocus.h apply. Programs that only refocus pictures do not need this header. */
#ifndef STARFOCUS_EXPERIMENTAL_H_
#define STARFOCUS_EXPERIMENTAL_H_

#include "starfocus/starfocus.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Mode of refocusing, which determines the division of the picture into blocks and the number of
 *  rendered views. */
typedef enum starfocus_mode {
  /** One N, the number of views along the radius, for the whole picture, by equation (9). */
  STARFOCUS_MODE_FRAME = 0,
  /** N = 2 ceil(r_max) for the whole picture: the paper's benchmark of quality. In this mode, the
   *  slice renderer uses thinner slices than in other modes. */
  STARFOCUS_MODE_BENCHMARK = 1,
  /** Blocks of different sizes, each with its own N and layer (section V). The half-band filters of
   *  layers 1 and 2 overshoot: the light of a pixel may lie outside the range of the surrounding
   *  light. The overshoot is up to 4 % of this range with slices, and up to 13 % with line scans.
   *  With shapes other than the default, the overshoot is up to 4 % with slices, and up to 50 %
   *  with line scans. With STARFOCUS_TRANSFER_SRGB, 4 % of white is the code 56. */
  STARFOCUS_MODE_BLOCK = 2,
  /** The centre view, blurred by the point-spread function (4) without other views.
   *  STARFOCUS_MODE_BLUR takes up to ten times as long as STARFOCUS_MODE_BLOCK. */
  STARFOCUS_MODE_BLUR = 3
} starfocus_mode;

/** Method that renders views. */
typedef enum starfocus_renderer {
  /** Line scans for STARFOCUS_MODE_FRAME with starfocus_tuning.line_scan and 5 or more views at the
   *  positions of starfocus_view_position; otherwise slices. */
  STARFOCUS_RENDERER_AUTO = 0,
  /** The paper's line scan (section IV), with views about one pixel apart (9). Requires
   *  starfocus_tuning.line_scan and the views of starfocus_view_position. */
  STARFOCUS_RENDERER_LINE_SCAN = 1,
  /** Slices of the scene, with fewer views: each view stands for a subaperture of the lens. */
  STARFOCUS_RENDERER_SLICES = 2
} starfocus_renderer;

/** Mode and renderer of a refocusing. Call starfocus_study_init first. */
typedef struct starfocus_study {
  uint32_t size;    /**< Size of the structure in bytes; set by starfocus_study_init. */
  int32_t mode;     /**< starfocus_mode; default STARFOCUS_MODE_BLOCK. */
  int32_t renderer; /**< starfocus_renderer; default STARFOCUS_RENDERER_AUTO. Ignored by
                         STARFOCUS_MODE_BLUR. */
} starfocus_study;

/** Sets mode and renderer to the defaults.
 *  @param study mode and renderer; no-op if null */
static inline void starfocus_study_init(starfocus_study* study) {
  starfocus_defaults("starfocus_study", study, (uint32_t)sizeof *study);
}

/** Number of layers L, which are the picture at full size (L = 0) and two subsampled copies of the
 *  picture. */
#define STARFOCUS_LAYERS 3
/** Largest coefficient of starfocus_timing. */
#define STARFOCUS_MAX_TIMING 100000000u
/** Smallest starfocus_tuning.n_scale. */
#define STARFOCUS_MIN_N_SCALE 0.5
/** Largest starfocus_tuning.n_scale. */
#define STARFOCUS_MAX_N_SCALE 2.0

/** Model of the time that a block takes: equation (14) of the paper, with additional terms for the
 *  work around the line scan. Coefficients are in picoseconds; only their ratios matter. The model
 *  determines how STARFOCUS_MODE_BLOCK splits superblocks, and therefore affects the output bytes.
 *  starfocus_tuning_init sets the same coefficients on every machine, so that all machines compute
 *  the same picture. Coefficients that were fitted to single boards saved at most 0.4 % of the
 *  instructions (docs/boards.md). */
typedef struct starfocus_timing {
  uint32_t block; /**< Picoseconds per block. */
  uint32_t field; /**< Picoseconds per pixel of the block with its border, at the layer of the
                     block, for loading and rotating. */
  uint32_t a; /**< k_A of (14), picoseconds per rendered pixel of type A (views on the axes), with
                 the border of the other axis. */
  uint32_t
      b; /**< k_B of (14), picoseconds per rendered pixel of type B (views on the diagonals). */
  uint32_t c; /**< k_C of (14), picoseconds per rendered pixel of type C (all other views). */
  uint32_t upsample; /**< Picoseconds per pixel of the picture in a block at layer 1 or 2. */
  uint32_t span; /**< Picoseconds per run of equal disparity in a rendered line; a line counts as at
                    least one run. */
  uint32_t hole; /**< Picoseconds per pixel that depth edges uncover in the outermost view, at most
                    8 pixels for each edge. */
} starfocus_timing;

/** Code of the paper's renderer, which is linked only by programs that name it. */
typedef struct starfocus_line_scan starfocus_line_scan;

/** Returns the paper's renderer for starfocus_tuning.line_scan.
 *  @return the renderer, in static storage */
STARFOCUS_API const starfocus_line_scan* starfocus_line_scan_renderer(void);

/** Trade-offs between time and error. Call starfocus_tuning_init first. */
typedef struct starfocus_tuning {
  uint32_t size;      /**< Size of the structure in bytes; set by starfocus_tuning_init. */
  int32_t max_layer;  /**< Largest layer L of STARFOCUS_MODE_BLOCK, [0, 2]; default 2. */
  int32_t deblocking; /**< Limit beta of deblocking, (16) and (17), in codes, [0, 255]; 0: off;
                         default 35. */
  /** If 1, STARFOCUS_MODE_BLOCK with slices gathers the pixels of smooth surfaces, which means that
   *  the centre view is blurred by the point-spread function (4). If 0, STARFOCUS_MODE_BLOCK
   *  renders views for all pixels. Default 1. */
  int32_t gather;
  /** STARFOCUS_MODE_BLOCK and STARFOCUS_MODE_FRAME multiply N, the number of views along the
   *  radius, by this factor and round the product up. The number of views grows with the square of
   *  the factor. Range [STARFOCUS_MIN_N_SCALE, STARFOCUS_MAX_N_SCALE]; default 1. */
  double n_scale;
  starfocus_timing timing; /**< Each coefficient <= STARFOCUS_MAX_TIMING. */
  /** The result of starfocus_line_scan_renderer enables STARFOCUS_RENDERER_LINE_SCAN and reserves
   *  its memory in the workspace. Default null: STARFOCUS_RENDERER_AUTO always selects slices, and
   *  calls reject STARFOCUS_RENDERER_LINE_SCAN with STARFOCUS_ERROR_FEATURE. */
  const starfocus_line_scan* line_scan;
} starfocus_tuning;

/** Sets the tuning to the defaults.
 *  @param tuning tuning; no-op if null */
static inline void starfocus_tuning_init(starfocus_tuning* tuning) {
  starfocus_defaults("starfocus_tuning", tuning, (uint32_t)sizeof *tuning);
}

/** A block of a picture, which is refocused with its own layer and number of views. */
typedef struct starfocus_block {
  int32_t x;      /**< Left column in the picture. */
  int32_t y;      /**< Top row in the picture. */
  int32_t width;  /**< Number of columns; may be less than `height` at the right edge. */
  int32_t height; /**< Number of rows; may be less than `width` at the bottom edge. */
  int32_t layer;  /**< Layer L: the block is rendered at 1 / 2^L of its size. */
  int32_t n; /**< N, the number of views along the aperture's radius; 0: only the centre view. */
} starfocus_block;

/** Statistics of the blocks of one layer, an element of starfocus_report.layers. */
typedef struct starfocus_layer_report {
  uint64_t blocks; /**< Number of blocks. */
  uint64_t pixels; /**< Number of pixels of the picture that the blocks cover. */
  uint64_t views;  /**< Number of rendered views, summed over the blocks; a block that is copied or
                      gathered as a whole counts as 1. */
  uint64_t rendered_samples; /**< R, G and B samples rendered in all views and slices. */
  uint64_t predicted_ps;     /**< Time predicted by starfocus_timing, picoseconds. */
  uint64_t measured_ns; /**< Time measured by starfocus_observer.clock, summed over the workers,
                             nanoseconds; 0 without a clock. */
  /* Work of rendering slices: pixels of the layer that each stage touched. A pixel counts as often
     as it was touched. 0 for line scans. */
  uint64_t surface_pixels; /**< Pixels whose surfaces were found, with the borders of rectangles. */
  uint64_t hidden_pixels;  /**< Pixels of the groups of 16 that have hidden surfaces. */
  uint64_t filled_pixels;  /**< Pixels of the rectangles in which colours of hidden surfaces were
                                continued. */
  uint64_t selected_pixels;   /**< Pixels of surfaces that were read to fill slices. */
  uint64_t shifted_pixels;    /**< Pixels of slices that were shifted along rows. */
  uint64_t composited_pixels; /**< Pixels that were composited; `rendered_samples` also counts their
                                   views and slices. */
} starfocus_layer_report;

/** Measures an engine. Each pointer may be null. Call starfocus_observer_init first. */
typedef struct starfocus_observer {
  uint32_t size; /**< Size of the structure in bytes; set by starfocus_observer_init. */
  /** Returns a time in nanoseconds since an arbitrary fixed moment, for
   *  starfocus_layer_report.measured_ns. The threads of the runner call this function.
   *  @param data `clock_data` of this structure */
  uint64_t (*clock)(void* data);
  void* clock_data; /**< Passed to `clock`. */
  /** Receives each block before the block is refocused, on the thread of the call.
   *  @param data `on_block_data` of this structure
   *  @param block the block, valid during the callback */
  void (*on_block)(void* data, const starfocus_block* block);
  void* on_block_data; /**< Passed to `on_block`. */
} starfocus_observer;

/** Sets all pointers to null.
 *  @param observer observer; no-op if null */
static inline void starfocus_observer_init(starfocus_observer* observer) {
  starfocus_defaults("starfocus_observer", observer, (uint32_t)sizeof *observer);
}

#ifdef __cplusplus
}
#endif

#endif /* STARFOCUS_EXPERIMENTAL_H_ */
