// SPDX-License-Identifier: Apache-2.0
// Writes TIFF files.
#ifndef STARFOCUS_PLATFORM_WRITERS_TIFF_H_
#define STARFOCUS_PLATFORM_WRITERS_TIFF_H_

#include <string>

#include "platform/file.h"
#include "platform/image.h"
#include "platform/metadata.h"
#include "platform/result.h"

namespace starfocus {

// Encodes codes of 16 bits, with straight alpha if the picture has it, compressed by Deflate after
// the horizontal predictor. Writes the ICC profile and XMP. Requires libtiff. `path` appears only
// in error messages.
Result<Bytes> EncodeTiff(const std::string& path, const DeepImage& image, const Metadata& metadata);

// Returns an error if this build lacks libtiff.
Error CheckTiffEncoder(const std::string& path);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_WRITERS_TIFF_H_
