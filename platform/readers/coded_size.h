// SPDX-License-Identifier: Apache-2.0
// Sizes of pictures in the headers of HEVC and AV1.
#ifndef STARFOCUS_PLATFORM_READERS_CODED_SIZE_H_
#define STARFOCUS_PLATFORM_READERS_CODED_SIZE_H_

#include <cstdint>

#include "platform/readers/jpeg_parts.h"

namespace starfocus {

struct CodedSize {
  int64_t width = 0, height = 0;  // 0: none that can be read
};

// The largest size of the sequence parameter sets in a decoder configuration record (hvcC) and at
// the beginning of a picture's data.
CodedSize HevcSize(Span configuration, const Bytes& head);

// The largest size of the sequence headers of AV1 (av1C).
CodedSize Av1Size(Span configuration, const Bytes& head);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_CODED_SIZE_H_
