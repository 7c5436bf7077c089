// SPDX-License-Identifier: Apache-2.0
// The sentence of each status.
#include <doctest/doctest.h>

#include <set>
#include <string>

#include "starfocus/starfocus.h"

// A status that is forgotten below does not compile.
#pragma GCC diagnostic error "-Wswitch"

namespace status_test {
namespace {

// What only the sentence of this status says; null when there is no such status.
const char* WordsOf(sf_status status) {
  switch (status) {
    case SF_OK:
      return "success";
    case SF_ERROR_NULL:
      return "pointer is null";
    case SF_ERROR_VERSION:
      return "SF_ABI_VERSION";
    case SF_ERROR_RESERVED:
      return "reserved field";
    case SF_ERROR_SIZE:
      return "width or height";
    case SF_ERROR_VIEWS:
      return "number of views";
    case SF_ERROR_DISPARITY_RANGE:
      return "range is not finite";
    case SF_ERROR_MAX_BLUR:
      return "max_blur is outside";
    case SF_ERROR_BLOCK:
      return "largest_block";
    case SF_ERROR_WORKERS:
      return "max_workers";
    case SF_ERROR_THETA:
      return "theta";
    case SF_ERROR_WORKSPACE_SMALL:
      return "smaller than sf_workspace_size";
    case SF_ERROR_WORKSPACE_ALIGNMENT:
      return "SF_ALIGNMENT";
    case SF_ERROR_MODE:
      return "unknown mode";
    case SF_ERROR_FOCUS:
      return "focus is not finite";
    case SF_ERROR_APERTURE:
      return "aperture is outside";
    case SF_ERROR_BLUR_TOO_LARGE:
      return "exceeds max_blur";
    case SF_ERROR_STRIDE:
      return "stride";
    case SF_ERROR_NOT_FINITE:
      return "NaN or infinity";
    case SF_ERROR_DISPARITY:
      return "outside the configured disparity range";
    case SF_ERROR_STATE:
      return "sf_stream_begin";
    case SF_ERROR_COUNT:
      return "row count";
    case SF_ERROR_RUNNER:
      return "runner";
    case SF_ERROR_OVERLAP:
      return "overlaps";
    case SF_ERROR_ALL_INVALID:
      return "no finite value";
    case SF_ERROR_LAYER:
      return "max_layer is";
    case SF_ERROR_DEBLOCKING:
      return "deblocking";
    case SF_ERROR_TIMING:
      return "timing coefficient";
    case SF_ERROR_RULE:
      return "unknown rule";
    case SF_ERROR_N_SCALE:
      return "n_scale";
    case SF_ERROR_SKIPS:
      return "skips";
    case SF_ERROR_PREVIEW:
      return "not prepared for that shift";
    case SF_ERROR_REGION:
      return "region";
    case SF_ERROR_PREPARED:
      return "prepared light field";
    case SF_ERROR_FILL:
      return "fill_unknown";
    case SF_ERROR_GATHER:
      return "gather";
    case SF_ERROR_TOO_LARGE:
      return "can address";
    case SF_ERROR_MEMORY:
      return "there is no memory";
    case SF_ERROR_POSITION:
      return "position is";
    case SF_ERROR_VIEW_POSITIONS:
      return "positions of views";
    case SF_ERROR_STAR:
      return "sf_view_position";
    case SF_ERROR_HIGHLIGHTS:
      return "highlights";
    case SF_ERROR_TRANSFER:
      return "SF_TRANSFER_SRGB or SF_TRANSFER_NONE";
    case SF_ERROR_F_STOP:
      return "f-stop";
    case SF_ERROR_SHAPE:
      return "aperture_shape";
    case SF_ERROR_BLADES:
      return "blades is outside";
    case SF_ERROR_ROTATION:
      return "degrees";
    case SF_ERROR_CURVATURE:
      return "curvature";
    case SF_ERROR_RING:
      return "ring_inner";
    case SF_ERROR_CATS_EYE:
      return "cats_eye";
    case SF_ERROR_CANCELLED:
      return "cancelled";
    case SF_ERROR_IMAGES:
      return "images is not";
    case SF_ERROR_FORMAT:
      return "format, matrix or range";
    case SF_ERROR_PIXEL_STRIDE:
      return "from pixel to pixel";
    case SF_ERROR_DEPTH_TYPE:
      return "type or meaning";
    case SF_ERROR_DEPTH_SCALE:
      return "scale or offset";
    case SF_ERROR_DEPTH_SIZE:
      return "larger than the picture";
  }
  return nullptr;
}

TEST_CASE("statuses: every one has a sentence of its own, and no other number has") {
  std::set<std::string> sentences;
  int statuses = 0;
  for (int number = -1000; number <= 1000; ++number) {
    CAPTURE(number);
    const auto status = static_cast<sf_status>(number);
    const std::string sentence = sf_status_string(status);
    if (WordsOf(status) == nullptr) {
      CHECK(sentence == "unknown status");
      continue;
    }
    ++statuses;
    CAPTURE(sentence);
    CHECK(sentence != "unknown status");
    CHECK(sentences.insert(sentence).second);
    // What it says is of this status and of no other.
    for (int other = 0; other < 100; ++other) {
      const char* const words = WordsOf(static_cast<sf_status>(other));
      if (words == nullptr) continue;
      CAPTURE(words);
      CHECK((sentence.find(words) != std::string::npos) == (other == number));
    }
  }
  CHECK(statuses >= 56);
}

}  // namespace
}  // namespace status_test
