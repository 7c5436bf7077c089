// SPDX-License-Identifier: Apache-2.0
// Limits on picture sizes, which decoders check before they allocate memory.
#ifndef STARFOCUS_PLATFORM_DECODERS_LIMITS_H_
#define STARFOCUS_PLATFORM_DECODERS_LIMITS_H_

#include <cstdint>
#include <string>

#include "platform/file.h"
#include "platform/result.h"

namespace starfocus {

// Returns an error unless width and height are in [1, kMaxPictureSize] and the area is at most 2^28
// pixels.
Error CheckPictureSize(const std::string& where, int64_t width, int64_t height);

// Returns true if a JPEG file of `bytes` bytes can contain a picture of `width` x `height` pixels.
// Each Huffman-coded block takes at least one bit. With the strongest chroma subsampling, a JPEG
// file has one block per 8 by 32 pixels. With arithmetic coding, a block is assumed to take at
// least a sixteenth of a bit.
bool JpegCanHold(size_t bytes, bool arithmetic, int64_t width, int64_t height);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_DECODERS_LIMITS_H_
