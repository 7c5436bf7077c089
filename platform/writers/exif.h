// SPDX-License-Identifier: Apache-2.0
// EXIF of a photograph, changed to what is true of a picture that was made from it.
#ifndef STARFOCUS_PLATFORM_WRITERS_EXIF_H_
#define STARFOCUS_PLATFORM_WRITERS_EXIF_H_

#include <string>

#include "platform/file.h"

namespace starfocus {

// Sets the Software tag, orientation 1 and the size, and leaves the thumbnail out, which shows the
// picture as it was. Removes the subject unless the picture has its size and orientation still.
// Everything else stays, at its place. False, and nothing changed, where `tiff`
// is no TIFF structure that can be followed.
bool MarkEdited(const std::string& software, int width, int height, Bytes* tiff);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_WRITERS_EXIF_H_
