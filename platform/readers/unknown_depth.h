// SPDX-License-Identifier: Apache-2.0
// Finds unknown values of a depth picture, and fills them with the background.
#ifndef STARFOCUS_PLATFORM_READERS_UNKNOWN_DEPTH_H_
#define STARFOCUS_PLATFORM_READERS_UNKNOWN_DEPTH_H_

#include "platform/readers/depth_options.h"
#include "platform/readers/photo.h"

namespace starfocus {

// Sets unknown values of photo->map, as read from the file, to NaN. Values that are not finite and
// values in options.unknown are always unknown. If options.unknown is empty, 0 and 65535 are also
// unknown in maps of more than 8 bits, unless the other values show that they are depths. `largest`
// is the sample of white, and 0 for PFM. A note reports the decision.
void MarkUnknown(const DepthOptions& options, int largest, DepthPhoto* photo);

// Replaces NaN in a map in which larger is nearer by the background. The gap along the row or the
// column is used, whichever is shorter. The new value is the smaller of the two at the ends of the
// gap, or interpolated if they differ by at most 5 % of the range. At least one value must be
// known. Returns the number of filled pixels.
size_t FillBehind(FloatMap* map);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_UNKNOWN_DEPTH_H_
