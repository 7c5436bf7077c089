// SPDX-License-Identifier: Apache-2.0
// Reads picture sizes from the headers of HEVC and AV1 data, without decoding the pictures.
#ifndef STARFOCUS_PLATFORM_READERS_CODED_SIZE_H_
#define STARFOCUS_PLATFORM_READERS_CODED_SIZE_H_

#include <cstdint>

#include "platform/readers/jpeg_parts.h"

namespace starfocus {

struct CodedSize {
  int64_t width = 0, height = 0;  // size in pixels; 0 if no size was found
};

// Returns the largest picture size in HEVC sequence parameter sets. Searches the decoder
// configuration record (hvcC) and `head`, the first bytes of the picture's data.
CodedSize HevcSize(Span configuration, const Bytes& head);

// Returns the largest picture size in AV1 sequence headers. Searches the configuration (av1C) and
// `head`, the first bytes of the picture's data.
CodedSize Av1Size(Span configuration, const Bytes& head);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_CODED_SIZE_H_
