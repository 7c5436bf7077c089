// SPDX-License-Identifier: Apache-2.0
// Writes HEIF files: AVIF and HEIC.
#ifndef STARFOCUS_PLATFORM_WRITERS_HEIF_H_
#define STARFOCUS_PLATFORM_WRITERS_HEIF_H_

#include <string>

#include "platform/file.h"
#include "platform/image.h"
#include "platform/metadata.h"
#include "platform/result.h"

namespace starfocus {

// Encodes codes of 16 bits as 10 bits (AVIF by libheif before 1.16: 12 bits), with alpha if the
// picture has it, by AV1 or HEVC. Writes the code points of metadata.colours, otherwise the ICC
// profile, and EXIF edited to match the picture. `quality` is from 1 to 100. Requires libheif with
// an encoder. `path` appears only in error messages.
Result<Bytes> EncodeHeif(const std::string& path, const DeepImage& image, const Metadata& metadata,
                         int quality, bool is_avif);

// Returns an error if this build lacks libheif, or libheif lacks the encoder.
Error CheckHeifEncoder(const std::string& path, bool is_avif);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_WRITERS_HEIF_H_
