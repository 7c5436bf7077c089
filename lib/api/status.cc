// SPDX-License-Identifier: Apache-2.0
#include "starfocus/starfocus.h"

namespace {

// Those of starfocus/image.h.
const char* StringOfImages(sf_status status) {
  switch (status) {
    case SF_ERROR_IMAGES:
      return "images is not 0 or 1";
    case SF_ERROR_FORMAT:
      return "unknown format, matrix or range of an image";
    case SF_ERROR_PIXEL_STRIDE:
      return "bytes from pixel to pixel are none that the image's format allows";
    case SF_ERROR_DEPTH_TYPE:
      return "unknown type or meaning of a depth map, or has_invalid is not 0 or 1";
    case SF_ERROR_DEPTH_SCALE:
      return "scale or offset of a depth map is not finite, or scale is 0";
    case SF_ERROR_DEPTH_SIZE:
      return "depth map is larger than the picture, or has no values";
    default:
      return "unknown status";
  }
}

}  // namespace

const char* sf_status_string(sf_status status) {
  switch (status) {
    case SF_OK:
      return "success";
    case SF_ERROR_NULL:
      return "a required pointer is null";
    case SF_ERROR_VERSION:
      return "structure version differs from SF_ABI_VERSION; call its init function first";
    case SF_ERROR_RESERVED:
      return "a reserved field, or an unknown bit of features, is not zero";
    case SF_ERROR_SIZE:
      return "width or height is outside 1 to 65535";
    case SF_ERROR_VIEWS:
      return "number of views is not 1, 5, 9 or 17, or with positions not 1 to 17";
    case SF_ERROR_DISPARITY_RANGE:
      return "disparity range is not finite, reversed, or beyond 500 pixels";
    case SF_ERROR_MAX_BLUR:
      return "max_blur is outside 0 (exclusive) to 128 pixels";
    case SF_ERROR_BLOCK:
      return "largest_block is not 0, 32, 64, 128 or 256";
    case SF_ERROR_WORKERS:
      return "max_workers is outside 1 to 64";
    case SF_ERROR_THETA:
      return "theta is outside 0.05 pi to 0.45 pi";
    case SF_ERROR_WORKSPACE_SMALL:
      return "memory is smaller than sf_workspace_size or sf_prepared_size asks for";
    case SF_ERROR_WORKSPACE_ALIGNMENT:
      return "memory is not aligned to SF_ALIGNMENT bytes";
    case SF_ERROR_MODE:
      return "unknown mode";
    case SF_ERROR_FOCUS:
      return "focus is not finite or beyond 1e6";
    case SF_ERROR_APERTURE:
      return "aperture is outside 0 to 1";
    case SF_ERROR_BLUR_TOO_LARGE:
      return "aperture times the distance of the disparity range from the focus exceeds max_blur";
    case SF_ERROR_STRIDE:
      return "stride is smaller than a row, or misaligned for the disparity map";
    case SF_ERROR_NOT_FINITE:
      return "disparity map holds NaN or infinity";
    case SF_ERROR_DISPARITY:
      return "disparity map holds a value outside the configured disparity range";
    case SF_ERROR_STATE:
      return "streaming is not 0 or 1, or a call lacks sf_stream_begin or images = 1";
    case SF_ERROR_COUNT:
      return "row count is negative or beyond the picture's last row";
    case SF_ERROR_RUNNER:
      return "the runner failed, or ran jobs not once each by valid workers; output is incomplete";
    case SF_ERROR_OVERLAP:
      return "output overlaps an input or the workspace";
    case SF_ERROR_ALL_INVALID:
      return "disparity map holds no finite value";
    case SF_ERROR_LAYER:
      return "max_layer is not 0, 1 or 2";
    case SF_ERROR_DEBLOCKING:
      return "deblocking is outside 0 to 255";
    case SF_ERROR_TIMING:
      return "a timing coefficient exceeds SF_MAX_TIMING";
    case SF_ERROR_RULE:
      return "unknown rule, or SF_RULE_PAPER without SF_FEATURE_LINE_SCAN";
    case SF_ERROR_N_SCALE:
      return "n_scale is outside 0.5 to 2";
    case SF_ERROR_SKIPS:
      return "skips is not 0 or 1";
    case SF_ERROR_FILL:
      return "fill_unknown is not 0 or 1";
    case SF_ERROR_VIEW_POSITIONS:
      return "positions of views are not finite, beyond 1, alike, or do not begin with (0, 0)";
    case SF_ERROR_STAR:
      return "SF_RULE_PAPER needs the star of sf_view_position: 1, 5, 9 or 17 views";
    case SF_ERROR_PREVIEW:
      return "previews is outside 0 to 3, or the light field was not prepared for that shift";
    case SF_ERROR_REGION:
      return "region is not inside the picture, or is given for streaming, which has none";
    case SF_ERROR_PREPARED:
      return "prepared light field is of another kind, size, views, range, max_layer or transfer";
    case SF_ERROR_GATHER:
      return "gather is not 0 or 1";
    case SF_ERROR_TOO_LARGE:
      return "the configuration needs more memory than this machine can address";
    case SF_ERROR_MEMORY:
      return "there is no memory for the engine";
    case SF_ERROR_POSITION:
      return "position is outside the picture";
    case SF_ERROR_F_STOP:
      return "f-stop is not finite, or wider than the widest of the light field";
    case SF_ERROR_TRANSFER:
      return "transfer is not SF_TRANSFER_SRGB or SF_TRANSFER_NONE";
    case SF_ERROR_SHAPE:
      return "unknown aperture_shape";
    case SF_ERROR_BLADES:
      return "blades is outside 3 to 12";
    case SF_ERROR_ROTATION:
      return "rotation is outside -360 to 360 degrees";
    case SF_ERROR_CURVATURE:
      return "curvature is outside 0 to 1";
    case SF_ERROR_RING:
      return "ring_inner is outside 0 to 0.9";
    case SF_ERROR_CATS_EYE:
      return "cats_eye is outside 0 to 1";
    case SF_ERROR_HIGHLIGHTS:
      return "highlights is outside 1 to 64";
    case SF_ERROR_CANCELLED:
      return "the progress function cancelled the call; the output is incomplete";
    default:
      return StringOfImages(status);
  }
}
