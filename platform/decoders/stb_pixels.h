// SPDX-License-Identifier: Apache-2.0
// Functions that the decoders based on stb_image share.
#ifndef STARFOCUS_PLATFORM_DECODERS_STB_PIXELS_H_
#define STARFOCUS_PLATFORM_DECODERS_STB_PIXELS_H_

#include <string>

#include "platform/file.h"
#include "platform/image.h"
#include "platform/result.h"

namespace starfocus {

// Returns an error if the parts of a file are incomplete or inconsistent (container.h).
Error CheckStbContainer(const std::string& where, const Bytes& bytes);

// Decodes a picture with `channels` samples per pixel. The current StbMemory owns the returned
// pixels. Returns null if stb_image fails. Sets only the size of `image`.
const uint8_t* LoadStb(const Bytes& bytes, int channels, Image* image);

// Returns the error after LoadStb has returned null.
Error StbFailed(const std::string& where);

// Decodes a PNG without a palette, or a JPEG.
Result<Image> DecodeStb(const std::string& where, const Bytes& bytes);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_DECODERS_STB_PIXELS_H_
