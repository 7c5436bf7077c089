// SPDX-License-Identifier: Apache-2.0
// EXIF as files of several formats hold it.
#ifndef STARFOCUS_PLATFORM_DECODERS_EXIF_BYTES_H_
#define STARFOCUS_PLATFORM_DECODERS_EXIF_BYTES_H_

#include "platform/file.h"

namespace starfocus {

// Removes the header "Exif\0\0" of JPEG files, which some programs leave in PNG and WebP files;
// empties `exif` if what is left is no TIFF structure.
void TrimExif(Bytes* exif);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_DECODERS_EXIF_BYTES_H_
