// SPDX-License-Identifier: Apache-2.0
// The readers of depth photos: whole files (JPEG, HEIC, PNG), and the light field made of them.
#include <cmath>
#include <cstdlib>

#include "platform/readers/depth_photo_file.h"
#include "platform/readers/photo_scale.h"
#include "starfocus/starfocus.h"
#include "tests/fuzz/input.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  starfocus::DepthPhoto photo;
  const starfocus::Near near = size % 2 == 0 ? starfocus::Near::kUnknown : starfocus::Near::kWhite;
  const std::string error = starfocus::DecodeDepthPhoto("photo", {data, size}, true, near, &photo);
  if (!error.empty() || photo.map.values.empty()) return 0;
  if (photo.map.values.size() != size_t(photo.map.width) * size_t(photo.map.height)) std::abort();
  // Small ones: the engine's own fuzz target is for what follows.
  if (photo.picture.pixels.size() > 1 << 20) return 0;
  starfocus::LightField field;
  if (!starfocus::MakeLightField("photo", &photo, &field).empty()) return 0;
  const starfocus::Image& view = field.views[0];
  if (view.pixels.size() != view.stride() * size_t(view.height)) std::abort();
  if (field.width() != view.width || field.height() != view.height) std::abort();
  for (const float disparity : field.disparity.values) {
    if (std::fabs(disparity) > float(SF_MAX_DISPARITY)) std::abort();
  }
  return 0;
}
