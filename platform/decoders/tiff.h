// SPDX-License-Identifier: Apache-2.0
// Decodes depth maps in TIFF files.
#ifndef STARFOCUS_PLATFORM_DECODERS_TIFF_H_
#define STARFOCUS_PLATFORM_DECODERS_TIFF_H_

#include <string>

#include "platform/file.h"
#include "platform/levels.h"
#include "platform/result.h"

namespace starfocus {

// Returns true if the bytes start with the signature of TIFF or BigTIFF files.
bool IsTiff(const Bytes& bytes);

// Decodes the first picture of a TIFF file. The picture must have one sample for each pixel: an
// integer of 8, 16, 32 or 64 bits, or a float of 16, 32 or 64 bits. The picture must consist of
// strips that are stored uncompressed or compressed by LZW, Deflate or PackBits. Requires libtiff.
// `where` and `is_matte` affect only error messages.
Result<Samples> DecodeTiff(const std::string& where, bool is_matte, const Bytes& tiff);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_DECODERS_TIFF_H_
