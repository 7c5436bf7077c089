/* SPDX-License-Identifier: Apache-2.0 */
/** @file
 * Formats of pictures and depth maps. Part of starfocus.h.
 *
 * Every engine reads and writes packed STARFOCUS_FORMAT_RGB, and reads float disparities as
 * starfocus_depth_float describes them. All other formats require STARFOCUS_FEATURE_IMAGES or, from
 * STARFOCUS_FORMAT_RGB16 on, STARFOCUS_FEATURE_DEEP, which includes the former.
 *
 * The engine converts each row when the row is read or written, and never copies a whole picture.
 * The output bytes are the same as after three separate steps: convert all inputs to packed RGB and
 * float disparities by the formulas below, refocus, and convert the result. Engines with
 * STARFOCUS_FEATURE_DEEP convert all inputs to light: codes of 8 bits count as 257 times as large
 * codes of 16 bits, which starfocus_config.transfer converts. Negative half floats and NaN count as
 * 0, and light beyond 64 times white is limited. Integers have straight alpha, and half floats are
 * premultiplied. In formats of 8 bits, the fourth sample of these engines' outputs is the refocused
 * alpha, and smooth colours between two codes are dithered.
 */
#ifndef STARFOCUS_IMAGE_H_
#define STARFOCUS_IMAGE_H_

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Largest value of starfocus_image.pixel_stride for RGB formats. */
#define STARFOCUS_MAX_PIXEL_STRIDE 256

/** Layout of a picture. Samples have 8 bits unless stated otherwise. RGB formats are named by the
 * order of bytes in memory, YUV formats as in libyuv. Chroma planes have half the width and height
 * of the picture, rounded up. A chroma sample belongs to 2 x 2 pixels, or to fewer pixels at the
 * right and bottom edges of pictures of odd size. */
typedef enum starfocus_format {
  STARFOCUS_FORMAT_RGB = 0,  /**< planes[0]: R, G, B. */
  STARFOCUS_FORMAT_BGR = 1,  /**< planes[0]: B, G, R. */
  STARFOCUS_FORMAT_RGBX = 2, /**< planes[0]: R, G, B, alpha; alpha is copied to the output. */
  STARFOCUS_FORMAT_BGRX = 3, /**< planes[0]: B, G, R, alpha; alpha is copied to the output. */
  STARFOCUS_FORMAT_NV12 = 4, /**< planes[0]: Y; planes[1]: U, V. */
  STARFOCUS_FORMAT_NV21 = 5, /**< planes[0]: Y; planes[1]: V, U. */
  STARFOCUS_FORMAT_I420 = 6, /**< planes[0]: Y; planes[1]: U; planes[2]: V. */
  STARFOCUS_FORMAT_YUV_420_888 = 7, /**< As I420, with chroma samples 1 or 2 bytes apart
                                         (pixel_stride), as Android's cameras store them. */
  /* The following formats require STARFOCUS_FEATURE_DEEP. Their samples are 16-bit words in the
   * byte order of the machine. */
  STARFOCUS_FORMAT_RGB16 = 8,      /**< planes[0]: R, G, B, codes from 0 to 65535. */
  STARFOCUS_FORMAT_RGBA16 = 9,     /**< As RGB16, with alpha, which is refocused. */
  STARFOCUS_FORMAT_RGB_HALF = 10,  /**< planes[0]: R, G, B, half floats of linear light; white is
                                        1. */
  STARFOCUS_FORMAT_RGBA_HALF = 11, /**< As RGB_HALF, premultiplied with alpha, which is
                                        refocused. */
  STARFOCUS_FORMAT_P010 = 12,      /**< As NV12, with 10 bits in the upper bits of each word. */
  STARFOCUS_FORMAT_P210 = 13       /**< As P010, with as many rows of chroma as of luma. */
} starfocus_format;

/** Matrix of YUV formats. With Kr, Kb = 0.299, 0.114 (BT.601) or 0.2126, 0.0722 (BT.709), and
 *  Kg = 1 - Kr - Kb: Y' = Kr R + Kg G + Kb B, U' = (B - Y') / (2 - 2 Kb),
 *  V' = (R - Y') / (2 - 2 Kr). */
