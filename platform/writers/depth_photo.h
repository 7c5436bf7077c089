// SPDX-License-Identifier: Apache-2.0
// Writes JPEG files that other programs can refocus. The map, the sharp picture and the focus are
// stored in XMP, as Google's properties GDepth, GImage and GFocus.
//
// The distances from the camera are unknown, so the depth photo stores distances in an arbitrary
// unit. A disparity D is stored as the distance 1 / (D - smallest disparity + 1), so that the
// farthest distance, `far`, is 1. From the stored distances, a reader recovers the disparities only
// up to an offset and a factor. Two additional XMP properties of starfocus preserve the offset and
// the factor, so that f-stops keep their meaning. NearDisparity and FarDisparity are the
// disparities of levels 0 and 255 for a lens of f/1, as fractions of the picture's diagonal.
#ifndef STARFOCUS_PLATFORM_WRITERS_DEPTH_PHOTO_H_
#define STARFOCUS_PLATFORM_WRITERS_DEPTH_PHOTO_H_

#include <string>

#include "platform/image.h"
#include "platform/metadata.h"
#include "platform/pfm.h"
#include "platform/result.h"

namespace starfocus {

// XMP namespace and names of the properties that starfocus defines.
constexpr char kOwnNamespace[] = "urn:starfocus:1.0/";
constexpr char kNearDisparity[] = "NearDisparity", kFarDisparity[] = "FarDisparity";

// Contents of a depth photo apart from its picture: the sharp original, its map, and the lens.
struct SharpOriginal {
  const Image* before;        // Sharp original, of the size of the refocused picture.
  const FloatMap* disparity;  // Disparity map of `before`, with finite values.
  double focus = 0;           // Disparity in focus.
  double aperture = 1;  // Radius of the aperture: the blur radius is |D - focus| * aperture pixels.
  double widest = 1;    // The f-stop of an aperture of radius 1.
};

// Encodes the refocused picture as JPEG, with the sharp original and its map in XMP. The map is
// stored as an 8-bit PNG picture whose levels are linear in disparity (RangeInverse).
// GFocus:BlurAtInfinity is the blur radius at infinity, divided by the longer side of the picture.
// `path` appears only in error messages.
Result<Bytes> EncodeDepthPhoto(const std::string& path, const Image& picture,
                               const SharpOriginal& photo, int quality, const Metadata& metadata);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_WRITERS_DEPTH_PHOTO_H_
