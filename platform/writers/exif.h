// SPDX-License-Identifier: Apache-2.0
// EXIF of a photograph, changed to what is true of a picture that was made from it.
#ifndef STARFOCUS_PLATFORM_WRITERS_EXIF_H_
#define STARFOCUS_PLATFORM_WRITERS_EXIF_H_

#include "platform/file.h"

namespace starfocus {

// Returns EXIF, a TIFF structure, with the Software tag, orientation 1 and the size set. The
// thumbnail is left out, which shows the picture as it was, and the subject unless the picture has
// its size and orientation still. Everything else stays, at its place. Empty if `exif` is no TIFF
// structure that can be followed.
Bytes EditedExif(const Bytes& exif, int width, int height);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_WRITERS_EXIF_H_
