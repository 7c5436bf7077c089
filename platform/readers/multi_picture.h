// SPDX-License-Identifier: Apache-2.0
// The pictures behind the first one of a JPEG file, and what the Multi-Picture Format's index (CIPA
// DC-007) says of them. Editors move or drop the index, so that the pictures themselves are looked
// for.
#ifndef STARFOCUS_PLATFORM_READERS_MULTI_PICTURE_H_
#define STARFOCUS_PLATFORM_READERS_MULTI_PICTURE_H_

#include <cstdint>
#include <vector>

#include "platform/readers/jpeg_parts.h"

namespace starfocus {

struct MultiPicture {
  Span file;             // the JPEG file of this picture
  JpegParts parts;       // its segments
  bool indexed = false;  // the index has its place
  uint32_t type = 0;     // by the index: 0x020002 is one of a stereo pair, 0 unknown
};

struct MultiPictures {
  std::vector<MultiPicture> pictures;
  bool missing = false;  // the index names a picture that is cut off or not there
};

// Lists the whole JPEG files behind the first picture, 64 at most.
MultiPictures ListMultiPictures(Span file, const JpegParts& parts);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_MULTI_PICTURE_H_
