// SPDX-License-Identifier: Apache-2.0
// Whether a depth picture is turned with its photo or stands upright already, and whether its
// proportions are those of the photo.
#ifndef STARFOCUS_PLATFORM_READERS_MAP_ORIENTATION_H_
#define STARFOCUS_PLATFORM_READERS_MAP_ORIENTATION_H_

#include "platform/readers/photo.h"

namespace starfocus {

// Whether a map of that size can be one of a picture of that size: they differ by rounding, or by
// 3 %, as much as networks round to whole blocks.
bool HasSameProportions(const FloatMap& map, int width, int height);

// Applies EXIF's orientation to the picture alone if the map of a depth picture, photo->map, stands
// upright already. Without a choice the proportions decide, or else the edges of both, which a note
// reports.
void StandWithPhoto(DepthOrientation choice, DepthPhoto* photo);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_MAP_ORIENTATION_H_