typedef enum starfocus_matrix {
  STARFOCUS_MATRIX_BT601 = 0, /**< ITU-R BT.601; libyuv's I420 (limited range) and J420 (full). */
  STARFOCUS_MATRIX_BT709 = 1  /**< ITU-R BT.709; libyuv's H420 (limited range) and F420 (full). */
} starfocus_matrix;

/** Range of the codes of YUV formats. */
typedef enum starfocus_range {
  STARFOCUS_RANGE_LIMITED = 0, /**< Y = 16 + 219 / 255 Y'; U, V = 128 + 224 / 255 U', V'. */
  STARFOCUS_RANGE_FULL = 1 /**< Y = Y'; U, V = 128 + U', V', as in JPEG and Android's cameras. */
} starfocus_range;

/** A picture. API calls never write to the pictures of a light field, and write only the pixels of
 *  an output picture. A structure of zeros with planes[0] and strides[0] describes packed RGB.
 *
 *  Conversion between RGB and YUV uses integers and gives the same result on every machine. Let
 *  P(a, c) = (a c + 2^14) >> 15, where >> rounds down, and let [x] be x rounded to the nearest
 *  integer, with halves rounded away from 0. For limited range, y0 = 16, p = 255 / 219,
 *  q = 255 / 224; for full range, y0 = 0, p = q = 1.
 *
 *  To RGB, with the chroma sample of the pixel:
 *    L = P(128 (Y - y0), [2^14 p]), u = 256 (U - 128), v = 256 (V - 128),
 *    R = (L + P(v, [2^13 q (2 - 2 Kr)]) + 32) >> 6,
 *    G = (L + P(u, [-2^13 q (2 - 2 Kb) Kb / Kg]) + P(v, [-2^13 q (2 - 2 Kr) Kr / Kg]) + 32) >> 6,
 *    B = (L + P(u, [2^13 q (2 - 2 Kb)]) + 32) >> 6, each clamped to [0, 255].
 *
 *  From RGB, with w = 2^15 / p and h = 2^15 / (2 q):
 *    Y = y0 + ((P(128 R, w_r) + P(128 G, w_g) + P(128 B, w_b) + 64) >> 7), w_r = [w Kr],
 *    w_b = [w Kb], w_g = [w] - w_r - w_b. With the sums R, G, B of 2 x 2 pixels, where odd sizes
 *    repeat the last column or row,
 *    U = 128 + ((P(32 R, u_r) + P(32 G, u_g) + P(32 B, u_b) + 64) >> 7), clamped to [0, 255],
 *    u_b = [h], u_r = [-h Kr / (1 - Kb)], u_g = -u_r - u_b. V likewise with v_r = [h],
 *    v_b = [-h Kb / (1 - Kr)], v_g = -v_r - v_b. */
typedef struct starfocus_image {
  int32_t format; /**< starfocus_format. */
  int32_t matrix; /**< starfocus_matrix; ignored for RGB formats. */
  int32_t range;  /**< starfocus_range; ignored for RGB formats. */
  /** Bytes from pixel to pixel of an RGB format: at least 3, or 4 with alpha, and at most
   *  STARFOCUS_MAX_PIXEL_STRIDE. For YUV_420_888, bytes from chroma sample to chroma sample, 1 or
   *  2. The value 0 selects the smallest value that the format allows. YUV formats other than
   *  YUV_420_888 accept only 0 and their smallest value: 1 for I420, 2 for NV12 and NV21. */
  int32_t pixel_stride;
  void*
      planes[3]; /**< First byte of each plane; planes that the format does not use are ignored. */
  size_t strides[3]; /**< Bytes from row to row of each plane, at least one row. */
} starfocus_image;

