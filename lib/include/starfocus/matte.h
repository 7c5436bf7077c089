/* SPDX-License-Identifier: Apache-2.0 */
/** @file
 * Disparity maps and coverage from mattes. A matte is the alpha of the subject of a photo, as
 * segmentation and matting networks compute it. A photo with a matte and without depth is a light
 * field of two surfaces. Programs without mattes do not need this header. The conventions of
 * starfocus.h apply.
 *
 * @code
 * #include <starfocus/matte.h>
 *
 * // Fills the map and the coverage of a photo of 4000 x 3000 pixels from a matte of 256 x 256
 * // samples. The subject has disparity 30, and the background has disparity 0. Returns a
 * // starfocus_status.
 * int Field(const unsigned char* alpha, float* disparity, unsigned char* coverage) {
 *   const starfocus_matte matte = {alpha, 256, 1, 256, 256};
 *   const starfocus_matte_depth depth = {30, 0, 0, 0};
 *   starfocus_disparity_output out = {0};
 *   out.disparity = disparity;
 *   out.disparity_stride = 4000 * sizeof(float);
 *   out.coverage = coverage;
 *   out.coverage_stride = 4000;
 *   return starfocus_matte_field(&matte, &depth, 4000, 3000, NULL, &out, NULL);
 * }
 * @endcode
 *
 * The functions allocate no memory. The bytes of a region are the same as the bytes of this region
 * in the whole picture.
 */
#ifndef STARFOCUS_MATTE_H_
#define STARFOCUS_MATTE_H_

#include "starfocus/depth.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Alpha of the subject, from 0 (background) to 255 (subject). The matte covers the whole picture
 *  and may be smaller or larger than the picture. */
typedef struct starfocus_matte {
  const uint8_t* data;  /**< First sample. */
  size_t stride;        /**< Bytes from row to row, at least one row. */
  int32_t pixel_stride; /**< Bytes from sample to sample, [1, STARFOCUS_MAX_PIXEL_STRIDE]: 1 for a
                             plane, 4 for the alpha of RGBA. The value 0 selects 1. */
  int32_t width;        /**< Width of the matte in samples, [1, STARFOCUS_MAX_SIZE]. */
  int32_t height;       /**< Height of the matte in samples, [1, STARFOCUS_MAX_SIZE]. */
} starfocus_matte;

/** Place of the subject in a matte. Positions are fractions of the width and the height, from the
 *  left and the top edge. */
typedef struct starfocus_matte_stats {
  double covered; /**< Mean alpha, from 0 (no subject) to 1 (the subject fills the picture). */
  double left;    /**< Left edge of the box around all samples of at least 128; 0 if none exist. */
  double top;     /**< Top edge of the box. */
  double right;   /**< Right edge of the box. */
  double bottom;  /**< Bottom edge of the box. */
  double horizon; /**< Proposed starfocus_matte_depth.horizon: the smaller of 1/2 and the middle
                       between the head of the subject and `ground`. */
  double ground;  /**< Proposed starfocus_matte_depth.ground, where the subject stands: the row
                       below which 1/256 of its samples lie, which may be wrong. The head is the row
                       above which 1/256 of the samples lie. */
} starfocus_matte_stats;

/** Measures a matte.
 *  @param matte matte
 *  @param stats receives the place of the subject
 *  @param problem receives the cause of an error; may be null
 *  @return STARFOCUS_OK, or an error of the arguments */
STARFOCUS_API starfocus_status starfocus_measure_matte(const starfocus_matte* matte,
                                                       starfocus_matte_stats* stats,
                                                       starfocus_problem* problem);

/** Disparities of the subject and of the background. Disparities are rounded half up to 1/64
 *  pixel. */
