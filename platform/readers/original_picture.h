// SPDX-License-Identifier: Apache-2.0
// Replaces the picture of a portrait, whose background the camera has blurred, by the original
// picture that the file contains as well.
#ifndef STARFOCUS_PLATFORM_READERS_ORIGINAL_PICTURE_H_
#define STARFOCUS_PLATFORM_READERS_ORIGINAL_PICTURE_H_

#include <string>

#include "platform/readers/jpeg_parts.h"
#include "platform/readers/photo.h"

namespace starfocus {

// Replaces photo->picture by the picture `file`, which `name` describes, and the colour profile if
// `file` has its own. Other metadata of the photo remains. Ignores a picture that is unreadable or
// has other proportions, and adds a note.
void TakeOriginal(const std::string& name, Span file, DepthPhoto* photo);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_ORIGINAL_PICTURE_H_
