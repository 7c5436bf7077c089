// SPDX-License-Identifier: Apache-2.0
// Reads and writes picture files (PNG, PPM, JPEG and WebP) as 8-bit RGB.
#ifndef STARFOCUS_PLATFORM_IMAGE_IO_H_
#define STARFOCUS_PLATFORM_IMAGE_IO_H_

#include <string>

#include "platform/file.h"
#include "platform/image.h"
#include "platform/metadata.h"
#include "platform/result.h"
#include "platform/writers/picture.h"

namespace starfocus {

// Reads a picture. The format of a picture file is detected from its content, not from its name.
// Grey and CMYK pictures are converted to RGB, and an alpha channel is ignored. The functions of
// this header support pictures of up to 2^28 pixels.
Result<Image> ReadImage(const std::string& path);

// Reads a picture with its metadata and, if the file has more than 8 bits or alpha, all its bits.
Result<DecodedPicture> ReadPicture(const std::string& path);

// Decodes a picture in memory; `where` appears only in error messages. For PNG and WebP, the
// metadata contains the profile, EXIF and the complete XMP packet. readers/jpeg_parts.h reads the
// metadata of JPEG files.
Result<DecodedPicture> DecodeImage(const std::string& where, const Bytes& bytes);

// Writes a picture in the format of the extension (writers/picture.h).
Error WriteImage(const std::string& path, const Image& image, const PictureOptions& options = {});

// Returns an error if WriteImage does not support the extension of `path`, this build lacks the
// encoder, or the folder does not exist. Call CheckImageOutput before long computations.
Error CheckImageOutput(const std::string& path);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_IMAGE_IO_H_
