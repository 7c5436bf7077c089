// SPDX-License-Identifier: Apache-2.0
// Decides whether the orientation in EXIF applies to a depth picture or only to its photo. Compares
// the proportions of a depth picture with the proportions of its photo.
#ifndef STARFOCUS_PLATFORM_READERS_MAP_ORIENTATION_H_
#define STARFOCUS_PLATFORM_READERS_MAP_ORIENTATION_H_

#include "platform/readers/photo.h"

namespace starfocus {

// Returns true if `map` can belong to a picture of `width` x `height` pixels. The proportions of
// map and picture may differ by rounding, or by 3 % because networks round sizes to whole blocks.
bool HasSameProportions(const FloatMap& map, int width, int height);

// Applies EXIF's orientation only to the picture if photo->map was read from an upright depth
// picture. `choice` states whether the map is upright. If `choice` is kUnknown, the proportions of
// picture and map decide. If the proportions fit the upright and the stored orientation, the edges
// of picture and map decide, and a note reports the result.
void StandWithPhoto(DepthOrientation choice, DepthPhoto* photo);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_MAP_ORIENTATION_H_
