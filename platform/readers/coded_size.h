// SPDX-License-Identifier: Apache-2.0
// Sizes of pictures in the headers of HEVC and AV1.
#ifndef STARFOCUS_PLATFORM_READERS_CODED_SIZE_H_
#define STARFOCUS_PLATFORM_READERS_CODED_SIZE_H_

#include <cstdint>

#include "platform/readers/jpeg_parts.h"

namespace starfocus {

// The largest size of the sequence parameter sets in a decoder configuration record (hvcC) and at
// the beginning of a picture's data. False if there is none that can be read.
bool HevcSize(Span configuration, const Bytes& head, int64_t* width, int64_t* height);

// The same of the sequence headers of AV1 (av1C).
bool Av1Size(Span configuration, const Bytes& head, int64_t* width, int64_t* height);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_CODED_SIZE_H_
