// SPDX-License-Identifier: Apache-2.0
// The eight orientations of EXIF, applied to pixels.
#ifndef STARFOCUS_PLATFORM_READERS_ORIENTATION_H_
#define STARFOCUS_PLATFORM_READERS_ORIENTATION_H_

#include "platform/readers/photo.h"

namespace starfocus {

// Turns and mirrors a map.
void TurnMap(int orientation, FloatMap* map);

// Turns and mirrors picture, map and focus as `orientation` says, makes it 1, and adds a fact.
void ApplyOrientation(DepthPhoto* photo);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_ORIENTATION_H_
