// SPDX-License-Identifier: Apache-2.0
// Decodes the pixels of JPEG files.
#ifndef STARFOCUS_PLATFORM_DECODERS_JPEG_H_
#define STARFOCUS_PLATFORM_DECODERS_JPEG_H_

#include <string>

#include "platform/file.h"
#include "platform/image.h"
#include "platform/result.h"

namespace starfocus {

// Decodes a JPEG file to RGB. Grey and CMYK pictures are converted to RGB without a colour profile.
// Uses libjpeg-turbo if available, otherwise stb_image, which does not support arithmetic coding. A
// truncated file is an error. `where` appears only in error messages.
Result<Image> DecodeJpeg(const std::string& where, const Bytes& jpeg);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_DECODERS_JPEG_H_
