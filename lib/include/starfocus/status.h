/* SPDX-License-Identifier: Apache-2.0 */
/* starfocus: what every call answers with, and what marks its functions. Part of starfocus.h. */
#ifndef STARFOCUS_STATUS_H_
#define STARFOCUS_STATUS_H_

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define SF_API __attribute__((visibility("default")))
#else
#define SF_API
#endif

typedef enum sf_status {
  SF_OK = 0,
  SF_ERROR_NULL = 1,     /**< a pointer that must be given is null */
  SF_ERROR_VERSION = 2,  /**< structure not initialised by its init function */
  SF_ERROR_RESERVED = 3, /**< a reserved field, or an unknown bit of features, is not zero */
  SF_ERROR_SIZE = 4,     /**< width or height outside [1, SF_MAX_SIZE] */
  SF_ERROR_VIEWS = 5,    /**< number of views is not 1, 5, 9 or 17, or with positions not 1 to 17 */
  SF_ERROR_DISPARITY_RANGE = 6, /**< configured disparity range not finite, reversed or too large */
  SF_ERROR_MAX_BLUR = 7,        /**< max_blur outside (0, SF_MAX_BLUR] */
  SF_ERROR_BLOCK = 8,           /**< largest_block is not 0, 32, 64, 128 or 256 */
  SF_ERROR_WORKERS = 9,         /**< max_workers outside [1, SF_MAX_WORKERS] */
  SF_ERROR_THETA = 10,          /**< theta outside [SF_MIN_THETA, SF_MAX_THETA] */
  SF_ERROR_WORKSPACE_SMALL = 11,     /**< memory smaller than its size function says */
  SF_ERROR_WORKSPACE_ALIGNMENT = 12, /**< memory not aligned to SF_ALIGNMENT */
  SF_ERROR_MODE = 13,                /**< unknown mode */
  SF_ERROR_FOCUS = 14,               /**< focus not finite or beyond +-SF_MAX_FOCUS */
  SF_ERROR_APERTURE = 15,            /**< aperture outside [0, 1] */
  SF_ERROR_BLUR_TOO_LARGE = 16,      /**< aperture * |disparity - focus| would exceed max_blur */
  SF_ERROR_STRIDE = 17,              /**< stride smaller than a row, or misaligned */
  SF_ERROR_NOT_FINITE = 18,          /**< disparity map holds NaN or infinity */
  SF_ERROR_DISPARITY = 19,   /**< disparity map holds a value outside the configured range */
  SF_ERROR_STATE = 20,       /**< streaming call without sf_stream_begin or streaming = 1, or one of
                                images without images = 1 */
  SF_ERROR_COUNT = 21,       /**< row count negative, or more rows than the picture has */
  SF_ERROR_RUNNER = 22,      /**< the runner failed or misused its jobs; output is incomplete */
  SF_ERROR_OVERLAP = 23,     /**< output overlaps an input or the workspace */
  SF_ERROR_ALL_INVALID = 24, /**< disparity map without a single finite value */
  SF_ERROR_LAYER = 25,       /**< max_layer is not 0, 1 or 2 */
  SF_ERROR_DEBLOCKING = 26,  /**< deblocking outside [0, 255] */
  SF_ERROR_TIMING = 27,      /**< a timing coefficient beyond SF_MAX_TIMING */
  SF_ERROR_RULE = 28,        /**< unknown rule, or SF_RULE_PAPER without SF_FEATURE_LINE_SCAN */
  SF_ERROR_N_SCALE = 29,     /**< n_scale outside [SF_MIN_N_SCALE, SF_MAX_N_SCALE] */
  SF_ERROR_SKIPS = 30,       /**< skips is not 0 or 1 */
  SF_ERROR_REGION = 31,      /**< region outside the picture, or a streaming call with a region */
  SF_ERROR_PREPARED = 32,    /**< prepared light field of another configuration */
  SF_ERROR_GATHER = 33,      /**< gather is not 0 or 1 */
  SF_ERROR_TOO_LARGE = 34,   /**< more memory needed than half of the machine's addresses */
  SF_ERROR_MEMORY = 35,      /**< an allocator, or that of starfocus.hpp, has no memory */
  SF_ERROR_POSITION = 36,    /**< position outside the picture */
  SF_ERROR_F_STOP = 37,      /**< an f-stop not finite, or wider than the widest */
  SF_ERROR_TRANSFER = 38,    /**< unknown transfer */
  SF_ERROR_SHAPE = 39,       /**< unknown aperture_shape */
  SF_ERROR_BLADES = 40,      /**< blades outside [3, SF_MAX_BLADES] */
  SF_ERROR_ROTATION = 41,    /**< rotation outside [-360, 360] */
  SF_ERROR_CURVATURE = 42,   /**< curvature outside [0, 1] */
  SF_ERROR_RING = 43,        /**< ring_inner outside [0, SF_MAX_RING_INNER] */
  SF_ERROR_CATS_EYE = 44,    /**< cats_eye outside [0, 1] */
  SF_ERROR_HIGHLIGHTS = 45,  /**< highlights outside [1, SF_MAX_HIGHLIGHTS] */
  SF_ERROR_FILL = 46,        /**< fill_unknown is not 0 or 1 */
  SF_ERROR_CANCELLED = 47,   /**< the caller's progress function said so; output is incomplete */
  SF_ERROR_IMAGES = 48,      /**< images is not 0 or 1 */
  SF_ERROR_FORMAT = 49,      /**< unknown format, matrix or range of an image */
  SF_ERROR_PIXEL_STRIDE = 50, /**< pixel_stride is none of the image's format */
  SF_ERROR_DEPTH_TYPE = 51,   /**< a depth map of unknown type, meaning or has_invalid */
  SF_ERROR_DEPTH_SCALE = 52,  /**< scale or offset of a depth map not finite, or scale 0 */
  SF_ERROR_DEPTH_SIZE = 53,   /**< depth map larger than the picture, or empty */
  SF_ERROR_PREVIEW = 54, /**< previews outside [0, SF_MAX_PREVIEW], or a shift that the light field
                            was not prepared for */
  SF_ERROR_VIEW_POSITIONS = 55, /**< a position beyond 1, two alike, or the first one not (0, 0) */
  SF_ERROR_STAR = 56            /**< SF_RULE_PAPER without the views of sf_view_position */
} sf_status;

/** One English sentence for a status; never null, static storage. */
SF_API const char* sf_status_string(sf_status status);

#ifdef __cplusplus
}
#endif

#endif /* STARFOCUS_STATUS_H_ */
