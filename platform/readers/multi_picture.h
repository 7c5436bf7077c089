// SPDX-License-Identifier: Apache-2.0
// Lists the pictures that follow the first picture of a JPEG file. The index of the Multi-Picture
// Format (CIPA DC-007) states the type of each picture. Editors move or remove the multi-picture
// index, so the module searches the file for pictures as well.
#ifndef STARFOCUS_PLATFORM_READERS_MULTI_PICTURE_H_
#define STARFOCUS_PLATFORM_READERS_MULTI_PICTURE_H_

#include <cstdint>
#include <vector>

#include "platform/readers/jpeg_parts.h"

namespace starfocus {

struct MultiPicture {
  Span file;             // JPEG file that contains the picture.
  JpegParts parts;       // Segments of the JPEG file.
  bool indexed = false;  // True if the index contains the position of this picture.
  uint32_t type = 0;     // Type in the index: 0x020002 is a view of a stereo pair, 0 is unknown.
};

struct MultiPictures {
  std::vector<MultiPicture> pictures;
  bool missing = false;  // True if a picture that the index lists is truncated or missing.
};

// Lists the complete pictures that follow the first picture of a JPEG file, at most 64.
MultiPictures ListMultiPictures(Span file, const JpegParts& parts);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_MULTI_PICTURE_H_
