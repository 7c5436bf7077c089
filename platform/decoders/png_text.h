// SPDX-License-Identifier: Apache-2.0
// Metadata in text chunks of PNG files: XMP, and EXIF as ImageMagick and others wrote it before the
// format had a chunk for it.
#ifndef STARFOCUS_PLATFORM_DECODERS_PNG_TEXT_H_
#define STARFOCUS_PLATFORM_DECODERS_PNG_TEXT_H_

#include <cstddef>
#include <cstdint>
#include <string>

#include "platform/file.h"

namespace starfocus {

// Sets `exif` to the TIFF structure in a tEXt or zTXt chunk of the keyword "Raw profile type exif"
// or "Raw profile type APP1"; leaves it as it is for any other chunk, or one that is malformed.
void ReadRawProfile(bool compressed, const uint8_t* data, size_t size, Bytes* exif);

// Sets `xmp` to the packet in an iTXt chunk of the keyword "XML:com.adobe.xmp"; leaves it as it is
// for any other chunk, or one that is malformed or holds more than 256 KiB compressed.
void ReadXmpText(const uint8_t* data, size_t size, std::string* xmp);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_DECODERS_PNG_TEXT_H_
