/* SPDX-License-Identifier: Apache-2.0 */
/* starfocus: the lens of a refocusing. Part of starfocus.h. */
#ifndef STARFOCUS_LENS_H_
#define STARFOCUS_LENS_H_

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define STARFOCUS_MIN_THETA 0.15707963267948966 /**< 0.05 pi */
#define STARFOCUS_MAX_THETA 1.413716694115407   /**< 0.45 pi */
#define STARFOCUS_MAX_FOCUS 1.0e6
#define STARFOCUS_MIN_BLADES 3
#define STARFOCUS_MAX_BLADES 12
#define STARFOCUS_MAX_RING_INNER 0.9

/** What the opening of the lens looks like, in the disc of radius u_t. */
typedef enum starfocus_shape {
  STARFOCUS_SHAPE_FALL_OFF = 0, /**< the paper's (3): the disc, darker towards its rim by theta */
  STARFOCUS_SHAPE_DISC = 1,     /**< the disc, as bright everywhere */
  STARFOCUS_SHAPE_POLYGON = 2,  /**< of `blades` blades, `rotation` and `curvature`; its corners lie
                            on the disc's rim. Needs STARFOCUS_FEATURE_SHAPES */
  STARFOCUS_SHAPE_RING = 3      /**< the disc less one of radius `ring_inner`: a mirror lens */
} starfocus_shape;

/** The lens of a refocusing. It may differ from call to call; the engine makes its tables again for
 *  the first call after any of shape, blades, theta, rotation, curvature and ring_inner changed.
 *  All fields are checked, also those that other shapes have. */
typedef struct starfocus_lens {
  double focus;    /**< disparity d_t in focus, finite, |d_t| <= STARFOCUS_MAX_FOCUS; default 0 */
  double aperture; /**< radius u_t, [0, 1]; 0: the centre view to the byte; default 1 */
  int32_t shape;   /**< starfocus_shape; default STARFOCUS_SHAPE_FALL_OFF. theta belongs to that
                      alone, the fields   below to the others. With a polygon and with cats_eye
                      nothing   is gathered */
  int32_t blades;  /**< of a polygon, [STARFOCUS_MIN_BLADES, STARFOCUS_MAX_BLADES]; default 5 */
  double theta;    /**< fall-off of the aperture (3) in radians, [STARFOCUS_MIN_THETA,
                      STARFOCUS_MAX_THETA];    default 0.26 pi */
  double rotation; /**< of a polygon in degrees, [-360, 360]; 0, the default: a corner at the top of
                     the lens, (0, -1); more turns it clockwise, to the right */
  double curvature;  /**< of a polygon's edges, the disc's radius over theirs, [0, 1]; default 0:
                       straight; 1: the disc */
  double ring_inner; /**< of a ring: radius of its hole over u_t, [0, STARFOCUS_MAX_RING_INNER];
                       default 0.5 */
  double cats_eye; /**< how far a second rim, as wide as the disc, lies beside the lens in radii, as
                     it is seen from the picture's corners, [0, 1]; less towards the middle: light
                     passes both. Pictures do not get darker by it, STARFOCUS_MODE_BLUR does without
                     it. Above 0 it needs STARFOCUS_FEATURE_SHAPES; default 0: there is none */
} starfocus_lens;

#ifdef __cplusplus
}
#endif

#endif /* STARFOCUS_LENS_H_ */
