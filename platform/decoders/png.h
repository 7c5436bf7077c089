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

// Decodes a PNG file to 8-bit RGB and, if it has 16 bits, a pixel that is not opaque, or PQ or HLG
// (cICP), to a DeepImage (CompleteDeep). Grey is converted to RGB. DecodePng uses libpng if
// available, and otherwise stb_image. Only builds with libpng return a DeepImage, the ICC profile
// and EXIF. `where` appears only in error messages.
Result<DecodedPicture> DecodePngPixels(const std::string& where, const Bytes& png);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_DECODERS_PNG_H_
