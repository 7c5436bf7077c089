/* SPDX-License-Identifier: Apache-2.0 */
/** @file
 * The lens of a refocusing. Part of starfocus.h. */
#ifndef STARFOCUS_LENS_H_
#define STARFOCUS_LENS_H_

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Smallest starfocus_lens.theta, 0.05 pi. */
#define STARFOCUS_MIN_THETA 0.15707963267948966
/** Largest starfocus_lens.theta, 0.45 pi. */
#define STARFOCUS_MAX_THETA 1.413716694115407
/** Largest absolute starfocus_lens.focus. */
#define STARFOCUS_MAX_FOCUS 1.0e6
/** Smallest starfocus_lens.blades. */
#define STARFOCUS_MIN_BLADES 3
/** Largest starfocus_lens.blades. */
#define STARFOCUS_MAX_BLADES 12
/** Largest starfocus_lens.ring_inner. */
#define STARFOCUS_MAX_RING_INNER 0.9

/** Shape of the aperture within the disc of its radius. */
typedef enum starfocus_shape {
  STARFOCUS_SHAPE_FALL_OFF = 0, /**< The paper's disc (3), which is darker towards its rim. */
  STARFOCUS_SHAPE_DISC = 1,     /**< A disc of constant brightness. */
  STARFOCUS_SHAPE_POLYGON = 2,  /**< A polygon with corners on the rim of the disc, like a diaphragm
                                   with blades. Requires STARFOCUS_FEATURE_SHAPES. */
  STARFOCUS_SHAPE_RING = 3      /**< A disc with a hole, like the opening of a mirror lens. */
} starfocus_shape;

/** A lens, which may differ from call to call. The first call after a change of shape, blades,
 *  theta, rotation, curvature or ring_inner computes tables for the new aperture. Every call checks
 *  all fields, including the fields that the shape does not use. */
typedef struct starfocus_lens {
  double focus; /**< Disparity in focus (d_t), |focus| <= STARFOCUS_MAX_FOCUS; default 0. */
  /** Extent of the range in focus on the near side of `focus`. Disparities from focus to focus +
   *  focus_nearer are sharp. The blur of larger disparities grows with their distance from focus +
   *  focus_nearer. Range [0, STARFOCUS_MAX_FOCUS - focus]; default 0. */
  double focus_nearer;
  /** Extent of the range in focus on the far side of `focus`. Disparities from focus -
   *  focus_farther to focus are sharp. Range [0, STARFOCUS_MAX_FOCUS + focus]; default 0. */
  double focus_farther;
  double aperture; /**< Radius of the aperture (u_t), [0, 1]; at 0 the result is the centre view,
                      byte for byte; default 1. */
  int32_t shape; /**< starfocus_shape; default STARFOCUS_SHAPE_FALL_OFF. Polygons and cat's eyes are
                    slower, because their blur is not gathered (starfocus_tuning.gather). */
  int32_t blades; /**< Polygon: number of corners, [STARFOCUS_MIN_BLADES, STARFOCUS_MAX_BLADES];
                       default 5. */
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
} starfocus_lens;

#ifdef __cplusplus
}
#endif

#endif /* STARFOCUS_LENS_H_ */