typedef struct starfocus_matte_depth {
  double subject;    /**< Disparity of the subject, within +-STARFOCUS_MAX_DISPARITY. */
  double background; /**< Disparity of the background, -STARFOCUS_MAX_DISPARITY to `subject`. */
  /** With a floor, row at which the floor begins, as a fraction of the height, [0, ground). Above
   *  this row, the background has the disparity `background`. Below, the disparity grows linearly
   *  from row to row. If `horizon` and `ground` are 0, the background has no floor. */
  double horizon;
  /** With a floor, row on which the subject stands, as a fraction of the height, (horizon, 1]. At
   *  this row and below, the background has the disparity `subject`. */
  double ground;
} starfocus_matte_depth;

/** Computes the disparity map and the coverage of a photo from a matte. The coverage is the matte
 *  at the size of the picture. The map contains the disparity of the subject where the coverage is
 *  at least 128, and the disparity of the background elsewhere.
 *
 *  A matte that is smaller than the picture is interpolated by cubic splines: Catmull-Rom splines
 *  up to twice the size of the matte, B-splines from 8 times the size, and a mixture between these
 *  sizes. B-splines raise the contrast around 1/2 by 30 %, because small mattes show sharp outlines
 *  as wide ones. A matte that is larger than the picture is averaged over the area of each pixel. A
 *  matte of the picture's size is not changed. Along each axis, the rule depends on the sizes along
 *  this axis.
 *  @param matte matte
 *  @param depth disparities of both surfaces
 *  @param width,height size of the picture in pixels, [1, STARFOCUS_MAX_SIZE]
 *  @param region part of the picture to fill; null: the whole picture
 *  @param out receives the region: `disparity`, and `coverage` unless it is null. The pointers
 *         point to the first pixel of the region, not of the picture. The function does not read or
 *         write `confidence`. The planes must not overlap the matte or each other
 *  @param problem receives the cause of an error; may be null
 *  @return STARFOCUS_OK, or an error of the arguments */
STARFOCUS_API starfocus_status starfocus_matte_field(
    const starfocus_matte* matte, const starfocus_matte_depth* depth, int32_t width, int32_t height,
    const starfocus_region* region, starfocus_disparity_output* out, starfocus_problem* problem);

/** Computes the coverage of a photo that has a matte and a depth map. At the outlines of the
 *  subject, the coverage is the matte. At other edges of the map, the coverage is the coverage that
 *  the map implies: 255 on the nearer surface, and 0 on the farther surface. Where the matte and
 *  the map contradict each other, the map decides.
 *
 *  For each pixel within 32 pixels of an edge of more than 5 pixels, the function compares alpha at
 *  33 places up to 26 pixels away. Let N be the highest tenth of alpha on the nearer surface. Let
 *  F be the lower quartile on the farther surface. The edge is an outline of the subject if N - F
 *  is 128 or more. The coverage is then 255 (alpha - F) / (N - F), limited to 0 to 255, so that
 *  haze beside the subject does not count. If N - F is 64 or less, the map decides. In between, the
 *  function mixes both. Farther from edges, the coverage is 255.
 *  @param matte matte
 *  @param depth map of any format without unknown values, at most as wide and as high as the
 *         picture, and disparities within +-STARFOCUS_MAX_DISPARITY
 *  @param width,height size of the picture in pixels, [1, STARFOCUS_MAX_SIZE]
 *  @param region part of the picture to fill; null: the whole picture
 *  @param out receives the region in `coverage`, which points to the first pixel of the region and
 *         must not overlap the matte or the map. The function does not read or write the other
 *         planes
 *  @param problem receives the cause of an error; may be null
 *  @return STARFOCUS_OK, an error of the arguments, STARFOCUS_ERROR_DISPARITY or
 *          STARFOCUS_ERROR_NOT_FINITE */
STARFOCUS_API starfocus_status starfocus_matte_coverage(
    const starfocus_matte* matte, const starfocus_depth_map* depth, int32_t width, int32_t height,
    const starfocus_region* region, starfocus_disparity_output* out, starfocus_problem* problem);

#ifdef __cplusplus
}
#endif

#endif /* STARFOCUS_MATTE_H_ */
