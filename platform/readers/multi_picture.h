// SPDX-License-Identifier: Apache-2.0
// The Multi-Picture Format (CIPA DC-007): an index in a JPEG file of those that follow it.
#ifndef STARFOCUS_PLATFORM_READERS_MULTI_PICTURE_H_
#define STARFOCUS_PLATFORM_READERS_MULTI_PICTURE_H_

#include <string>
#include <vector>

#include "platform/readers/jpeg_parts.h"

namespace starfocus {

// The pictures behind the first one that the index names, 64 at most. None without an index.
std::string ListMultiPictures(const std::string& where, Span file, const JpegParts& parts,
                              std::vector<Span>* pictures);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_MULTI_PICTURE_H_
