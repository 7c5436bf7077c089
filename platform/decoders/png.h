// SPDX-License-Identifier: Apache-2.0
// Pixels and metadata of PNG files. image_io.cc calls it for files whose header it has checked.
#ifndef STARFOCUS_PLATFORM_DECODERS_PNG_H_
#define STARFOCUS_PLATFORM_DECODERS_PNG_H_

#include <string>

#include "platform/file.h"
#include "platform/metadata.h"
#include "platform/result.h"

namespace starfocus {

// Decodes to 8 bits of R, G, B: grey becomes RGB, 16 bits are rounded to 8, transparency is
// dropped. By libpng where the build has it, with the ICC profile and EXIF; else by stb_image,
// without any. `where` only names the file in errors.
Result<DecodedPicture> DecodePngPixels(const std::string& where, const Bytes& png);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_DECODERS_PNG_H_
