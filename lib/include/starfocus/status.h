/* SPDX-License-Identifier: Apache-2.0 */
/** @file
 * Results of calls, and the macro that marks exported functions. Part of starfocus.h. */
#ifndef STARFOCUS_STATUS_H_
#define STARFOCUS_STATUS_H_

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Marks the functions that the library exports. */
#if defined(__GNUC__)
#define STARFOCUS_API __attribute__((visibility("default")))
#else
#define STARFOCUS_API
#endif

/** Status that an API call returns. */
typedef enum starfocus_status {
  STARFOCUS_OK = 0,              /**< Success. */
  STARFOCUS_ERROR_NULL = 1,      /**< A required pointer is null. */
  STARFOCUS_ERROR_STRUCTURE = 2, /**< A structure was not initialized by its init function. */
  STARFOCUS_ERROR_RANGE = 3,     /**< A field or an argument is out of range. */
  STARFOCUS_ERROR_FEATURE = 4,   /**< The engine lacks a required feature or view. */
  STARFOCUS_ERROR_STATE = 5,     /**< No stream is active, or only some rows have coverage. */
  STARFOCUS_ERROR_WORKSPACE = 6, /**< The given memory is too small or not aligned. */
  STARFOCUS_ERROR_TOO_LARGE = 7, /**< The configuration requires more memory than is addressable. */
  STARFOCUS_ERROR_MEMORY = 8,    /**< Memory could not be allocated. */
  STARFOCUS_ERROR_STRIDE = 9,    /**< A stride is smaller than a row, or not aligned. */
  STARFOCUS_ERROR_OVERLAP = 10,  /**< An output overlaps an input or the workspace. */
  STARFOCUS_ERROR_BLUR = 11,     /**< The blur radius aperture * |d - focus| exceeds max_blur at
                                      disparity_min or disparity_max. */
  STARFOCUS_ERROR_DISPARITY = 12,   /**< A disparity is outside the configured range. */
  STARFOCUS_ERROR_NOT_FINITE = 13,  /**< A disparity is NaN or infinite. */
  STARFOCUS_ERROR_ALL_INVALID = 14, /**< The disparity map has no finite value. */
  STARFOCUS_ERROR_PREPARED = 15,    /**< The prepared light field has another configuration. */
  STARFOCUS_ERROR_RUNNER = 16,      /**< The runner failed or misused its jobs; the output is
                                         incomplete. */
  STARFOCUS_ERROR_CANCELLED = 17    /**< The progress callback cancelled the call; the output is
                                         incomplete. */
} starfocus_status;

/** The cause of an error. The strings `field` and `expected` are in static storage and never
 *  null. */
typedef struct starfocus_problem {
  int32_t status;    /**< starfocus_status that the call returned. */
  int32_t index;     /**< Index of the array element, if `field` contains []; otherwise 0. */
  const char* field; /**< Wrong field or argument, for example "width" or "views[].strides"; "" if
                        no single field is wrong. */
  const char* expected; /**< Allowed values in words, for example "1 to 65535". */
  double value;         /**< Value that was given; NaN if unknown. */
  double low;           /**< Smallest allowed value; NaN if there is no range. */
  double high;          /**< Largest allowed value; NaN if there is no range. */
  int32_t
      x; /**< Column of the first wrong disparity in the depth map; -1 if no disparity is wrong. */
  int32_t y; /**< Row of the same disparity, from the top of the whole map. */
} starfocus_problem;

/** Describes a status.
 *  @param status status; any value
 *  @return a sentence in English, in static storage; never null */
STARFOCUS_API const char* starfocus_status_string(starfocus_status status);

#ifdef __cplusplus
}
#endif

#endif /* STARFOCUS_STATUS_H_ */
