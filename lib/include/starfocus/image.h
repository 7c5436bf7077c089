/* SPDX-License-Identifier: Apache-2.0 */
/* starfocus: the formats of pictures and depth maps. Part of starfocus.h.
 *
 * Rows are converted as they are read and written; nothing is copied whole. The result has the
 * bytes of converting everything to R, G, B and float disparities first, by the formulas below,
 * refocusing, and converting the result. Samples have 8 bits.
 *
 * An engine reads and writes STARFOCUS_FORMAT_RGB without gaps between pixels, and maps of floats
 * as starfocus_depth_float describes them. All else needs STARFOCUS_FEATURE_IMAGES.
 */
#ifndef STARFOCUS_IMAGE_H_
#define STARFOCUS_IMAGE_H_

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Largest pixel_stride of R, G, B. */
#define STARFOCUS_MAX_PIXEL_STRIDE 256

/** Where the bytes of a picture lie; those of R, G, B by their order in memory, those of luma Y and
 *  chroma U (Cb), V (Cr) by the names of libyuv. Chroma has half the width and height of the
 *  picture, rounded up: a sample belongs to 2 x 2 pixels, at the right and bottom edges of odd
 *  sizes to those that there are. */
typedef enum starfocus_format {
  STARFOCUS_FORMAT_RGB = 0,  /**< planes[0]: R, G, B */
  STARFOCUS_FORMAT_BGR = 1,  /**< planes[0]: B, G, R */
  STARFOCUS_FORMAT_RGBX = 2, /**< planes[0]: R, G, B and a byte that is carried through: alpha */
  STARFOCUS_FORMAT_BGRX = 3, /**< planes[0]: B, G, R and a byte that is carried through: alpha */
  STARFOCUS_FORMAT_NV12 = 4, /**< planes[0]: Y; planes[1]: U, V */
  STARFOCUS_FORMAT_NV21 = 5, /**< planes[0]: Y; planes[1]: V, U */
  STARFOCUS_FORMAT_I420 = 6, /**< planes[0]: Y; planes[1]: U; planes[2]: V */
  STARFOCUS_FORMAT_YUV_420_888 = 7 /**< as I420, chroma samples 1 or 2 bytes apart (pixel_stride):
                                 what Android's cameras give */
} starfocus_format;

/** How luma and chroma are made of R, G, B. With Kr, Kb = 0.299, 0.114 or 0.2126, 0.0722 and
 *  Kg = 1 - Kr - Kb, Y' = Kr R + Kg G + Kb B, U' = (B - Y') / (2 - 2 Kb), V' = (R - Y') /
 *  (2 - 2 Kr). */
typedef enum starfocus_matrix {
  STARFOCUS_MATRIX_BT601 =
      0, /**< ITU-R BT.601: libyuv's I420 (limited range) and J420 (full range) */
  STARFOCUS_MATRIX_BT709 =
      1 /**< ITU-R BT.709: libyuv's H420 (limited range) and F420 (full range) */
} starfocus_matrix;

/** Which codes Y', U' and V' have. */
typedef enum starfocus_range {
  STARFOCUS_RANGE_LIMITED = 0, /**< Y = 16 + Y' 219 / 255; U, V = 128 + U', V' 224 / 255 */
  STARFOCUS_RANGE_FULL = 1 /**< Y = Y'; U, V = 128 + U', V': what JPEG and Android's cameras have */
} starfocus_range;

/** A picture that is read or written. Calls do not write the pictures that they read; of an output
 *  they write the bytes of its pixels alone. With all other fields 0 it is STARFOCUS_FORMAT_RGB.
 *
 *  Conversion is in integers, the same on every machine. P(a, c) is (a c + 2^14) >> 15 (arithmetic
 *  shifts round down) and [x] is x rounded to the nearest integer, halves away from 0.
 *  To R, G, B: of limited range y0 = 16, p = 255 / 219, q = 255 / 224, else y0 = 0, p = q = 1; with
 *  the chroma sample that the pixel belongs to,
 *    L = P(128 (Y - y0), [2^14 p]), u = 256 (U - 128), v = 256 (V - 128),
 *    R = (L + P(v, [2^13 q (2 - 2 Kr)]) + 32) >> 6,
 *    G = (L + P(u, [-2^13 q (2 - 2 Kb) Kb / Kg]) + P(v, [-2^13 q (2 - 2 Kr) Kr / Kg]) + 32) >> 6,
 *    B = (L + P(u, [2^13 q (2 - 2 Kb)]) + 32) >> 6, each clamped to [0, 255].
 *  From R, G, B: with w = 2^15 / p, h = 2^15 / q / 2,
 *    Y = y0 + ((P(128 R, w_r) + P(128 G, w_g) + P(128 B, w_b) + 64) >> 7), w_r = [w Kr],
 *    w_b = [w Kb], w_g = [w] - w_r - w_b; and of the sums R, G, B of 2 x 2 pixels, of which odd
 *    sizes repeat the last column or row,
 *    U = 128 + ((P(32 R, u_r) + P(32 G, u_g) + P(32 B, u_b) + 64) >> 7), clamped to [0, 255],
 *    u_b = [h], u_r = [-h Kr / (1 - Kb)], u_g = -u_r - u_b; V likewise with v_r = [h],
 *    v_b = [-h Kb / (1 - Kr)], v_g = -v_r - v_b. */
