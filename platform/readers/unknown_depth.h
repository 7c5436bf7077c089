// SPDX-License-Identifier: Apache-2.0
// Depths that a depth picture does not know: finds them, and fills them with what is behind.
#ifndef STARFOCUS_PLATFORM_READERS_UNKNOWN_DEPTH_H_
#define STARFOCUS_PLATFORM_READERS_UNKNOWN_DEPTH_H_

#include "platform/readers/depth_options.h"
#include "platform/readers/photo.h"

namespace starfocus {

// Sets unknown values of photo->map, which is as the file has it, to NaN. Values that are not
// finite are always unknown, and so are the values of options.unknown. Without these, 0 and 65535
// of a map of more than 8 bits (`largest`, the sample of white; 0 for PFM) are unknown, unless the
// other values show that they are depths. A note says what was decided.
void MarkUnknown(const DepthOptions& options, int largest, DepthPhoto* photo);

// Replaces NaN in a map in which larger is nearer by what is behind: along the row or the column,
// whichever has the shorter gap, the smaller of the two values at its ends, or a value between them
// if they differ by at most 5 % of the range. At least one value has to be known. Returns the
// number of pixels that were filled.
size_t FillBehind(FloatMap* map);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_UNKNOWN_DEPTH_H_
