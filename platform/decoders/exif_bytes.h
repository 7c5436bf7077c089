// SPDX-License-Identifier: Apache-2.0
// Normalizes EXIF that files of several formats contain.
#ifndef STARFOCUS_PLATFORM_DECODERS_EXIF_BYTES_H_
#define STARFOCUS_PLATFORM_DECODERS_EXIF_BYTES_H_

#include "platform/file.h"

namespace starfocus {

// Removes the header "Exif\0\0" of JPEG files, which some programs also write to PNG and WebP
// files. Clears `exif` if the rest is not a TIFF structure.
void TrimExif(Bytes* exif);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_DECODERS_EXIF_BYTES_H_
