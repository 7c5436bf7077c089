// SPDX-License-Identifier: Apache-2.0
// Apple's auxiliary pictures: what their XMP says of a depth map, in HEIC and in JPEG files, and
// where they lie in a JPEG file.
#ifndef STARFOCUS_PLATFORM_READERS_APPLE_DEPTH_H_
#define STARFOCUS_PLATFORM_READERS_APPLE_DEPTH_H_

#include "platform/readers/jpeg_parts.h"
#include "platform/readers/photo.h"
#include "platform/readers/xmp.h"
#include "platform/result.h"

namespace starfocus {

// From levels to inverse distances, by the XMP of the auxiliary picture. Where it has no range, or
// one that is no range, the map becomes an order.
void UnderstandApple(const XmpNode& xmp, DepthPhoto* photo);

// Reads the map of disparities or depths among the pictures behind the first one, if there is one,
// into a photo whose picture is there. A gain map is told as a fact.
Error ReadAppleJpeg(Span file, const JpegParts& parts, DepthPhoto* photo);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_APPLE_DEPTH_H_
