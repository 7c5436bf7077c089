// SPDX-License-Identifier: Apache-2.0
// JPEG files.
#ifndef STARFOCUS_PLATFORM_WRITERS_JPEG_H_
#define STARFOCUS_PLATFORM_WRITERS_JPEG_H_

#include <string>

#include "platform/image.h"
#include "platform/metadata.h"
#include "platform/result.h"

namespace starfocus {

// The pixels alone, with colours at full resolution from quality 90 on; quality
// is 1 to 100. By libjpeg-turbo where the build has it, else by stb_image_write. `path` only names
// the file in errors, here and below.
Result<Bytes> EncodeJpegPixels(const std::string& path, const Image& image, int quality);

// A file with `segments` (jpeg_segments.h), and with metadata changed to what is true of the
// picture (exif.h). EXIF that cannot be followed is left out, and metadata that has no room.
Result<Bytes> EncodeJpeg(const std::string& path, const Image& image, int quality,
                         const Metadata& metadata, const Bytes& segments);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_WRITERS_JPEG_H_
