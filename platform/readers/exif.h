// SPDX-License-Identifier: Apache-2.0
// What EXIF says of a photograph that matters to refocusing it.
#ifndef STARFOCUS_PLATFORM_READERS_EXIF_H_
#define STARFOCUS_PLATFORM_READERS_EXIF_H_

#include "platform/readers/photo.h"

namespace starfocus {

// Reads photo->metadata.exif, if there is any, into `orientation`, `focal_35mm`, the subject
// (SubjectArea, else SubjectLocation), and a fact. Damaged EXIF is none: people's photos have it,
// and the picture is there. `width` and `height` are the picture's before its orientation is
// applied: where EXIF has no size of its own, it counts the subject's pixels in these.
void ReadExif(int width, int height, DepthPhoto* photo);

// The same for a picture that is not turned yet.
void ReadExif(DepthPhoto* photo);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_EXIF_H_
