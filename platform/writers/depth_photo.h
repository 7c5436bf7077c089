// SPDX-License-Identifier: Apache-2.0
// JPEG files that others can refocus again: Google's GDepth, GImage and GFocus in extended XMP.
//
// A camera's distances are not known here, so that they are told in a unit of their own: the
// disparity D has the distance 1 / (D - least disparity + 1), from the nearest, near, to 1, far. A
// reader gets all disparities back up to a constant, which only says what "in focus" is called, and
// a factor. Both are in properties of our own, so that f-stops stay what they are:
// NearDisparity and FarDisparity, of the levels 0 and 255, for a lens of f/1, in parts of the
// picture's diagonal.
#ifndef STARFOCUS_PLATFORM_WRITERS_DEPTH_PHOTO_H_
#define STARFOCUS_PLATFORM_WRITERS_DEPTH_PHOTO_H_

#include <string>

#include "platform/image.h"
#include "platform/metadata.h"
#include "platform/pfm.h"
#include "platform/result.h"

namespace starfocus {

// The namespace of our own properties, and their names.
constexpr char kOwnNamespace[] = "urn:starfocus:1.0/";
constexpr char kNearDisparity[] = "NearDisparity", kFarDisparity[] = "FarDisparity";

// What a depth photo has besides its picture, and what that was made of.
struct SharpOriginal {
  const Image* before;        // sharp everywhere; of the picture's size
  const FloatMap* disparity;  // of it; finite
  double focus = 0;           // disparity that the picture is focused at
  double aperture = 1;        // its radius: blur has |D - focus| * aperture pixels
  double widest = 1;          // f-stop of radius 1
};

// The picture as JPEG of that quality with the one before and its map, a PNG of 8 bits whose levels
// are linear in disparity (RangeInverse). GFocus:BlurAtInfinity is the radius of blur over the
// longer side. `path` only names the file in errors.
Result<Bytes> EncodeDepthPhoto(const std::string& path, const Image& picture,
                               const SharpOriginal& photo, int quality, const Metadata& metadata);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_WRITERS_DEPTH_PHOTO_H_
