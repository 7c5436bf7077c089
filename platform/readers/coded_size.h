// SPDX-License-Identifier: Apache-2.0
// Reads picture sizes from the headers of HEVC and AV1 data, without decoding the pictures.
#ifndef STARFOCUS_PLATFORM_READERS_CODED_SIZE_H_
#define STARFOCUS_PLATFORM_READERS_CODED_SIZE_H_

#include <cstdint>

#include "platform/readers/jpeg_parts.h"

namespace starfocus {

struct CodedSize {
  int64_t width = 0, height = 0;  // 0: not found
};

// Returns the largest picture size in the sequence parameter sets of a decoder configuration record
// (hvcC) and of the start of a picture's data.
CodedSize HevcSize(Span configuration, const Bytes& head);

// Returns the largest picture size in the AV1 sequence headers of the configuration (av1C) and of
// the start of a picture's data.
CodedSize Av1Size(Span configuration, const Bytes& head);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_CODED_SIZE_H_
