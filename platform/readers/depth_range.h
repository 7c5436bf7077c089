// SPDX-License-Identifier: Apache-2.0
// Applies depth ranges of Google's formats, which define the distances that the levels of a map
// represent.
#ifndef STARFOCUS_PLATFORM_READERS_DEPTH_RANGE_H_
#define STARFOCUS_PLATFORM_READERS_DEPTH_RANGE_H_

#include <string>

#include "platform/readers/photo.h"

namespace starfocus {

// Properties of a depth range as stated by XMP. A pointer is null if XMP lacks the property.
struct RangeProperties {
  const std::string *format, *near, *far, *units;
};

// Replaces the levels of photo->map, 0 to 1, by inverse distances. A valid depth range has the
// format RangeInverse or RangeLinear, and 0 < near < far. `far` may be infinite if the format is
// RangeInverse. Level 0 means the distance `near`. ApplyRange ignores an invalid depth range and
// adds a note. With an invalid range, the map receives the meaning kOrder, and black is near unless
// `near` is kWhite.
//
// @return metres per unit of distance; 1 if the unit is unknown, 0 if the meaning of the map is
//     kOrder
double ApplyRange(const RangeProperties& range, Near near, DepthPhoto* photo);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_DEPTH_RANGE_H_
