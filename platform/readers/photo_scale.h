// SPDX-License-Identifier: Apache-2.0
// Converts a photograph and a map of any size and meaning to a light field of one view.
#ifndef STARFOCUS_PLATFORM_READERS_PHOTO_SCALE_H_
#define STARFOCUS_PLATFORM_READERS_PHOTO_SCALE_H_

#include "platform/light_field.h"
#include "platform/readers/photo.h"
#include "platform/result.h"
#include "platform/runner.h"

namespace starfocus {

// Resizes a map by bilinear interpolation. Unknown values of the map (NaN) have no weight. In all
// functions of this header, the workers of `runner` resize parts of the map; if `runner` is null,
// the calling thread resizes the map.
FloatMap Resize(const FloatMap& map, int width, int height, ThreadRunner* runner = nullptr);

// Applies the EXIF orientation of the photo, and converts the map to disparities in pixels of the
// picture. With the resulting disparities, an aperture of radius 1 is a lens of f/1 on full frame
// (docs/formats.md). Moves the picture and the map to the light field. The map keeps its size.
// Converts photo->focus_value to a disparity as well. Measures photo->survey. If options.clip is
// not null, its figures determine the near end and the scale instead of the figures of the map.
//
// A photo without a map must have a matte. Its light field has two surfaces at the ends of the
// scale of maps without distances: the subject and the background. options.floor selects a
// background that comes nearer towards the lower edge. Map and coverage have the size of the
// picture.
//
// The matte of a photo with a map stays in photo->matte. A matte that CheckMatte (matte.h) rejects
// is removed, with a note, if the photo has a map.
Result<LightField> MakePhotoField(const std::string& where, DepthPhoto* photo,
                                  const DepthOptions& options = {});

// Returns the disparity of the subject in the light field of a photo without a map.
double AssumedSubject(const Image& picture);

// Resizes the disparity map of a one-view light field to the size of the view.
void FitMap(LightField* light_field, ThreadRunner* runner = nullptr);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_PHOTO_SCALE_H_
