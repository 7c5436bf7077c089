/* SPDX-License-Identifier: Apache-2.0 */
/* starfocus: disparity maps from captured views. C ABI; conventions as in starfocus.h, of which a
 * program that makes no maps needs nothing of this.
 *
 * Use: sf_depth_config_init, fill the fields in, sf_estimate_size, allocate that many bytes aligned
 * to SF_ALIGNMENT, sf_estimate_disparity. The bytes of a map depend on the configuration and the
 * pictures alone, and not on workers, runner or SIMD target.
 */
#ifndef STARFOCUS_DEPTH_H_
#define STARFOCUS_DEPTH_H_

#include "starfocus/starfocus.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What a map is made from. Call sf_depth_config_init first. */
typedef struct sf_depth_config {
  uint32_t version;     /**< SF_ABI_VERSION, set by sf_depth_config_init */
  int32_t width;        /**< pixels, [1, SF_MAX_SIZE] */
  int32_t height;       /**< pixels, [1, SF_MAX_SIZE] */
  int32_t views;        /**< captured views: 5, 9 or 17 (see sf_view_position), 1 as well of a
                             repair; default 5 */
  float disparity_min;  /**< disparities are looked for from here */
  float disparity_max;  /**< to here, both within +-SF_MAX_DISPARITY; in steps of half a pixel, of
                             a pixel or more, 128 at most, if the range is wider than 64; between
                             two steps what fits best is found */
  int32_t max_workers;  /**< workers the runner may use, [1, SF_MAX_WORKERS]; default 1 */
  sf_progress progress; /**< of the rows of the map, by all that they take; null, the default:
                           nobody is asked. As in sf_params, but asked between tiles of the picture
                           alone, which take longer; after SF_ERROR_CANCELLED the outputs and the
                             workspace are unspecified */
  void* progress_data;  /**< passed to progress */
  uint32_t reserved[8]; /**< zero */
} sf_depth_config;

/** Where a map goes. Nothing may overlap the views, the given map, the workspace or each other;
 *  nothing is written before the arguments have been checked. */
typedef struct sf_map {
  float* disparity;         /**< aligned for float */
  size_t disparity_stride;  /**< bytes from row to row, >= 4 * width, multiple of 4 */
  uint8_t* confidence;      /**< how sure each pixel is, 0: not at all; null: nobody asks */
  size_t confidence_stride; /**< bytes from row to row, >= width */
  uint8_t* coverage;        /**< of a repair of one view, as sf_light_field.coverage; null: nobody
                                 asks */
  size_t coverage_stride;   /**< bytes from row to row, >= width */
  int32_t has_coverage;     /**< written: 1 if coverage was found and goes with the map, else 0, and
                                 what `coverage` points to is unspecified */
} sf_map;

SF_API void sf_depth_config_init(sf_depth_config* config);

/** Bytes of workspace of sf_estimate_disparity into *bytes: 5 for each pixel of the picture, and
 * for each worker up to 1.2 MB for each pixel of the range and about 10, 20 or 45 MB with 5, 9 or
 * 17 views. */
SF_API sf_status sf_estimate_size(const sf_depth_config* config, size_t* bytes);

/** Estimates the disparity of each pixel of the centre view from all views: what makes them agree,
 *  occlusions left out of account, and neighbours go on smoothly. Every value lies in the
 *  configured range. light_field's disparity is not read; the views and the workspace must stay as
 *  they are during the call. map->confidence tells how much worse than the disparity chosen any
 *  other one is that differs by a step or more, in quarters of a gray level of all three colours
 *  together; 0 means that another one is as good (a wall of one colour, or what hardly any view
 *  sees), 255 that there is none. runner as in sf_refocus. */
SF_API sf_status sf_estimate_disparity(const sf_depth_config* config,
                                       const sf_light_field* light_field, sf_map* map,
                                       void* workspace, size_t bytes, sf_runner runner,
                                       void* runner_data);

/** Bytes of workspace of sf_repair_disparity into *bytes: 12 for each pixel of the picture, and for
 *  each worker about as much as sf_estimate_size has. */
SF_API sf_status sf_repair_size(const sf_depth_config* config, size_t* bytes);

/** Repairs light_field's disparity map, whose edges lie beside those of the picture, are blurred or
 *  of a smaller map, or which is noisy: as sf_estimate_disparity, but a disparity is the less
 *  likely, the further away the given map has it. Pixels that the views do not gainsay keep their
 *  value to the bit (with one view, that colours do not gainsay, unless the map is noisy; there
 *  outlines become as smooth as those of the picture, and wider where these are soft); NaN and
 *  infinite values are unknown, and get one. Every finite value of the given map lies in the
 *  configured range (else SF_ERROR_DISPARITY), which may be wider; SF_ERROR_ALL_INVALID when none
 *  is finite. Confidence is 0 also where the views contradict the value that was kept, but too
 *  weakly; where nothing contradicts it, and no step of the map is near, it tells how much the
 *  centre view differs a pixel away, in the same unit.
 *
 *  A map of one view may have hair as a closed outline. No disparities repair that: if
 * map->coverage is asked for, its coverage is found by colour (map->has_coverage), every known
 * disparity stays, and confidence tells how well map and coverage agree. */
SF_API sf_status sf_repair_disparity(const sf_depth_config* config,
                                     const sf_light_field* light_field, sf_map* map,
                                     void* workspace, size_t bytes, sf_runner runner,
                                     void* runner_data);

#ifdef __cplusplus
}
#endif

#endif /* STARFOCUS_DEPTH_H_ */
