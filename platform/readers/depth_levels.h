// SPDX-License-Identifier: Apache-2.0
// From the levels of a depth picture, 0 to 1, to what they stand for.
#ifndef STARFOCUS_PLATFORM_READERS_DEPTH_LEVELS_H_
#define STARFOCUS_PLATFORM_READERS_DEPTH_LEVELS_H_

#include <string>

#include "platform/readers/jpeg_parts.h"
#include "platform/readers/photo.h"
#include "platform/result.h"

namespace starfocus {

// A distance range, 0 < near < far; far may be infinite if `inverse`.
struct DepthRange {
  bool inverse = true;  // levels are linear in 1 / distance, or in the distance
  double near = 0, far = 0;
};

// Level 0 is `near` away, level 1 `far`: distances become their inverse.
void ToInverse(const DepthRange& range, FloatMap* map);

// Level 0 becomes `low`, level 1 `high`.
void ToRange(double low, double high, FloatMap* map);

// Distances become their inverse; what is not in front of the camera is unknown.
void Invert(FloatMap* map);

// Makes larger nearer in a map that tells only an order. Where nobody says which end is near it is
// guessed, which is noted: what is low in a photograph is nearer than what is high.
void ToOrder(Near near, DepthPhoto* photo);

// A fact about the map as the file has it.
void TellMap(const std::string& text, DepthPhoto* photo);

// The picture, EXIF and ICC of a JPEG file and its parts.
Result<DepthPhoto> ReadJpegPicture(const std::string& where, Span file, const JpegParts& parts);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_DEPTH_LEVELS_H_
