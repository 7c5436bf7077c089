// SPDX-License-Identifier: Apache-2.0
// Estimates the memory that a picture takes, from its header. Batches use the estimate to decode
// only small inputs ahead.
#ifndef STARFOCUS_PLATFORM_READERS_DECODING_MEMORY_H_
#define STARFOCUS_PLATFORM_READERS_DECODING_MEMORY_H_

#include <cstdint>

#include "platform/readers/jpeg_parts.h"

namespace starfocus {

// Returns an upper estimate of the bytes that a photo or depth picture takes while and after it is
// decoded, together with a map of the same size: 16 bytes for each pixel that its header declares,
// or 32 bytes for formats of more than 8 bits.
// Returns UINT64_MAX for formats whose header is not examined.
uint64_t DecodingBytes(Span file);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_DECODING_MEMORY_H_
