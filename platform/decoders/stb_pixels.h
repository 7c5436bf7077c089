// SPDX-License-Identifier: Apache-2.0
// What the decoders by stb_image share.
#ifndef STARFOCUS_PLATFORM_DECODERS_STB_PIXELS_H_
#define STARFOCUS_PLATFORM_DECODERS_STB_PIXELS_H_

#include <string>

#include "platform/file.h"
#include "platform/image.h"
#include "platform/result.h"

namespace starfocus {

// The error of a file whose parts are not all there or do not fit together (container.h).
Error CheckStbContainer(const std::string& where, const Bytes& bytes);

// Samples of the picture, `channels` a pixel, in memory of the StbMemory that lives; null if
// stb_image fails. `image` gets the size alone.
const uint8_t* LoadStb(const Bytes& bytes, int channels, Image* image);

// The error after a null LoadStb.
Error StbFailed(const std::string& where);

// Decodes a PNG without a palette, or a JPEG.
Result<Image> DecodeStb(const std::string& where, const Bytes& bytes);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_DECODERS_STB_PIXELS_H_
