// SPDX-License-Identifier: Apache-2.0
// Adds pictures of more than 8 bits to photos, and describes the light of pictures for users.
#ifndef STARFOCUS_PLATFORM_READERS_DEEP_PHOTO_H_
#define STARFOCUS_PLATFORM_READERS_DEEP_PHOTO_H_

#include "platform/light_field.h"
#include "platform/metadata.h"
#include "platform/readers/photo.h"

namespace starfocus {

// Moves the picture, its metadata and, if it has one, its DeepImage to a photo. If the 8-bit
// picture is a rendition in sRGB of brighter light, changes its metadata accordingly and adds a
// note about clipped light. Call the function before ChooseProfile.
void TakePicture(DecodedPicture picture, DepthPhoto* photo);

// Returns facts about the samples of loaded views: bits, transfer, primaries, alpha, and the
// headroom, which is the brightest light relative to white, if it may exceed white. `metadata`
// describes views of 8 bits, and `gain_map` the light of their file beyond white.
Facts FactsOfLight(const LightField& light_field, const Metadata& metadata,
                   const GainMap& gain_map);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_DEEP_PHOTO_H_
