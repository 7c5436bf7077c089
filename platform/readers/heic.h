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

// Returns true if the bytes start with the file type box of a HEIF file.
bool IsHeif(Span file);

// Loads the decoders that newer versions of libheif keep in separate libraries. Otherwise libheif
// loads these libraries when it reads the first file.
void LoadHeifDecoders();

// Reads the primary picture and its depth map, and applies the rotation that the file states. The
// map of the result is empty if the file has no map. `near` applies only if the file does not state
// which end of the grey range is near.
Result<DepthPhoto> ReadHeif(const std::string& where, Span file, Near near);

// Reads the left and the right picture of the stereo pair in a HEIF file into photo->picture and
// photo->right, as spatial photos of phones contain them. Returns false if the file has no stereo
// pair, or a picture of the pair is unreadable, or the pictures differ in size.
bool ReadHeifPair(const std::string& where, Span file, DepthPhoto* photo);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_HEIC_H_
