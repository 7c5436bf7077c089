// SPDX-License-Identifier: Apache-2.0
// Adds pictures of more than 8 bits to photos.
#ifndef STARFOCUS_PLATFORM_READERS_DEEP_PHOTO_H_
#define STARFOCUS_PLATFORM_READERS_DEEP_PHOTO_H_

#include "platform/metadata.h"
#include "platform/readers/photo.h"

namespace starfocus {

// Moves the picture, its metadata and, if it has one, its DeepImage to a photo. Adds facts about
// the DeepImage: bits, transfer, primaries, alpha, and the headroom, which is the brightest light
// relative to white. If the 8-bit picture
// is a rendition in sRGB of brighter light, changes its metadata accordingly and adds a note about
// clipped light. Call the function before ChooseProfile.
void TakePicture(DecodedPicture picture, DepthPhoto* photo);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_DEEP_PHOTO_H_
