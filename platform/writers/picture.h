// SPDX-License-Identifier: Apache-2.0
// Encodes pictures in the format that the extension of their file name selects.
#ifndef STARFOCUS_PLATFORM_WRITERS_PICTURE_H_
#define STARFOCUS_PLATFORM_WRITERS_PICTURE_H_

#include <string>

#include "platform/file.h"
#include "platform/image.h"
#include "platform/metadata.h"
#include "platform/result.h"
#include "platform/row_gate.h"
#include "platform/writers/png.h"

namespace starfocus {

struct PictureOptions {
  int quality = 95;  // quality of JPEG and WebP pictures, 1 to 100
  Metadata metadata;
  PngSize png_size = PngSize::kQuick;
  Bytes alphas = {};  // alpha of each pixel of a WebP picture; empty: opaque
};

// List of the extensions that EncodePicture supports, for use in error messages.
inline constexpr char kPictureExtensions[] = ".png, .ppm, .jpg or .webp";

// Returns true if EncodePicture supports `extension`, in lower case with its dot, for example
// ".jpeg".
bool IsPictureExtension(const std::string& extension);

// Encodes a picture in the format that the extension of `path` selects (standard_stream.h). `path`
// selects the format and appears in error messages, but EncodePicture does not write a file. PPM
// files contain no metadata. If `rows` is not null, another thread computes the picture, and each
// row is read after `rows` has declared it finished.
Result<Bytes> EncodePicture(const std::string& path, const Image& image,
                            const PictureOptions& options, RowGate* rows = nullptr);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_WRITERS_PICTURE_H_
