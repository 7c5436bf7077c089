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
 *   starfocus_config config;
 *   starfocus_config_init(&config);
 *   config.width = width;
 *   config.height = height;
 *   config.disparity_min = -8;
 *   config.disparity_max = 8;
 *   size_t bytes = 0;
 *   starfocus_status status = starfocus_map_workspace_size(&config, 0, &bytes, NULL);
 *   if (status != STARFOCUS_OK) return status;
 *   const size_t blocks = (bytes + STARFOCUS_ALIGNMENT - 1) / STARFOCUS_ALIGNMENT;
 *   void* workspace = aligned_alloc(STARFOCUS_ALIGNMENT, STARFOCUS_ALIGNMENT * blocks);
 *   if (workspace == NULL) return STARFOCUS_ERROR_MEMORY;
 *   starfocus_disparity_output map = {0};
 *   map.disparity = disparity;
 *   map.disparity_stride = sizeof(float) * (size_t)width;
 *   status =
 *       starfocus_estimate_disparity(&config, NULL, light_field, &map, workspace, bytes, NULL);
 *   free(workspace);
 *   return status;
 * }
 * @endcode
 *
 * The functions read these fields of starfocus_config: size, width, height, views, positions,
 * disparity_min, disparity_max, max_workers and the bit STARFOCUS_FEATURE_IMAGES of features.
 *
 * The disparity range is searched in steps of half a pixel. In a range wider than 64 pixels, the
 * steps are one pixel or more. The number of steps is at most 128. Disparities between two steps
 * are interpolated. An estimate requires disparity_max > disparity_min.
 *
 * Without `positions`, the number of views is 5, 9 or 17, or 1 for a repair. With `positions`, 2 to
 * STARFOCUS_MAX_VIEWS views are estimated; the views of a stereo pair have the positions (0, 0) and
 * (1, 0). A repair requires the positions of starfocus_view_position.
 *
 * With STARFOCUS_FEATURE_IMAGES, views and maps may have any format. They are first converted in
 * the workspace, which takes 3 more bytes per pixel of each view and, for a repair, 4 more bytes
 * per pixel of the picture. Without this feature, views are packed RGB, and a map to repair is a
 * map of starfocus_depth_float in the size of the picture.
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

/** Computes the workspace size of starfocus_estimate_disparity and starfocus_repair_disparity.
 *
 *  An estimate takes 5 bytes per pixel of the picture, plus memory for each worker. If all side
 *  views lie on one side of the centre, the workspace contains 2 more bytes per pixel for each side
 *  view. Each worker takes up to 1.2 MB per pixel of the disparity range. In addition, each worker
 *  takes about 10, 20 or 45 MB with 5, 9 or 17 views at the positions of starfocus_view_position.
 *  At other positions, each worker takes up to 14 MB for each view that moves along both axes.
 *
 *  A repair takes 12 bytes per pixel of the picture, plus about as much memory for each worker.
 *  @param config configuration
 *  @param repairs 1 for starfocus_repair_disparity, 0 for starfocus_estimate_disparity; other
 *         values are rejected
 *  @param bytes receives the size in bytes
 *  @param problem receives the cause of an error; may be null
 *  @return STARFOCUS_OK, or an error of the configuration */
STARFOCUS_API starfocus_status starfocus_map_workspace_size(const starfocus_config* config,
                                                            int32_t repairs, size_t* bytes,
                                                            starfocus_problem* problem);

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
 *  @param callbacks runner and progress; null: the calling thread does all work. The progress
 *         callback receives finished rows of the map after each tile, which takes up to 50 ms
 *  @param light_field views; `depth` is ignored
 *  @param map output planes
 *  @param workspace memory aligned to STARFOCUS_ALIGNMENT
 *  @param bytes size of the workspace, at least starfocus_map_workspace_size
 *  @param problem receives the cause of an error; may be null
 *  @return STARFOCUS_OK, an error of the arguments, STARFOCUS_ERROR_CANCELLED or
 *          STARFOCUS_ERROR_RUNNER */
STARFOCUS_API starfocus_status starfocus_estimate_disparity(
    const starfocus_config* config, const starfocus_callbacks* callbacks,
    const starfocus_light_field* light_field, starfocus_disparity_output* map, void* workspace,
    size_t bytes, starfocus_problem* problem);

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
 *  @param callbacks runner and progress; null: the calling thread does all work. The progress
 *         callback receives finished rows of the map after each tile, which takes up to 50 ms
 *  @param light_field views, and in `depth` the map to repair. The known disparities of the map
 *         must lie in the configured range, which may be wider than the range of the map
 *  @param map output planes
 *  @param workspace memory aligned to STARFOCUS_ALIGNMENT
 *  @param bytes size of the workspace, at least starfocus_map_workspace_size
 *  @param problem receives the cause of an error; may be null
 *  @return STARFOCUS_OK, an error of the arguments, STARFOCUS_ERROR_DISPARITY,
 *          STARFOCUS_ERROR_ALL_INVALID, STARFOCUS_ERROR_CANCELLED or STARFOCUS_ERROR_RUNNER */
STARFOCUS_API starfocus_status starfocus_repair_disparity(const starfocus_config* config,
                                                          const starfocus_callbacks* callbacks,
                                                          const starfocus_light_field* light_field,
                                                          starfocus_disparity_output* map,
                                                          void* workspace, size_t bytes,
                                                          starfocus_problem* problem);

#ifdef __cplusplus
}
#endif

#endif /* STARFOCUS_DEPTH_H_ */
