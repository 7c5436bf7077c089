// SPDX-License-Identifier: Apache-2.0
// Decodes depth maps and pictures in TIFF files.
#ifndef STARFOCUS_PLATFORM_DECODERS_TIFF_H_
#define STARFOCUS_PLATFORM_DECODERS_TIFF_H_

#include <string>

#include "platform/file.h"
#include "platform/levels.h"
#include "platform/metadata.h"
#include "platform/result.h"

namespace starfocus {

// Returns true if the bytes start with the signature of TIFF or BigTIFF files.
bool IsTiff(const Bytes& bytes);

// Decodes the first picture of a TIFF file. The picture must have one sample for each pixel: an
// integer of 8, 16, 32 or 64 bits, or a float of 16, 32 or 64 bits. The picture must consist of
// strips that are stored uncompressed or compressed by LZW, Deflate or PackBits. Requires libtiff.
// `where` and `is_matte` affect only error messages.
Result<Samples> DecodeTiff(const std::string& where, bool is_matte, const Bytes& tiff);

// Decodes the first picture of a TIFF file: grey or RGB, with alpha if the file has it, of integers
// of 8 or 16 bits, or of floats of 16 or 32 bits, which are linear light, are rounded to half
// floats, and become half floats of a DeepImage. The picture must consist of strips as for
// DecodeTiff. Rejects raw files. Reads the ICC profile and XMP. Requires libtiff.
Result<DecodedPicture> DecodeTiffPicture(const std::string& where, const Bytes& tiff);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_DECODERS_TIFF_H_
