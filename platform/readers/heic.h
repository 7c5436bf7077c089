// SPDX-License-Identifier: Apache-2.0
// HEIF files (HEIC, AVIF) with a depth map as an auxiliary picture (ISO/IEC 23008-12), through
// libheif.
#ifndef STARFOCUS_PLATFORM_READERS_HEIC_H_
#define STARFOCUS_PLATFORM_READERS_HEIC_H_

#include <string>

#include "platform/readers/jpeg_parts.h"
#include "platform/readers/photo.h"
#include "platform/result.h"

namespace starfocus {

// Whether the bytes begin as a file of that family does.
bool IsHeif(Span file);

// Reads the primary picture, and its map unless it has none: photo->map is empty then. Turned as
// the file says; `near` counts only where it does not say which end of the map is near.
Result<DepthPhoto> ReadHeif(const std::string& where, Span file, Near near);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_HEIC_H_
