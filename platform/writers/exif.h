// SPDX-License-Identifier: Apache-2.0
// Edits the EXIF of a photograph to match a picture that was made from it.
#ifndef STARFOCUS_PLATFORM_WRITERS_EXIF_H_
#define STARFOCUS_PLATFORM_WRITERS_EXIF_H_

#include "platform/file.h"

namespace starfocus {

// Returns a copy of `exif`, a TIFF structure, with a new Software tag, orientation 1 and the size
// `width` x `height`. Removes the thumbnail, since it shows the original picture. Removes the
// position of the subject unless the picture still has its original size and orientation. All other
// EXIF data keeps its position. Returns an empty result if `exif` is not a valid TIFF structure.
Bytes EditedExif(const Bytes& exif, int width, int height);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_WRITERS_EXIF_H_
