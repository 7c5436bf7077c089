// SPDX-License-Identifier: Apache-2.0
// Sizes of pictures that decoders refuse before they allocate anything.
#ifndef STARFOCUS_PLATFORM_DECODERS_LIMITS_H_
#define STARFOCUS_PLATFORM_DECODERS_LIMITS_H_

#include <cstdint>
#include <string>

#include "platform/file.h"
#include "platform/result.h"

namespace starfocus {

// The error of a size outside of 1 to kMaxPictureSize, or of more than 2^28 pixels.
Error CheckPictureSize(const std::string& where, int64_t width, int64_t height);

// Returns true if a JPEG file of so many bytes can hold a picture of this size: with Huffman codes
// a block of data takes a bit at least, and where each component is subsampled another way there is
// one for every 8 by 32 pixels. Arithmetic coding is taken to need a sixteenth of it.
bool JpegCanHold(size_t bytes, bool arithmetic, int64_t width, int64_t height);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_DECODERS_LIMITS_H_
