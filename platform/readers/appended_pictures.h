// SPDX-License-Identifier: Apache-2.0
// Lists the pictures that follow the first picture of a JPEG file: JPEG and PNG files without gaps
// or with other data between them. Videos of motion photos are skipped as a whole.
#ifndef STARFOCUS_PLATFORM_READERS_APPENDED_PICTURES_H_
#define STARFOCUS_PLATFORM_READERS_APPENDED_PICTURES_H_

#include <vector>

#include "platform/readers/jpeg_parts.h"

namespace starfocus {

struct AppendedPicture {
  Span file;  // The whole JPEG or PNG file.
  bool is_png = false;
  bool is_gain_map = false;  // True if the segments of the picture describe a gain map.
  JpegParts parts = {};      // Segments of a JPEG file; empty for PNG.
};

// Lists the complete pictures from byte `begin` of a file on, in the order of the file, at most 64.
std::vector<AppendedPicture> ListAppendedPictures(Span file, size_t begin);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_APPENDED_PICTURES_H_
