// SPDX-License-Identifier: Apache-2.0
// Reads GDepth, Google's format of depth photographs since 2014. In GDepth, the XMP of a JPEG file,
// usually extended XMP, contains the depth map as a PNG or JPEG picture in base64. If the primary
// picture is already blurred, the XMP contains the sharp picture as well.
#ifndef STARFOCUS_PLATFORM_READERS_GDEPTH_H_
#define STARFOCUS_PLATFORM_READERS_GDEPTH_H_

#include "platform/readers/photo.h"
#include "platform/readers/xmp.h"
#include "platform/result.h"

namespace starfocus {

bool HasGdepth(const XmpNode& xmp);

// Reads the depth map and, if present, the sharp picture and the focus. The caller must have set
// photo->picture. `xmp` must contain all XMP packets of the file, including extended XMP.
Error ReadGdepth(const XmpNode& xmp, Near near, DepthPhoto* photo);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_GDEPTH_H_
