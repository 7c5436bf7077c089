// SPDX-License-Identifier: Apache-2.0
// GDepth, Google's depth photographs since 2014: XMP in a JPEG file, in which the map lies as a PNG
// or JPEG picture in base64, mostly in extended XMP. The picture of the file is often blurred
// already; the sharp one then lies beside the map.
#ifndef STARFOCUS_PLATFORM_READERS_GDEPTH_H_
#define STARFOCUS_PLATFORM_READERS_GDEPTH_H_

#include "platform/readers/jpeg_parts.h"
#include "platform/readers/photo.h"
#include "platform/readers/xmp.h"

namespace starfocus {

bool HasGdepth(const XmpNode& xmp);

// `xmp` has both packets of the file.
std::string ReadGdepth(const std::string& where, Span file, const JpegParts& parts,
                       const XmpNode& xmp, DepthPhoto* photo);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_GDEPTH_H_
