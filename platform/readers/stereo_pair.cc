// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/stereo_pair.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "platform/image_io.h"
#include "platform/readers/multi_picture.h"

namespace starfocus {
namespace {

constexpr uint32_t kUndefined = 0, kStereo = 0x020002;  // picture types of CIPA DC-007

bool Contains(Span text, const std::string& part) {
  const uint8_t* end = text.data + text.size;
  return std::search(text.data, end, part.begin(), part.end()) != end;
}

// Returns true if the XMP of the picture marks it as an auxiliary picture, such as a gain map or a
// matte.
bool IsAuxiliary(const MultiPicture& picture) {
  return std::any_of(picture.parts.xmp.begin(), picture.parts.xmp.end(), [](const Span& xmp) {
    return Contains(xmp, "AuxiliaryImageType") || Contains(xmp, "hdr-gain-map");
  });
}

}  // namespace

bool ReadStereoPair(const std::string& path, Span file, DepthPhoto* photo) {
  if (!IsJpeg(file)) return false;
  const Result<JpegParts> parts = ReadJpegParts(path, file);
  if (!parts || (parts->multi_picture.empty() && LowerExtension(path) != ".mpo")) return false;
  const std::vector<MultiPicture> pictures = ListMultiPictures(file, *parts).pictures;
  if (pictures.empty() || IsAuxiliary(pictures[0])) return false;
  const uint32_t type = pictures[0].type;
  if (type != kUndefined && type != kStereo) return false;
  const Span second = pictures[0].file;
  Result<DecodedPicture> right = DecodeImage(path, Bytes(second.data, second.data + second.size));
  if (!right || right->image.width != photo->picture.width ||
      right->image.height != photo->picture.height) {
    return false;
  }
  if (!pictures[0].indexed) {
    photo->notes.push_back(
        "the multi-picture index is wrong or absent: the right picture was found behind the left "
        "one");
  }
  if (photo->orientation != 1) {
    photo->notes.push_back("the EXIF orientation is ignored: stereo pairs are not rotated");
  }
  photo->format = "stereo pair (MPO)";
  photo->right = std::move(right->image);
  return true;
}

}  // namespace starfocus
