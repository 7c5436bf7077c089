// SPDX-License-Identifier: Apache-2.0
// Reads metadata in text chunks of PNG files: XMP and EXIF. ImageMagick and other programs wrote
// EXIF as text before the PNG format had an EXIF chunk.
#ifndef STARFOCUS_PLATFORM_DECODERS_PNG_TEXT_H_
#define STARFOCUS_PLATFORM_DECODERS_PNG_TEXT_H_

#include <cstddef>
#include <cstdint>
#include <string>

#include "platform/file.h"

namespace starfocus {

// Sets `exif` to the TIFF structure in a tEXt or zTXt chunk with the keyword "Raw profile type
// exif" or "Raw profile type APP1". Does not change `exif` if the chunk has another keyword or is
// malformed.
void ReadRawProfile(bool compressed, const uint8_t* data, size_t size, Bytes* exif);

// Sets `xmp` to the packet in an iTXt chunk with the keyword "XML:com.adobe.xmp". Does not change
// `xmp` if the chunk has another keyword, is malformed, or expands to more than 256 KiB.
void ReadXmpText(const uint8_t* data, size_t size, std::string* xmp);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_DECODERS_PNG_TEXT_H_
