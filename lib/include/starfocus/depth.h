/* SPDX-License-Identifier: Apache-2.0 */
/** @file
 * Estimation of disparity maps from the views of a light field, and repair of given maps. Programs
 * that already have maps do not need this header. The conventions of starfocus.h apply.
 *
 * @code
 * #include <starfocus/depth.h>
 * #include <stdlib.h>
 *
 * // Estimates a map of disparities from -8 to 8 from 5 views. Returns a starfocus_status.
 * int Estimate(const starfocus_light_field* light_field, int width, int height, float* disparity) {
 *   starfocus_depth_config config;
 *   starfocus_depth_config_init(&config);
 *   config.width = width;
 *   config.height = height;
 *   config.disparity_min = -8;
 *   config.disparity_max = 8;
 *   size_t bytes = 0;
 *   starfocus_status status = starfocus_estimate_workspace_size(&config, &bytes);
 *   if (status != STARFOCUS_OK) return status;
 *   const size_t blocks = (bytes + STARFOCUS_ALIGNMENT - 1) / STARFOCUS_ALIGNMENT;
 *   void* workspace = aligned_alloc(STARFOCUS_ALIGNMENT, STARFOCUS_ALIGNMENT * blocks);
 *   if (workspace == NULL) return STARFOCUS_ERROR_MEMORY;
 *   starfocus_disparity_output map = {0};
 *   map.disparity = disparity;
 *   map.disparity_stride = sizeof(float) * (size_t)width;
 *   status = starfocus_estimate_disparity(&config, light_field, &map, workspace, bytes);
 *   free(workspace);
 *   return status;
 * }
 * @endcode
 *
 * The bytes of a map depend only on the configuration and the pictures, not on the runner, the
 * number of workers or the SIMD target.
 */
#ifndef STARFOCUS_DEPTH_H_
#define STARFOCUS_DEPTH_H_

#include "starfocus/starfocus.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Configuration for estimating or repairing a disparity map. Call starfocus_depth_config_init
 *  first. */
typedef struct starfocus_depth_config {
  uint32_t size;  /**< Size of the structure in bytes; set by starfocus_depth_config_init. */
  int32_t width;  /**< Width of the views in pixels, [1, STARFOCUS_MAX_SIZE]. */
  int32_t height; /**< Height of the views in pixels, [1, STARFOCUS_MAX_SIZE]. */
  /** Number of views. Without `positions`: 5, 9 or 17 in the order of starfocus_view_position, or 1
   *  for starfocus_repair_disparity. With `positions`: 2 to STARFOCUS_MAX_VIEWS. Default 5. */
  int32_t views;
  /** Smallest disparity, within +-STARFOCUS_MAX_DISPARITY; default NaN, which is rejected: a range
   *  that is not set is no range. */
  double disparity_min;
  /** Largest disparity, disparity_min to STARFOCUS_MAX_DISPARITY; default NaN. The disparity range
   * is searched in steps of half a pixel. In a disparity range wider than 64 pixels, the steps are
   *  one pixel or more. The number of steps is at most 128. Disparities between two steps are
   *  interpolated. */
  double disparity_max;
  int32_t max_workers; /**< Number of workers, [1, STARFOCUS_MAX_WORKERS]; default 1. */
  /** STARFOCUS_FEATURE_IMAGES or 0, the default. Without this feature, views are packed RGB, and a
   *  map to repair is a map of starfocus_depth_float in the size of the picture. With this feature,
   *  views and maps may have any format. The function first converts views and maps in the
   *  workspace. The conversion takes 3 more bytes per pixel of each view and, for a repair, 4 more
   *  bytes per pixel of the picture. */
  uint32_t features;
  starfocus_runner runner; /**< Runs jobs; default null: the calling thread runs them. */
  void* runner_data;       /**< Passed to `runner`. */
  /** Receives finished rows of the map after each tile, which takes up to 50 ms; default null.
   *  After STARFOCUS_ERROR_CANCELLED the outputs and the workspace are unspecified. */
  starfocus_progress progress;
  void* progress_data;        /**< Passed to `progress`. */
  starfocus_problem* problem; /**< Receives the cause of an error of a call; default null. */
  /** Positions of the views, as in starfocus_config: within [-1, 1], the first (0, 0), and all
   *  different. The views of a stereo pair have the positions (0, 0) and (1, 0). Default all 0,
   *  which selects the positions of starfocus_view_position. starfocus_repair_disparity requires
   *  the positions of starfocus_view_position. */
  starfocus_position positions[STARFOCUS_MAX_VIEWS];
} starfocus_depth_config;

/** Output planes of an estimate or repair of a disparity map, and of the functions of
 *  starfocus/matte.h. The planes must not overlap the views, the given map, the workspace or each
 *  other. */
typedef struct starfocus_disparity_output {
  float* disparity;         /**< Disparities, aligned to 4 bytes. */
  size_t disparity_stride;  /**< Bytes from row to row, >= 4 * width, a multiple of 4. */
  uint8_t* confidence;      /**< Confidence of each disparity; 0: no confidence; may be null. */
  size_t confidence_stride; /**< Bytes from row to row, >= width. */
  uint8_t* coverage;        /**< Receives coverage for starfocus_light_field.coverage; may be null.
                               starfocus_repair_disparity of one view writes the coverage of hair. */
  size_t coverage_stride;   /**< Bytes from row to row, >= width. */
  int32_t has_coverage; /**< Set by the call: 1 if `coverage` contains coverage that belongs to the
                           map; 0 if `coverage` is unspecified. */
} starfocus_disparity_output;

