// SPDX-License-Identifier: Apache-2.0
// Pictures as files of the format that their names tell.
#ifndef STARFOCUS_PLATFORM_WRITERS_PICTURE_H_
#define STARFOCUS_PLATFORM_WRITERS_PICTURE_H_

#include <string>

#include "platform/image.h"
#include "platform/metadata.h"
#include "platform/result.h"
#include "platform/writers/png.h"

namespace starfocus {

struct PictureOptions {
  int quality = 95;  // 1 to 100, of JPEG and WebP
  Metadata metadata;
  PngSize png_size = PngSize::kQuick;
};

// The names that EncodePicture knows, for a sentence.
inline constexpr char kPictureExtensions[] = ".png, .ppm, .jpg or .webp";

// Whether `extension`, in lower case with its dot, is one of them, or .jpeg.
bool IsPictureExtension(const std::string& extension);

// Encodes by the extension of `path` (standard_stream.h), which else names the file in errors. PPM
// has no place for metadata.
Result<Bytes> EncodePicture(const std::string& path, const Image& image,
                            const PictureOptions& options);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_WRITERS_PICTURE_H_