typedef struct starfocus_image {
  int32_t format;       /**< starfocus_format */
  int32_t matrix;       /**< starfocus_matrix; ignored for R, G, B */
  int32_t range;        /**< starfocus_range; ignored for R, G, B */
  int32_t pixel_stride; /**< bytes from pixel to pixel of R, G, B: at least 3, or 4 with alpha, at
                             most STARFOCUS_MAX_PIXEL_STRIDE; or from sample to sample of chroma: 1
                           or 2 of YUV_420_888, else what the format says. 0: the least that the
                             format allows */
  void* planes[3];      /**< first bytes; planes that the format lacks are ignored */
  size_t strides[3];    /**< bytes from row to row of each, as long as a row at least */
} starfocus_image;

/** Type of the values of a depth map. */
typedef enum starfocus_depth_type {
  STARFOCUS_DEPTH_FLOAT = 0, /**< 32-bit IEEE float */
  STARFOCUS_DEPTH_U16 = 1,   /**< 16-bit unsigned integer */
  STARFOCUS_DEPTH_U8 = 2,    /**< 8-bit unsigned integer */
  STARFOCUS_DEPTH_HALF = 3   /**< 16-bit IEEE float */
} starfocus_depth_type;

/** What a value z of a depth map means. */
typedef enum starfocus_depth_meaning {
  STARFOCUS_DEPTH_LINEAR = 0, /**< disparity = scale * z + offset */
  STARFOCUS_DEPTH_RECIPROCAL =
      1 /**< disparity = scale / z + offset: z is a distance. With rectified views
      whose outermost ones lie B from the centre, and the focal length f in
      pixels, scale = f * B in the unit of z, and offset = 0 */
} starfocus_depth_meaning;

/** A map of the centre view's depth, as large as the picture or smaller in width, height or both.
 *
 *  Disparities are computed in single precision, each operation rounded, must lie in the configured
 *  range (else STARFOCUS_ERROR_DISPARITY), and are rounded to D = floor(64 disparity + 1/2). Those
 * that are not finite, and those of invalid values, are unknown: see
 * STARFOCUS_FEATURE_FILL_UNKNOWN, without which they are STARFOCUS_ERROR_NOT_FINITE; rows of the
 * picture are filled, not of the map.
 *
 *  A smaller map is interpolated between its values along surfaces and never across their edges.
 *  Of a picture W pixels wide and a map w wide, column x of the picture lies at
 *  p = floor(128 (2x + 1) w / W) - 128 of the map in 256ths, limited to [0, 256 (w - 1)]; rows
 *  likewise. First between the rows, then between the columns, the value at a share s (256ths) of
 *  the way from D0 to D1 is D0 + ((s (D1 - D0) + 128) >> 8) where |D1 - D0| <= 96 (a pixel and a
 *  half), and else that of the nearer one: D0 for s < 128, otherwise D1. Unknown is far from all.
 */
typedef struct starfocus_depth_map {
  const void* data; /**< first value, aligned for its type */
  size_t stride;    /**< bytes from row to row, as long as a row at least, multiple of the type */
  int32_t width;    /**< in [1, width of the picture] */
  int32_t height;   /**< in [1, height of the picture] */
  int32_t type;     /**< starfocus_depth_type */
  int32_t meaning;  /**< starfocus_depth_meaning */
  double scale;   /**< finite, not 0: 1 for disparities; this, `offset` and `invalid` are rounded to
                     float */
  double offset;  /**< finite */
  double invalid; /**< compared with z */
  int32_t has_invalid; /**< 1: `invalid` stands for an unknown depth; 0: no value does */
} starfocus_depth_map;

/** Returns an image of R, G, B whose first row is at `data`, `stride` bytes from row to row. Views
 *  are only read. */
static inline starfocus_image starfocus_image_rgb(const void* data, size_t stride) {
  starfocus_image image = {STARFOCUS_FORMAT_RGB, 0, 0, 0, {NULL, NULL, NULL}, {0, 0, 0}};
  image.planes[0] = (void*)(uintptr_t)data; /* without a warning that const is cast away */
  image.strides[0] = stride;
  return image;
}

/** Returns a map of width x height float disparities, `stride` bytes from row to row. */
static inline starfocus_depth_map starfocus_depth_float(const float* data, size_t stride,
                                                        int32_t width, int32_t height) {
  starfocus_depth_map map = {NULL, 0, 0, 0, STARFOCUS_DEPTH_FLOAT, STARFOCUS_DEPTH_LINEAR,
                             1,    0, 0, 0};
  map.data = data;
  map.stride = stride;
  map.width = width;
  map.height = height;
  return map;
}

#ifdef __cplusplus
}
#endif

#endif /* STARFOCUS_IMAGE_H_ */
