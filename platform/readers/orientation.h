// SPDX-License-Identifier: Apache-2.0
// Applies the eight orientations of EXIF to pixels.
#ifndef STARFOCUS_PLATFORM_READERS_ORIENTATION_H_
#define STARFOCUS_PLATFORM_READERS_ORIENTATION_H_

#include "platform/readers/photo.h"

namespace starfocus {

// Rotates and mirrors a map by an EXIF orientation.
void TurnMap(int orientation, FloatMap* map);

// Rotates and mirrors a point by an EXIF orientation. The coordinates are fractions of width and
// height.
void TurnPoint(int orientation, double* x, double* y);

// Rotates and mirrors picture, gain map, map, matte, focus and subject by photo->orientation. Moves
// photo->orientation to photo->applied_orientation and adds an entry to photo->facts.
void ApplyOrientation(DepthPhoto* photo);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_ORIENTATION_H_
