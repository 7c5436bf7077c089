// SPDX-License-Identifier: Apache-2.0
#include "starfocus/starfocus.h"

const char* starfocus_status_string(starfocus_status status) {
  switch (status) {
    case STARFOCUS_OK:
      return "success";
    case STARFOCUS_ERROR_NULL:
      return "a required pointer is null";
    case STARFOCUS_ERROR_STRUCTURE:
      return "a structure was not initialized by its init function";
    case STARFOCUS_ERROR_RANGE:
      return "a field or an argument is outside its range";
    case STARFOCUS_ERROR_FEATURE:
      return "the call needs a feature or views that the engine was not created with";
    case STARFOCUS_ERROR_STATE:
      return "starfocus_stream_begin was not called, or only some rows of the stream have coverage";
    case STARFOCUS_ERROR_WORKSPACE:
      return "the given memory is too small or not aligned to STARFOCUS_ALIGNMENT bytes";
    case STARFOCUS_ERROR_TOO_LARGE:
      return "the configuration needs more memory than this machine can address";
    case STARFOCUS_ERROR_MEMORY:
      return "out of memory";
    case STARFOCUS_ERROR_STRIDE:
      return "a stride is smaller than a row or misaligned";
    case STARFOCUS_ERROR_OVERLAP:
      return "an output overlaps an input or the workspace";
    case STARFOCUS_ERROR_BLUR:
      return "the aperture times the distance from the focus to the farther end of the disparity "
             "range exceeds max_blur";
    case STARFOCUS_ERROR_DISPARITY:
      return "the disparity map contains a value outside the configured disparity range";
    case STARFOCUS_ERROR_NOT_FINITE:
      return "the disparity map contains NaN or infinity";
    case STARFOCUS_ERROR_ALL_INVALID:
      return "the disparity map contains no finite value";
    case STARFOCUS_ERROR_PREPARED:
      return "the prepared light field has another configuration or format";
    case STARFOCUS_ERROR_RUNNER:
      return "the runner failed, or did not run each job once on a valid worker; the output is "
             "incomplete";
    case STARFOCUS_ERROR_CANCELLED:
      return "the progress function cancelled the call; the output is incomplete";
  }
  return "unknown status";
}
