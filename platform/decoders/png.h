// SPDX-License-Identifier: Apache-2.0
// Decodes the pixels and metadata of PNG files. The module image_io.cc checks the PNG header before
// it calls this module.
#ifndef STARFOCUS_PLATFORM_DECODERS_PNG_H_
#define STARFOCUS_PLATFORM_DECODERS_PNG_H_

#include <string>

#include "platform/file.h"
#include "platform/metadata.h"
#include "platform/result.h"

namespace starfocus {

// Decodes a PNG file to 8-bit RGB. Grey is converted to RGB, 16 bits are rounded to 8, and
// transparency is ignored. DecodePng uses libpng if available, and otherwise stb_image. Only builds
// with libpng return the ICC profile and EXIF. `where` appears only in error messages.
Result<DecodedPicture> DecodePngPixels(const std::string& where, const Bytes& png);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_DECODERS_PNG_H_
