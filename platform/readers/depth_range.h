// SPDX-License-Identifier: Apache-2.0
// Depth ranges of Google's formats: what the levels of a map stand for.
#ifndef STARFOCUS_PLATFORM_READERS_DEPTH_RANGE_H_
#define STARFOCUS_PLATFORM_READERS_DEPTH_RANGE_H_

#include <string>

#include "platform/readers/photo.h"

namespace starfocus {

// The properties of a range as the XMP has them; null where a property is absent.
struct RangeProperties {
  const std::string *format, *near, *far, *units;
};

// Replaces the levels of photo->map, 0 to 1, by inverse distances. The format is RangeInverse or
// RangeLinear, and 0 < near < far; far may be infinite where levels are inverse. Level 0 is near.
// Any other range is ignored: the map becomes an order, in which black is near unless `near` says
// otherwise. A note says what was ignored.
//
// @return how many metres a unit of distance is; 1 for unknown units, 0 if the map is an order.
double ApplyRange(const RangeProperties& range, Near near, DepthPhoto* photo);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_DEPTH_RANGE_H_
