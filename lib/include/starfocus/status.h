/* SPDX-License-Identifier: Apache-2.0 */
/* starfocus: what every call answers with, and what marks its functions. Part of starfocus.h. */
#ifndef STARFOCUS_STATUS_H_
#define STARFOCUS_STATUS_H_

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define STARFOCUS_API __attribute__((visibility("default")))
#else
#define STARFOCUS_API
#endif

typedef enum starfocus_status {
  STARFOCUS_OK = 0,
  STARFOCUS_ERROR_NULL = 1,      /**< a required pointer is null */
  STARFOCUS_ERROR_STRUCTURE = 2, /**< a structure was not initialized by its init function */
  STARFOCUS_ERROR_RANGE = 3,     /**< a field or an argument is outside its range */
  STARFOCUS_ERROR_FEATURE =
      4, /**< the call needs a feature or views that the engine is not made for */
  STARFOCUS_ERROR_STATE =
      5, /**< a call of a stream without starfocus_stream_begin, or coverage of some rows */
  STARFOCUS_ERROR_WORKSPACE =
      6, /**< memory is smaller than its size function says, or not aligned */
  STARFOCUS_ERROR_TOO_LARGE = 7,    /**< more memory needed than half of the machine's addresses */
  STARFOCUS_ERROR_MEMORY = 8,       /**< an allocator, or that of starfocus.hpp, has no memory */
  STARFOCUS_ERROR_STRIDE = 9,       /**< a stride is smaller than a row, or misaligned */
  STARFOCUS_ERROR_OVERLAP = 10,     /**< an output overlaps an input or the workspace */
  STARFOCUS_ERROR_BLUR = 11,        /**< aperture * |disparity - focus| would exceed max_blur at
                                  disparity_min or disparity_max */
  STARFOCUS_ERROR_DISPARITY = 12,   /**< disparity map holds a value outside the configured range */
  STARFOCUS_ERROR_NOT_FINITE = 13,  /**< disparity map holds NaN or infinity */
  STARFOCUS_ERROR_ALL_INVALID = 14, /**< disparity map without a single finite value */
  STARFOCUS_ERROR_PREPARED = 15,    /**< prepared light field of another configuration or format */
  STARFOCUS_ERROR_RUNNER = 16,   /**< the runner failed or misused its jobs; output is incomplete */
  STARFOCUS_ERROR_CANCELLED = 17 /**< the progress function cancelled; output is incomplete */
} starfocus_status;

/** What a call refused. Texts are static; there is always one. */
typedef struct starfocus_problem {
  int32_t status; /**< starfocus_status that the call returned; STARFOCUS_OK: nothing was refused */
  int32_t index;  /**< of the element, where `field` has []; else 0 */
  const char* field;    /**< a field, such as "width" or "views[].stride", or an argument; "" if no
                             single one is at fault */
  const char* expected; /**< its range in words, such as "1 to 65535" */
  double value;         /**< what it was; NaN: unknown */
  double low, high;     /**< smallest and largest allowed value; NaN: not known or not a number */
} starfocus_problem;

/** One English sentence for a status; never null, static storage. */
STARFOCUS_API const char* starfocus_status_string(starfocus_status status);

#ifdef __cplusplus
}
#endif

#endif /* STARFOCUS_STATUS_H_ */
