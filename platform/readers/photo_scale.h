// SPDX-License-Identifier: Apache-2.0
// From a photograph and a map of any size and meaning to a light field of one view.
#ifndef STARFOCUS_PLATFORM_READERS_PHOTO_SCALE_H_
#define STARFOCUS_PLATFORM_READERS_PHOTO_SCALE_H_

#include "platform/light_field.h"
#include "platform/readers/photo.h"
#include "platform/result.h"

namespace starfocus {

// The map at another size: the mean of the four values around each pixel's middle, weighted by how
// near they are; unknown ones count nothing.
FloatMap Resize(const FloatMap& map, int width, int height);

// Turns the photo upright and makes the map's values disparities of the picture such that an
// aperture of radius 1 is a lens of f/1 on full frame (docs/formats.md). The light field takes over
// picture and map, which keeps its own size; photo->focus_value becomes a disparity, too.
Result<LightField> MakePhotoField(const std::string& where, DepthPhoto* photo);

// Brings the map of a photo to the picture's size.
void FitMap(LightField* light_field);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_PHOTO_SCALE_H_
