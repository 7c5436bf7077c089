// SPDX-License-Identifier: Apache-2.0
// Reads HEIF files (HEIC, AVIF) that contain a depth map as an auxiliary picture (ISO/IEC
// 23008-12). Uses libheif.
#ifndef STARFOCUS_PLATFORM_READERS_HEIC_H_
#define STARFOCUS_PLATFORM_READERS_HEIC_H_

#include <string>

#include "platform/readers/jpeg_parts.h"
#include "platform/readers/photo.h"
#include "platform/result.h"

namespace starfocus {

// Returns true if the bytes start like a HEIF file.
bool IsHeif(Span file);

// Reads the primary picture and its map, with the file's rotation applied. photo->map is empty if
// there is no map. `near` applies only if the file does not state which end of the map is near.
Result<DepthPhoto> ReadHeif(const std::string& where, Span file, Near near);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_HEIC_H_
