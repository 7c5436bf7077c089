// SPDX-License-Identifier: Apache-2.0
// Writes JPEG files.
#ifndef STARFOCUS_PLATFORM_WRITERS_JPEG_H_
#define STARFOCUS_PLATFORM_WRITERS_JPEG_H_

#include <cstdint>
#include <string>

#include "platform/image.h"
#include "platform/metadata.h"
#include "platform/result.h"
#include "platform/row_gate.h"

namespace starfocus {

// Rows of samples of 8 bits without padding, of one channel (grey) or three (R, G and B).
struct Samples8 {
  int width, height, channels;
  const uint8_t* samples;
};

// Encodes the pixels without metadata. `quality` is 1 to 100. If the quality is 90 or more, chroma
// is stored at full resolution. Uses libjpeg-turbo if available, otherwise stb_image_write. In all
// functions of this header, `path` appears only in error messages. If `rows` is not null, another
// thread computes the picture, and each row is read after `rows` has declared it finished.
Result<Bytes> EncodeJpegPixels(const std::string& path, const Samples8& picture, int quality,
                               RowGate* rows);

// Encodes a JPEG file with `segments` (jpeg_segments.h) and `metadata`, whose EXIF is edited to
// match the picture (exif.h). Omits malformed EXIF, and metadata that exceeds the limits of the
// format.
Result<Bytes> EncodeJpeg(const std::string& path, const Image& image, int quality,
                         const Metadata& metadata, const Bytes& segments, RowGate* rows = nullptr);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_WRITERS_JPEG_H_
