/* SPDX-License-Identifier: Apache-2.0 */
/* starfocus: disparity maps from captured views. C ABI; conventions as in starfocus.h. A program
 * that makes no disparity maps does not need this header. Views are of STARFOCUS_FORMAT_RGB without
 * gaps between pixels.
 *
 * Use: starfocus_depth_config_init, fill the fields in, starfocus_estimate_workspace_size, allocate
 * that many bytes aligned to STARFOCUS_ALIGNMENT, starfocus_estimate_disparity. The bytes of a map
 * depend on the configuration and the pictures alone, and not on workers, runner or SIMD target.
 */
#ifndef STARFOCUS_DEPTH_H_
#define STARFOCUS_DEPTH_H_

#include "starfocus/starfocus.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What a map is made from. Call starfocus_depth_config_init first. */
typedef struct starfocus_depth_config {
  uint32_t size;  /**< of the structure in bytes, set by starfocus_depth_config_init */
  int32_t width;  /**< pixels, [1, STARFOCUS_MAX_SIZE] */
  int32_t height; /**< pixels, [1, STARFOCUS_MAX_SIZE] */
  int32_t views;  /**< captured views: 5, 9 or 17 (see starfocus_view_position), and 1 for
                       starfocus_repair_disparity; default 5 */
  double
      disparity_min; /**< least disparity of the map, within +-STARFOCUS_MAX_DISPARITY; default 0 */
  double disparity_max; /**< largest one; default 0. The range is searched in steps of half a pixel,
                            or if it is wider than 64, of a pixel or more (at most 128 steps).
                           Values between two steps are interpolated */
  int32_t max_workers;  /**< workers the runner may use, [1, STARFOCUS_MAX_WORKERS]; default 1 */
  starfocus_runner runner; /**< runs the jobs; null, the default: the calling thread runs them */
  void* runner_data;       /**< passed to runner */
  starfocus_progress progress; /**< receives rows of the map as the work proceeds; null, the
                           default: no progress is reported. It is called after each tile of the
                           picture, which takes up to 50 ms; after STARFOCUS_ERROR_CANCELLED the
                           outputs and the workspace are unspecified */
  void* progress_data;         /**< passed to progress */
  starfocus_problem* problem; /**< where a call tells what it refuses; null, the default: nowhere */
} starfocus_depth_config;

/** Output planes of a map. They must not overlap the views, the given map, the workspace or each
 *  other. A call writes nothing until it has checked its arguments. */
typedef struct starfocus_disparity_output {
  float* disparity;         /**< aligned for float */
  size_t disparity_stride;  /**< bytes from row to row, >= 4 * width, multiple of 4 */
  uint8_t* confidence;      /**< confidence of each disparity, 0: none; null: not wanted */
  size_t confidence_stride; /**< bytes from row to row, >= width */
  uint8_t* coverage;        /**< starfocus_repair_disparity of one view: coverage of hair, as
                                 starfocus_light_field.coverage; null: not wanted */
  size_t coverage_stride;   /**< bytes from row to row, >= width */
  int32_t has_coverage; /**< output: 1 if coverage was found and belongs to the map; 0: the bytes
                             of `coverage` are unspecified */
} starfocus_disparity_output;

/** As starfocus_config_init_sized. */
STARFOCUS_API void starfocus_depth_config_init_sized(starfocus_depth_config* config, uint32_t size);

static inline void starfocus_depth_config_init(starfocus_depth_config* config) {
  starfocus_depth_config_init_sized(config, (uint32_t)sizeof(starfocus_depth_config));
}

/** Bytes of workspace of starfocus_estimate_disparity into *bytes: 5 for each pixel of the picture,
 * and for each worker up to 1.2 MB for each pixel of the range and about 10, 20 or 45 MB with 5, 9
 * or 17 views. */
STARFOCUS_API starfocus_status
starfocus_estimate_workspace_size(const starfocus_depth_config* config, size_t* bytes);

/** Estimates the disparity of each pixel of the centre view: the one at which all views that see
 *  the pixel agree best, smooth between neighbours. Every value lies in the configured range.
 *  light_field->depth is not read. The
 * views and the workspace must not change during the call. Confidence is the cost of the best
 * disparity that differs by a step or more, minus the cost of the result, in quarters of a gray
 * level, summed over the three colours: 0 if another disparity is as good (a wall of one colour,
 * pixels that hardly any view sees), 255 if none is. */
STARFOCUS_API starfocus_status starfocus_estimate_disparity(
    const starfocus_depth_config* config, const starfocus_light_field* light_field,
    starfocus_disparity_output* map, void* workspace, size_t bytes);

/** Bytes of workspace of starfocus_repair_disparity into *bytes: 12 for each pixel of the picture,
 * and for each worker about as much as starfocus_estimate_workspace_size has. */
STARFOCUS_API starfocus_status starfocus_repair_workspace_size(const starfocus_depth_config* config,
                                                               size_t* bytes);

/** Repairs light_field->depth, a map as of starfocus_depth_float: edges that differ from those of
 * the picture, are blurred or come from a smaller map, noise, and unknown values (NaN, infinite).
 * With side views it works like starfocus_estimate_disparity, with a cost that grows with the
 * distance from the given disparity; with one view it compares colours. Values that the pictures do
 * not contradict keep their bits, unless one view has a noisy map. With one view, outlines become
 * as smooth as those of the picture, and foreground surfaces grow where the picture's edges are
 * soft.
 *
 *  Finite values of the given map must lie in the configured range, which may be wider (else
 *  STARFOCUS_ERROR_DISPARITY); STARFOCUS_ERROR_ALL_INVALID if no value is finite. Confidence is 0
 * also where the pictures contradict a kept value, but too weakly to change it. Where nothing
 * contradicts a value and no edge is near, it is the difference of the centre view from itself one
 * pixel away, in the same unit.
 *
 *  Maps of monocular networks have hair as one closed outline, which no disparities can repair. If
 *  map->coverage is not null and the only view shows such hair, its coverage is found by colour.
 *  There, known disparities keep their bits, and confidence is 255 minus the difference between the
 *  coverage and the 0 or 255 that the map alone would mean. Elsewhere, coverage is that 0 or 255.
 */
STARFOCUS_API starfocus_status starfocus_repair_disparity(const starfocus_depth_config* config,
                                                          const starfocus_light_field* light_field,
                                                          starfocus_disparity_output* map,
                                                          void* workspace, size_t bytes);

#ifdef __cplusplus
}
#endif

#endif /* STARFOCUS_DEPTH_H_ */
