// SPDX-License-Identifier: Apache-2.0
// Pixels of JPEG files.
#ifndef STARFOCUS_PLATFORM_DECODERS_JPEG_H_
#define STARFOCUS_PLATFORM_DECODERS_JPEG_H_

#include <string>

#include "platform/file.h"
#include "platform/image.h"
#include "platform/result.h"

namespace starfocus {

// Decodes to RGB: grey and CMYK become RGB, without a colour profile. By libjpeg-turbo where the
// build has it, else by stb_image, which reads no arithmetic coding. A truncated file is an error.
// `where` only names the file in errors.
Result<Image> DecodeJpeg(const std::string& where, const Bytes& jpeg);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_DECODERS_JPEG_H_
