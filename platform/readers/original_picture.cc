// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/original_picture.h"

#include <utility>

#include "platform/image_io.h"
#include "platform/readers/depth_levels.h"
#include "platform/readers/map_orientation.h"
#include "platform/readers/profile.h"
#include "platform/text.h"

namespace starfocus {
namespace {

Result<DepthPhoto> Decode(const std::string& name, Span file) {
  if (IsJpeg(file)) {
    const Result<JpegParts> parts = ReadJpegParts(name, file);
    if (!parts) return parts.error();
    return ReadJpegPicture(name, file, *parts);
  }
  Result<DecodedPicture> picture = DecodeImage(name, Bytes(file.data, file.data + file.size));
  if (!picture) return picture.error();
  DepthPhoto photo;
  photo.picture = std::move(picture->image);
  photo.metadata = std::move(picture->metadata);
  ChooseProfile(&photo);
  return photo;
}

// Returns an error if the original shows another part of the scene than the picture of the photo.
// `photo` has no picture if only its map is read.
Error CheckProportions(const std::string& name, const Image& original, const Image& picture) {
  if (picture.pixels.empty() ||
      HasSameProportions({picture.width, picture.height, {}}, original.width, original.height)) {
    return {};
  }
  return Expected(name, "the proportions of " + SizeText(picture.width, picture.height),
                  SizeText(original.width, original.height));
}

}  // namespace

void TakeOriginal(const std::string& name, Span file, DepthPhoto* photo) {
  Result<DepthPhoto> original = Decode(name, file);
  Error error = original.error();
  if (!error) error = CheckProportions(name, original->picture, photo->picture);
  if (error) {
    photo->notes.push_back("the sharp picture in the file is ignored: " + error.line());
    return;
  }
  photo->picture = std::move(original->picture);
  if (!original->metadata.icc.empty()) {
    photo->metadata.icc = std::move(original->metadata.icc);
    photo->is_linear = original->is_linear;
  }
  photo->is_blurred = false;
  photo->facts.emplace_back("picture", "the sharp picture in the file (" + name + ")");
}

}  // namespace starfocus
