// SPDX-License-Identifier: Apache-2.0
// Functions that the decoders based on stb_image share.
#ifndef STARFOCUS_PLATFORM_DECODERS_STB_PIXELS_H_
#define STARFOCUS_PLATFORM_DECODERS_STB_PIXELS_H_

#include <string>

#include "platform/file.h"
#include "platform/image.h"
#include "platform/result.h"

namespace starfocus {

// Returns an error if a PNG or JPEG file is truncated or damaged (container.h).
Error CheckStbContainer(const std::string& where, const Bytes& bytes);

// Decodes a picture with `channels` samples per pixel. The current StbMemory owns the returned
// pixels. Returns null if stb_image fails. Sets the width and height of `image`, but not its
// pixels.
const uint8_t* LoadStb(const Bytes& bytes, int channels, Image* image);

// Returns the error to report when LoadStb returns null.
Error StbFailed(const std::string& where);

// Decodes a JPEG file, or a PNG file without a palette.
Result<Image> DecodeStb(const std::string& where, const Bytes& bytes);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_DECODERS_STB_PIXELS_H_
