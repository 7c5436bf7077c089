// SPDX-License-Identifier: Apache-2.0
// Decides whether EXIF's orientation applies to a depth picture as it does to its photo, and
// whether both have the same proportions.
#ifndef STARFOCUS_PLATFORM_READERS_MAP_ORIENTATION_H_
#define STARFOCUS_PLATFORM_READERS_MAP_ORIENTATION_H_

#include "platform/readers/photo.h"

namespace starfocus {

// Returns true if a map of this size can belong to a picture of the given size. Their proportions
// may differ by rounding, or by 3 % because networks round sizes to whole blocks.
bool HasSameProportions(const FloatMap& map, int width, int height);

// If photo->map, from a depth picture, is already upright, applies EXIF's orientation to the
// picture only. Without a choice, the proportions decide. If they do not, the edges of picture and
// map decide, and a note reports the result.
void StandWithPhoto(DepthOrientation choice, DepthPhoto* photo);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_MAP_ORIENTATION_H_
