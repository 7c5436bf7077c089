// SPDX-License-Identifier: Apache-2.0
// Finds unknown values of a depth picture, and fills them with the background.
#ifndef STARFOCUS_PLATFORM_READERS_UNKNOWN_DEPTH_H_
#define STARFOCUS_PLATFORM_READERS_UNKNOWN_DEPTH_H_

#include "platform/readers/depth_options.h"
#include "platform/readers/photo.h"

namespace starfocus {

// Sets unknown values of photo->map to NaN. The map must contain the values that the file stores.
// Values that are not finite and values in options.unknown are always unknown. If
// options.has_unknown is false, 0 and 65535 may mean unknown depth in maps of more than 8 bits. The
// other values of the map decide, and a note reports the decision. `largest` is the sample value of
// white, or 0 for floats.
void MarkUnknown(const DepthOptions& options, int largest, DepthPhoto* photo);

// Replaces NaN by the background in a map in which larger values are nearer. For each unknown
// pixel, uses the gap along its row or its column, whichever is shorter. The new value of an
// unknown pixel is the smaller of the values at the ends of the gap. If the values at the ends of
// the gap differ by at most 5 % of the value range, the new value is interpolated. At least one
// value of the map must be known. Returns the number of filled pixels.
size_t FillBehind(FloatMap* map);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_UNKNOWN_DEPTH_H_
