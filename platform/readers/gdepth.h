// SPDX-License-Identifier: Apache-2.0
// Reads GDepth, Google's format of depth photographs since 2014. The XMP of a JPEG file, usually
// extended XMP, contains the map as a PNG or JPEG picture in base64. The primary picture is often
// already blurred; in this case the XMP also contains the sharp picture.
#ifndef STARFOCUS_PLATFORM_READERS_GDEPTH_H_
#define STARFOCUS_PLATFORM_READERS_GDEPTH_H_

#include "platform/readers/photo.h"
#include "platform/readers/xmp.h"
#include "platform/result.h"

namespace starfocus {

bool HasGdepth(const XmpNode& xmp);

// Reads the map and, if present, the sharp picture and the focus. photo->picture must already be
// set. `xmp` contains all packets of the file, including extended XMP.
Error ReadGdepth(const XmpNode& xmp, Near near, DepthPhoto* photo);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_GDEPTH_H_
