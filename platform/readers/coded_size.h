// SPDX-License-Identifier: Apache-2.0
// Reads picture sizes from the headers of HEVC and AV1 data, without decoding it.
#ifndef STARFOCUS_PLATFORM_READERS_CODED_SIZE_H_
#define STARFOCUS_PLATFORM_READERS_CODED_SIZE_H_

#include <cstdint>

#include "platform/readers/jpeg_parts.h"

namespace starfocus {

struct CodedSize {
  int64_t width = 0, height = 0;  // 0: not found
};

// Returns the largest size of all sequence parameter sets in a decoder configuration record (hvcC)
// and at the start of a picture's data.
CodedSize HevcSize(Span configuration, const Bytes& head);

// Returns the largest size of all AV1 sequence headers, in the configuration (av1C) and at the
// start of a picture's data.
CodedSize Av1Size(Span configuration, const Bytes& head);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_CODED_SIZE_H_
