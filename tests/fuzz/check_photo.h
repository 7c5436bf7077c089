// SPDX-License-Identifier: Apache-2.0
// Reads a whole file of a depth photo and makes its light field. Used by the fuzz targets of
// photos.
#ifndef STARFOCUS_TESTS_FUZZ_CHECK_PHOTO_H_
#define STARFOCUS_TESTS_FUZZ_CHECK_PHOTO_H_

#include <cmath>
#include <cstdlib>
#include <string>

#include "platform/icc_profile.h"
#include "platform/readers/depth_photo_file.h"
#include "platform/readers/photo_scale.h"
#include "platform/readers/stereo_pair.h"
#include "platform/readers/xmp.h"
#include "platform/writers/jpeg_segments.h"
#include "starfocus/starfocus.h"
#include "tests/fuzz/memory_budget.h"

namespace starfocus::fuzz {

// Checks that the XMP that a writer makes is well-formed. The written XMP may be nested deeper than
// the XMP that was read.
inline void CheckCaptions(const Metadata& metadata) {
  const std::string packet = XmpPacket(metadata.xmp);
  if (packet.empty() || !CanReadXmp()) return;
  const Result<XmpNode> root = ParseXmp("captions", packet.data(), packet.size());
  if (root.error().line().find("well-formed") != std::string::npos) std::abort();
}

inline Result<DepthPhoto> Decode(const uint8_t* data, size_t size) {
  const MemoryBudget budget(data, size);
  const Near near = size % 2 == 0 ? Near::kUnknown : Near::kWhite;
  return DecodeDepthPhoto("photo", {data, size}, true, near);
}

inline void CheckPhoto(const uint8_t* data, size_t size) {
  Result<DepthPhoto> decoded = Decode(data, size);
  if (!decoded) return;
  DepthPhoto& photo = *decoded;
  CheckCaptions(photo.metadata);
  const Bytes& icc = photo.metadata.icc;
  if (!icc.empty() && !IsRgbProfile(icc)) std::abort();
  if (photo.map.values.empty() && photo.matte.values.empty()) {
    if (ReadStereoPair("photo", {data, size}, &photo) &&
        photo.right.pixels.size() != photo.picture.pixels.size()) {
      std::abort();
    }
    return;
  }
  for (const FloatMap* map : {&photo.map, &photo.matte}) {
    if (map->values.size() != size_t(map->width) * size_t(map->height)) std::abort();
  }
  // Only small photos are processed further, since the engine has its own fuzz target.
  if (photo.picture.pixels.size() > 1 << 20) return;
  Result<LightField> made = MakePhotoField("photo", &photo);
  if (!made) return;
  LightField& field = *made;
  FitMap(&field);
  const Image& view = field.views[0];
  if (view.pixels.size() != view.stride() * size_t(view.height)) std::abort();
  if (field.width() != view.width || field.height() != view.height) std::abort();
  for (const float disparity : field.disparity.values) {
    if (std::fabs(disparity) > float(STARFOCUS_MAX_DISPARITY)) std::abort();
  }
}

}  // namespace starfocus::fuzz

#endif  // STARFOCUS_TESTS_FUZZ_CHECK_PHOTO_H_
