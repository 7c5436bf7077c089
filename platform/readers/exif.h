// SPDX-License-Identifier: Apache-2.0
// Reads the EXIF properties of a photograph that refocusing needs.
#ifndef STARFOCUS_PLATFORM_READERS_EXIF_H_
#define STARFOCUS_PLATFORM_READERS_EXIF_H_

#include "platform/readers/photo.h"

namespace starfocus {

// Reads photo->metadata.exif, if any, into `orientation`, `focal_35mm` and the subject
// (SubjectArea, otherwise SubjectLocation), and adds a fact. Damaged EXIF is ignored, since the
// picture is usable without it. `width` and `height` are those of the picture before its
// orientation is applied. The subject's coordinates refer to them if EXIF states no size.
void ReadExif(int width, int height, DepthPhoto* photo);

// Same, with the size of photo->picture, whose orientation is not applied yet.
void ReadExif(DepthPhoto* photo);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_EXIF_H_