/** Sets the first `size` bytes of a configuration to the defaults. This function is for bindings;
 *  programs in C and C++ call starfocus_depth_config_init.
 *  @param config configuration; no-op if null
 *  @param size size of the caller's structure in bytes */
STARFOCUS_API void starfocus_depth_config_init_sized(starfocus_depth_config* config, uint32_t size);

/** Sets a configuration to the defaults.
 *  @param config configuration; no-op if null */
static inline void starfocus_depth_config_init(starfocus_depth_config* config) {
  starfocus_depth_config_init_sized(config, (uint32_t)sizeof(starfocus_depth_config));
}

/** Computes the workspace size of starfocus_estimate_disparity: 5 bytes per pixel of the picture,
 *  plus memory for each worker. If all side views lie on one side of the centre, the workspace
 *  contains 2 more bytes per pixel for each side view. Each worker takes up to 1.2 MB per pixel of
 *  the disparity range. In addition, each worker takes about 10, 20 or 45 MB with 5, 9 or 17 views
 *  at the positions of starfocus_view_position. At other positions, each worker takes up to 14 MB
 *  for each view that moves along both axes.
 *  @param config configuration
 *  @param bytes receives the size in bytes
 *  @return STARFOCUS_OK, or an error of the configuration */
STARFOCUS_API starfocus_status
starfocus_estimate_workspace_size(const starfocus_depth_config* config, size_t* bytes);

/** Estimates the disparity of each pixel of the centre view. The result is the disparity at which
 *  the views that see the pixel agree best, smoothed between neighbouring pixels. All disparities
 *  lie in the configured range.
 *
 *  The confidence is the cost of the best other disparity, at least two steps away, minus the cost
 *  of the result. Costs are in quarters of a code, summed over R, G and B. The confidence is 0 if
 *  another disparity fits equally well, for example on a wall of one colour, and at most 255.
 *
 *  If all side views lie on one side of the centre, as in a stereo pair, a foreground hides the
 *  background next to one of its edges from all side views. Such pixels get confidence 0 and the
 *  disparity of the adjacent background.
 *  @param config configuration
 *  @param light_field views; `depth` is ignored
 *  @param map output planes
 *  @param workspace memory aligned to STARFOCUS_ALIGNMENT
 *  @param bytes size of the workspace, at least starfocus_estimate_workspace_size
 *  @return STARFOCUS_OK, an error of the arguments, STARFOCUS_ERROR_CANCELLED or
 *          STARFOCUS_ERROR_RUNNER */
STARFOCUS_API starfocus_status starfocus_estimate_disparity(
    const starfocus_depth_config* config, const starfocus_light_field* light_field,
    starfocus_disparity_output* map, void* workspace, size_t bytes);

/** Computes the workspace size of starfocus_repair_disparity: 12 bytes per pixel of the picture,
 *  plus about as much memory for each worker as starfocus_estimate_disparity uses.
 *  @param config configuration
 *  @param bytes receives the size in bytes
 *  @return STARFOCUS_OK, or an error of the configuration */
STARFOCUS_API starfocus_status starfocus_repair_workspace_size(const starfocus_depth_config* config,
                                                               size_t* bytes);

/** Repairs the disparity map of a light field: removes noise, fills unknown values and corrects
 *  edges. Edges of the map are corrected if they are blurred, too coarse, or displaced from the
 *  edges of the picture.
 *
 *  With side views, the function estimates disparities with a cost that grows with the distance
 *  from the given disparities. With one view, the function compares colours. Outlines in the map
 *  become as smooth as outlines in the picture, and foreground surfaces grow where the picture's
 *  edges are soft. Values that the views do not contradict are not changed, except in noisy maps of
 *  one view.
 *
 *  The confidence is defined as for starfocus_estimate_disparity. The confidence is 0 where the
 *  views contradict a value too weakly to change the value. At uncontradicted values far from
 *  edges, the confidence is the difference between the centre view and the centre view moved by one
 *  pixel.
 *
 *  Maps of monocular networks show hair as a solid shape with one closed outline. If the only view
 *  has such a map and `map->coverage` is not null, the coverage of the hair is found by colour. In
 *  this case, the disparities of the hair are not changed, and their confidence is 255 minus the
 *  change of coverage. Outside hair, coverage is 0 or 255, as the map alone implies.
 *  @param config configuration
 *  @param light_field views, and in `depth` the map to repair. The known disparities of the map
 *         must lie in the configured range, which may be wider than the range of the map
 *  @param map output planes
 *  @param workspace memory aligned to STARFOCUS_ALIGNMENT
 *  @param bytes size of the workspace, at least starfocus_repair_workspace_size
 *  @return STARFOCUS_OK, an error of the arguments, STARFOCUS_ERROR_DISPARITY,
 *          STARFOCUS_ERROR_ALL_INVALID, STARFOCUS_ERROR_CANCELLED or STARFOCUS_ERROR_RUNNER */
STARFOCUS_API starfocus_status starfocus_repair_disparity(const starfocus_depth_config* config,
                                                          const starfocus_light_field* light_field,
                                                          starfocus_disparity_output* map,
                                                          void* workspace, size_t bytes);

#ifdef __cplusplus
}
#endif

#endif /* STARFOCUS_DEPTH_H_ */
