// SPDX-License-Identifier: Apache-2.0
// Picture files: PNG, PPM, JPEG and WebP to and from 8-bit RGB.
#ifndef STARFOCUS_PLATFORM_IMAGE_IO_H_
#define STARFOCUS_PLATFORM_IMAGE_IO_H_

#include <string>

#include "platform/file.h"
#include "platform/image.h"
#include "platform/metadata.h"
#include "platform/result.h"
#include "platform/writers/picture.h"

namespace starfocus {

// Reads a picture, whatever its name says, by its content. Grey and CMYK become RGB, alpha is
// dropped. Pictures may have 2^28 pixels, here and below.
Result<Image> ReadImage(const std::string& path);

// The same of bytes in memory; `where` only names them in the error. The metadata are the profile,
// EXIF and whole XMP packet of PNG and WebP files; those of JPEG files are read with the other
// segments (readers/jpeg_parts.h).
Result<DecodedPicture> DecodeImage(const std::string& where, const Bytes& bytes);

// Writes by extension (writers/picture.h).
Error WriteImage(const std::string& path, const Image& image, const PictureOptions& options = {});

// Whether WriteImage knows the extension of `path`, this program was built with what writes it, and
// its folder exists; to be asked before long work.
Error CheckImageOutput(const std::string& path);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_IMAGE_IO_H_
