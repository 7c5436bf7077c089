// SPDX-License-Identifier: Apache-2.0
// Apple's auxiliary pictures: what their XMP says of a depth map, in HEIC and in JPEG files, and
// where they lie in a JPEG file.
#ifndef STARFOCUS_PLATFORM_READERS_APPLE_DEPTH_H_
#define STARFOCUS_PLATFORM_READERS_APPLE_DEPTH_H_

#include "platform/readers/jpeg_parts.h"
#include "platform/readers/photo.h"
#include "platform/readers/xmp.h"

namespace starfocus {

// From levels to inverse distances, by the XMP of the auxiliary picture.
std::string UnderstandApple(const std::string& where, const XmpNode& xmp, DepthPhoto* photo);

// Looks among the pictures of a multi-picture file for one of disparities or depths. `map` is empty
// if there is none; `gain_map` tells of another kind of auxiliary picture.
std::string FindAppleMap(const std::string& where, Span file, const JpegParts& parts, Span* map,
                         XmpNode* xmp, bool* gain_map);

std::string ReadAppleJpeg(const std::string& where, Span file, const JpegParts& parts, Span map,
                          const XmpNode& xmp, DepthPhoto* photo);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_APPLE_DEPTH_H_
