// SPDX-License-Identifier: Apache-2.0
// Normalizes EXIF data from files of several formats.
#ifndef STARFOCUS_PLATFORM_DECODERS_EXIF_BYTES_H_
#define STARFOCUS_PLATFORM_DECODERS_EXIF_BYTES_H_

#include "platform/file.h"

namespace starfocus {

// Removes the header "Exif\0\0" from `exif`. JPEG files require the header "Exif\0\0", and some
// programs write the header to PNG and WebP files. Clears `exif` if the bytes after the header are
// not a TIFF structure.
void TrimExif(Bytes* exif);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_DECODERS_EXIF_BYTES_H_
