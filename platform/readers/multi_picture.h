// SPDX-License-Identifier: Apache-2.0
// Applies the index of the Multi-Picture Format (CIPA DC-007), which states the types of pictures,
// to the pictures that follow the first picture of a JPEG file. Editors move or remove the
// multi-picture index, so the pictures were found without the index (appended_pictures.h).
#ifndef STARFOCUS_PLATFORM_READERS_MULTI_PICTURE_H_
#define STARFOCUS_PLATFORM_READERS_MULTI_PICTURE_H_

#include <cstdint>
#include <vector>

#include "platform/readers/appended_pictures.h"

namespace starfocus {

struct MultiPicture : AppendedPicture {
  bool indexed = false;  // True if the index contains the position of this picture.
  uint32_t type = 0;     // Type in the index: 0x020002 is a view of a stereo pair, 0 is unknown.
};

struct MultiPictures {
  std::vector<MultiPicture> pictures;
  bool missing = false;  // True if a picture that the index lists is truncated or missing.
};

// Returns the JPEG pictures of `appended`, which follow the first picture of `file`. `parts` are
// the segments of the first picture.
MultiPictures ListMultiPictures(Span file, const JpegParts& parts,
                                std::vector<AppendedPicture> appended);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_MULTI_PICTURE_H_