/** Type of the values of a depth map. */
typedef enum starfocus_depth_type {
  STARFOCUS_DEPTH_FLOAT = 0, /**< 32-bit IEEE float. */
  STARFOCUS_DEPTH_U16 = 1,   /**< 16-bit unsigned integer. */
  STARFOCUS_DEPTH_U8 = 2,    /**< 8-bit unsigned integer. */
  STARFOCUS_DEPTH_HALF = 3,  /**< 16-bit IEEE float. */
  /** 16-bit unsigned integer in Android's format DEPTH16. The value z is the distance in
   * millimetres in the lower 13 bits; 0 is unknown. The confidence in the upper 3 bits is ignored.
   * Use this type with STARFOCUS_DEPTH_RECIPROCAL. */
  STARFOCUS_DEPTH_DEPTH16 = 4
} starfocus_depth_type;

/** Conversion of a value z of a depth map to a disparity. */
typedef enum starfocus_depth_meaning {
  STARFOCUS_DEPTH_LINEAR = 0, /**< disparity = scale * z + offset */
  /** disparity = scale / z + offset, for distances z. For rectified views, a distance B between the
   *  centre view and the outermost views, and a focal length of f pixels, scale = f B in the unit
   *  of z. */
  STARFOCUS_DEPTH_RECIPROCAL = 1
} starfocus_depth_meaning;

/** Depth map of the centre view, as large as the picture or smaller in width, height or both.
 *
 *  Disparities are computed in single precision and rounded half up to 1/64 pixel. Disparities must
 *  lie in the configured range; otherwise the call returns STARFOCUS_ERROR_DISPARITY. An infinite
 *  distance is known in float and half maps: its disparity is `offset`. Disparities that are not
 *  finite, and disparities of the invalid value, are unknown: see starfocus_unknown. Unknown values
 *  are filled along rows of the picture, not along rows of the map.
 *
 *  The engine interpolates a smaller map within surfaces, but not across depth edges. For a picture
 *  W pixels wide and a map w values wide, column x of the picture lies at
 *  p = floor(128 (2x + 1) w / W) - 128 of the map, in 1/256 and limited to [0, 256 (w - 1)]. For
 *  rows, the formula applies with y and heights in place of x and widths. Values are interpolated
 *  between two rows first, then between two columns. At a distance of s / 256 from D0 to D1, in
 *  1/64 pixel, the result is D0 + ((s (D1 - D0) + 128) >> 8) if |D1 - D0| <= 96 (1.5 pixels). For
 *  larger differences, the result is D0 for s < 128 and D1 for s >= 128. An unknown value is never
 *  interpolated. */
typedef struct starfocus_depth_map {
  const void* data; /**< First value, aligned to its type. */
  size_t stride;    /**< Bytes from row to row, at least one row, a multiple of the type's size. */
  int32_t width;    /**< [1, width of the picture]. */
  int32_t height;   /**< [1, height of the picture]. */
  int32_t type;     /**< starfocus_depth_type. */
  int32_t meaning;  /**< starfocus_depth_meaning. */
  double scale;     /**< Finite and not 0; rounded to float; 1 for disparities. */
  double offset;    /**< Finite; rounded to float. */
  double invalid;   /**< Value z of unknown depth, rounded to float; used if has_invalid is 1. */
  int32_t has_invalid; /**< 1: values equal to `invalid` are unknown; 0: `invalid` is ignored. */
} starfocus_depth_map;

/** Describes a packed RGB picture.
 *  @param data first row; calls write to the picture only if the picture is an output
 *  @param stride bytes from row to row
 *  @return the picture */
static inline starfocus_image starfocus_image_rgb(const void* data, size_t stride) {
  starfocus_image image = {STARFOCUS_FORMAT_RGB, 0, 0, 0, {NULL, NULL, NULL}, {0, 0, 0}};
  image.planes[0] = (void*)(uintptr_t)data; /* casts const away without a warning */
  image.strides[0] = stride;
  return image;
}

/** Describes a map of float disparities.
 *  @param data first row
 *  @param stride bytes from row to row
 *  @param width,height size of the map in pixels
 *  @return the map */
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
