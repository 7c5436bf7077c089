// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/stereo_pair.h"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "platform/file.h"
#include "platform/image_io.h"
#include "platform/readers/confined_photo.h"
#include "platform/readers/depth_photo_file.h"
#include "platform/readers/heic.h"
#include "platform/readers/multi_picture.h"
#include "platform/readers/orientation.h"
#include "platform/readers/pair_alignment.h"
#include "platform/text.h"

namespace starfocus {
namespace {

constexpr uint32_t kUndefined = 0, kStereo = 0x020002;  // picture types of CIPA DC-007

// Returns true if an XMP packet of a picture contains `text`.
bool HasInXmp(const JpegParts& parts, const char* text) {
  return std::any_of(parts.xmp.begin(), parts.xmp.end(),
                     [&](const Span& xmp) { return Contains(xmp, text); });
}

// Returns true if the XMP of the picture marks it as an auxiliary picture, such as a gain map or a
// matte.
bool IsAuxiliary(const MultiPicture& picture) {
  return picture.is_gain_map || HasInXmp(picture.parts, "AuxiliaryImageType");
}

// Finds the picture of a JPEG file that may be the right picture of a stereo pair.
std::optional<MultiPicture> FindRight(const std::string& path, Span file) {
  if (!IsJpeg(file)) return std::nullopt;
  const Result<JpegParts> parts = ReadJpegParts(path, file);
  if (!parts || (parts->multi_picture.empty() && LowerExtension(path) != ".mpo")) {
    return std::nullopt;
  }
  // A directory lists the second picture as a gain map.
  if (HasInXmp(*parts, "GainMap")) return std::nullopt;
  std::vector<MultiPicture> pictures =
      ListMultiPictures(file, *parts, ListAppendedPictures(file, parts->end)).pictures;
  if (pictures.empty() || IsAuxiliary(pictures[0])) return std::nullopt;
  const uint32_t type = pictures[0].type;
  if (type != kUndefined && type != kStereo) return std::nullopt;
  return std::move(pictures[0]);
}

// Reads a photo, without its depth map, and turns it upright.
Result<DepthPhoto> ReadUpright(const std::string& path) {
  const Result<Bytes> bytes = ReadFile(path);
  if (!bytes) return bytes.error();
  const Span file = {bytes->data(), bytes->size()};
  Result<DepthPhoto> photo = ConfinedPhoto(
      path, file, [&] { return DecodeDepthPhoto(path, file, false, Near::kUnknown); });
  if (!photo) return photo;
  photo->map = {};
  ApplyOrientation(&*photo);
  return photo;
}

}  // namespace

bool MayBeStereoPair(const std::string& path, Span file) {
  return FindRight(path, file).has_value();
}

bool ReadStereoPair(const std::string& path, Span file, DepthPhoto* photo) {
  if (IsHeif(file)) {
    if (!ReadHeifPair(path, file, photo)) return false;
    photo->format = "stereo pair (HEIF)";
    return true;
  }
  const std::optional<MultiPicture> second = FindRight(path, file);
  if (!second) return false;
  const Span its = second->file;
  Result<DecodedPicture> right = DecodeImage(path, Bytes(its.data, its.data + its.size));
  if (!right || right->image.width != photo->picture.width ||
      right->image.height != photo->picture.height) {
    return false;
  }
  if (!second->indexed) {
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

Result<DepthPhoto> ReadPictureFiles(const std::string& left, const std::string& right) {
  Result<DepthPhoto> first = ReadUpright(left);
  if (!first) return first;
  Result<DepthPhoto> second = ReadUpright(right);
  if (!second) return second;
  const Image& own = first->picture;
  const Image& other = second->picture;
  if (own.width != other.width || own.height != other.height) {
    return Expected(right, "a picture of " + SizeText(own.width, own.height) + ", as " + left,
                    SizeText(other.width, other.height));
  }
  first->format = "stereo pair (two files)";
  first->right = std::move(second->picture);
  first->right_path = right;
  return first;
}

Error AlignPair(const std::string& where, DepthPhoto* photo) {
  constexpr double kLeastDifference = 0.3;  // pixels; smaller differences do not matter
  const PairAlignment alignment = MeasureAlignment(photo->picture, photo->right);
  if (alignment.contradicts()) {
    return Expected(where, "two pictures of one scene, taken side by side with hardly any rotation",
                    std::to_string(alignment.consistent) + " common points of " +
                        std::to_string(alignment.corners));
  }
  if (!alignment.known()) {
    if (alignment.repeated < PairAlignment::kLeastPoints) return {};
    photo->notes.push_back("the heights of the two pictures are taken to be equal, because " +
                           std::to_string(alignment.repeated) + " of " +
                           std::to_string(alignment.corners) +
                           " points of the left picture resemble several points of the right one");
    return {};
  }
  const double largest = LargestDifference(alignment, photo->right);
  if (largest < kLeastDifference) return {};
  photo->right = AlignedPicture(alignment, photo->right);
  char note[120];
  std::snprintf(note, sizeof(note),
                "points of the right picture were moved up or down by up to %.1f pixels, to the "
                "heights of the left picture",
                largest);
  photo->notes.push_back(note);
  return {};
}

}  // namespace starfocus
