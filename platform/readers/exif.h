// SPDX-License-Identifier: Apache-2.0
// What EXIF says of a photograph that matters to refocusing it.
#ifndef STARFOCUS_PLATFORM_READERS_EXIF_H_
#define STARFOCUS_PLATFORM_READERS_EXIF_H_

#include "platform/readers/photo.h"

namespace starfocus {

// Reads photo->metadata.exif, if there is any, into `orientation`, `focal_35mm`, and a fact.
// Damaged EXIF is none: people's photos have it, and the picture is there.
void ReadExif(DepthPhoto* photo);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_EXIF_H_
