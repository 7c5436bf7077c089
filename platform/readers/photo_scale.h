// SPDX-License-Identifier: Apache-2.0
// Converts a photograph and a map of any size and meaning to a light field of one view.
#ifndef STARFOCUS_PLATFORM_READERS_PHOTO_SCALE_H_
#define STARFOCUS_PLATFORM_READERS_PHOTO_SCALE_H_

#include "platform/light_field.h"
#include "platform/readers/photo.h"
#include "platform/result.h"

namespace starfocus {

// Resizes a map by bilinear interpolation. Unknown values of the map (NaN) have no weight.
FloatMap Resize(const FloatMap& map, int width, int height);

// Applies the EXIF orientation of the photo, and converts the map to disparities in pixels of the
// picture. With the resulting disparities, an aperture of radius 1 is a lens of f/1 on full frame
// (docs/formats.md). Moves the picture and the map to the light field. The map keeps its size.
// Converts photo->focus_value to a disparity as well.
Result<LightField> MakePhotoField(const std::string& where, DepthPhoto* photo);

// Resizes the disparity map of a one-view light field to the size of the view.
void FitMap(LightField* light_field);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_PHOTO_SCALE_H_
