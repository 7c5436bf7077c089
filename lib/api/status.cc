// SPDX-License-Identifier: Apache-2.0
#include "starfocus/starfocus.h"

const char* sf_status_string(sf_status status) {
  switch (status) {
    case SF_OK:
      return "success";
    case SF_ERROR_NULL:
      return "a required pointer is null";
    case SF_ERROR_STRUCTURE:
      return "a structure was not initialized by its init function";
    case SF_ERROR_RANGE:
      return "a field or an argument is outside its range";
    case SF_ERROR_FEATURE:
      return "the call needs a feature or views that the engine is not made for";
    case SF_ERROR_STATE:
      return "the stream lacks sf_stream_begin, or only some of its rows have coverage";
    case SF_ERROR_WORKSPACE:
      return "the memory given is too small or not aligned to SF_ALIGNMENT bytes";
    case SF_ERROR_TOO_LARGE:
      return "the configuration needs more memory than this machine can address";
    case SF_ERROR_MEMORY:
      return "there is no memory";
    case SF_ERROR_STRIDE:
      return "a stride is smaller than a row, or misaligned";
    case SF_ERROR_OVERLAP:
      return "an output overlaps an input or the workspace";
    case SF_ERROR_BLUR:
      return "aperture times the distance of the disparity range from the focus exceeds max_blur";
    case SF_ERROR_DISPARITY:
      return "disparity map holds a value outside the configured disparity range";
    case SF_ERROR_NOT_FINITE:
      return "disparity map holds NaN or infinity";
    case SF_ERROR_ALL_INVALID:
      return "disparity map holds no finite value";
    case SF_ERROR_PREPARED:
      return "prepared light field is of another configuration or format";
    case SF_ERROR_RUNNER:
      return "the runner failed, or ran jobs not once each by valid workers; output is incomplete";
    case SF_ERROR_CANCELLED:
      return "the progress function cancelled the call; the output is incomplete";
  }
  return "unknown status";
}
