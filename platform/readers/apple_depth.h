// SPDX-License-Identifier: Apache-2.0
// Reads depth maps and mattes that are stored as Apple's auxiliary pictures. Interprets the XMP of
// auxiliary pictures in HEIC and JPEG files, and finds auxiliary pictures in JPEG files.
#ifndef STARFOCUS_PLATFORM_READERS_APPLE_DEPTH_H_
#define STARFOCUS_PLATFORM_READERS_APPLE_DEPTH_H_

#include <vector>

#include "platform/readers/appended_pictures.h"
#include "platform/readers/photo.h"
#include "platform/readers/xmp.h"
#include "platform/result.h"

namespace starfocus {

// Converts the grey levels of photo->map to inverse distances, by the range in the XMP of the
// auxiliary picture. If the XMP has no valid range, the map receives the meaning
// MapMeaning::kOrder.
void UnderstandApple(const XmpNode& xmp, DepthPhoto* photo);

// Reads the first map of disparities or depths among the pictures that follow the primary picture
// of a JPEG file, `appended`. The caller must have set photo->picture.
Error ReadAppleJpeg(Span file, const JpegParts& parts, std::vector<AppendedPicture> appended,
                    DepthPhoto* photo);

// Sets photo->matte to the matte of the subject (apple_mattes.h) among the pictures that follow the
// primary picture of a JPEG file. The caller must have read photo->picture and photo->map.
void ReadAppleMattes(const std::vector<AppendedPicture>& appended, DepthPhoto* photo);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_APPLE_DEPTH_H_
