// SPDX-License-Identifier: Apache-2.0
// GDepth, Google's depth photographs since 2014: XMP in a JPEG file, in which the map lies as a PNG
// or JPEG picture in base64, mostly in extended XMP. The picture of the file is often blurred
// already; the sharp one then lies beside the map.
#ifndef STARFOCUS_PLATFORM_READERS_GDEPTH_H_
#define STARFOCUS_PLATFORM_READERS_GDEPTH_H_

#include "platform/readers/photo.h"
#include "platform/readers/xmp.h"
#include "platform/result.h"

namespace starfocus {

bool HasGdepth(const XmpNode& xmp);

// Reads the map, and the sharp picture and the focus if there are any, into a photo whose picture
// is there. `xmp` has all packets of the file, the extended ones too.
Error ReadGdepth(const XmpNode& xmp, Near near, DepthPhoto* photo);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_GDEPTH_H_
