// SPDX-License-Identifier: Apache-2.0
// Reads the EXIF properties of a photograph that refocusing uses.
#ifndef STARFOCUS_PLATFORM_READERS_EXIF_H_
#define STARFOCUS_PLATFORM_READERS_EXIF_H_

#include "platform/readers/photo.h"

namespace starfocus {

// Reads photo->metadata.exif, if any, into `orientation`, `focal_35mm` and the subject
// (SubjectArea, otherwise SubjectLocation), and adds an entry to photo->facts. Ignores damaged
// EXIF, since the picture is usable without EXIF. `width` and `height` are the size of the picture
// before its orientation is applied. The coordinates of the subject refer to `width` and `height`
// if EXIF states no size.
void ReadExif(int width, int height, DepthPhoto* photo);

// Reads EXIF with the size of photo->picture. The caller must not have applied the EXIF orientation
// to photo->picture yet.
void ReadExif(DepthPhoto* photo);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_EXIF_H_
