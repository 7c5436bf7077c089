// SPDX-License-Identifier: Apache-2.0
// Reads Dynamic Depth 1.0, Google's format since 2018. In Dynamic Depth, the XMP of a JPEG file
// lists the pictures that follow the primary picture, and the purpose of each picture.
#ifndef STARFOCUS_PLATFORM_READERS_DYNAMIC_DEPTH_H_
#define STARFOCUS_PLATFORM_READERS_DYNAMIC_DEPTH_H_

#include <vector>

#include "platform/readers/appended_pictures.h"
#include "platform/readers/photo.h"
#include "platform/readers/xmp.h"
#include "platform/result.h"

namespace starfocus {

bool HasDynamicDepth(const XmpNode& xmp);

// Returns true if the file stores a mask of the subject.
bool HasMask(const XmpNode& xmp);

// Reads the depth map of a Dynamic Depth file, or a mask of the subject as photo->matte if the file
// has no readable depth map. photo->is_mask is then true, and the caller must decide whether the
// photo needs the mask. The caller must have set photo->orientation. `near` applies only if
// the file does not state which end of the grey range is near, and to masks. `appended` are the
// pictures that follow the first picture of `file`; those that are listed as gain maps are marked.
Error ReadDynamicDepth(Span file, const XmpNode& xmp, Near near,
                       std::vector<AppendedPicture>* appended, DepthPhoto* photo);

// Replaces photo->picture by the original of a portrait in a Dynamic Depth file, if the file stores
// a suitable one.
void ReadDynamicOriginal(Span file, const XmpNode& xmp, std::vector<AppendedPicture>* appended,
                         DepthPhoto* photo);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_DYNAMIC_DEPTH_H_
