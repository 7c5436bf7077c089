// SPDX-License-Identifier: Apache-2.0
// Decides whether the orientation in EXIF applies to a depth picture or a matte, or only to its
// photo. Compares the proportions of such a picture with the proportions of its photo.
#ifndef STARFOCUS_PLATFORM_READERS_MAP_ORIENTATION_H_
#define STARFOCUS_PLATFORM_READERS_MAP_ORIENTATION_H_

#include <string>

#include "platform/readers/photo.h"

namespace starfocus {

// Returns true if `map` can belong to a picture of `width` x `height` pixels. The proportions of
// map and picture may differ by rounding, or by 3 % because networks round sizes to whole blocks.
bool HasSameProportions(const FloatMap& map, int width, int height);

// Returns true if `map` may be the output of a network that stretches pictures to squares: `map` is
// square, and the picture of `width` x `height` pixels is not.
bool IsStretched(const FloatMap& map, int width, int height);

// Makes a photo and `map`, which is its separate depth picture or matte, upright. `choice` states
// whether `map` is upright already. If `choice` is kUnknown, the proportions of picture and map
// decide. If the proportions fit the upright and the stored orientation, or if a matte is square,
// the edges of picture and map decide, and a note reports the result. The picture may be upright
// already, because another map or matte was read before.
void StandWithPhoto(DepthOrientation choice, bool is_matte, DepthPhoto* photo, FloatMap* map);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_MAP_ORIENTATION_H_
