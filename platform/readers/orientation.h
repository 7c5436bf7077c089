// SPDX-License-Identifier: Apache-2.0
// The eight orientations of EXIF, applied to pixels.
#ifndef STARFOCUS_PLATFORM_READERS_ORIENTATION_H_
#define STARFOCUS_PLATFORM_READERS_ORIENTATION_H_

#include "platform/readers/photo.h"

namespace starfocus {

// Turns and mirrors a map.
void TurnMap(int orientation, FloatMap* map);

// Turns and mirrors a point, in parts of width and height from 0 to 1.
void TurnPoint(int orientation, double* x, double* y);

// Turns and mirrors picture, map, focus and subject as `orientation` says, makes it 1, and adds a
// fact.
void ApplyOrientation(DepthPhoto* photo);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_ORIENTATION_H_
