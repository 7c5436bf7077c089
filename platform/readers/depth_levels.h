// SPDX-License-Identifier: Apache-2.0
// Converts the levels of a depth picture, 0 to 1, to inverse distances or to values that define
// only an order of depth.
#ifndef STARFOCUS_PLATFORM_READERS_DEPTH_LEVELS_H_
#define STARFOCUS_PLATFORM_READERS_DEPTH_LEVELS_H_

#include <string>

#include "platform/readers/jpeg_parts.h"
#include "platform/readers/photo.h"
#include "platform/result.h"

namespace starfocus {

// A distance range with 0 < near < far. `far` may be infinite if `inverse` is true.
struct DepthRange {
  bool inverse = true;  // true: levels are linear in 1 / distance; false: linear in distance
  double near = 0, far = 0;
};

// Converts levels to inverse distances. Level 0 means the distance `near`, and level 1 means the
// distance `far`.
void ToInverse(const DepthRange& range, FloatMap* map);

// Converts levels linearly, such that level 0 becomes `low` and level 1 becomes `high`.
void ToRange(double low, double high, FloatMap* map);

// Replaces each distance z by 1 / z, and +inf by 0. Distances that are not positive become unknown
// (NaN).
void Invert(FloatMap* map);

// Sets the meaning of a map to MapMeaning::kOrder, and inverts the map if black is near. If `near`
// is kUnknown, MakePhotoField (photo_scale.h) guesses which end of the value range is near. The
// value +inf is the farthest depth if small values are near (it becomes -inf), and unknown
// otherwise.
void ToOrder(Near near, DepthPhoto* photo);

// Adds an entry to photo->facts that describes how the file stores the map.
void TellMap(const std::string& text, DepthPhoto* photo);

// Decodes the picture of a JPEG file. Copies EXIF and the ICC profile from `parts` to the result.
Result<DepthPhoto> ReadJpegPicture(const std::string& where, Span file, const JpegParts& parts);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_DEPTH_LEVELS_H_
