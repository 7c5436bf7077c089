// SPDX-License-Identifier: Apache-2.0
// Stereo pairs of 3D cameras in one file (.mpo): the left and the right picture by the
// Multi-Picture Format (CIPA DC-007).
#ifndef STARFOCUS_PLATFORM_READERS_STEREO_PAIR_H_
#define STARFOCUS_PLATFORM_READERS_STEREO_PAIR_H_

#include <string>

#include "platform/readers/jpeg_parts.h"
#include "platform/readers/photo.h"

namespace starfocus {

// Reads the other picture of a pair, photo->right, into a photo whose picture is there. The file
// has a multi-picture index or the extension .mpo, and the picture behind the first one has its
// size. False where the file is no such pair.
bool ReadStereoPair(const std::string& path, Span file, DepthPhoto* photo);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_STEREO_PAIR_H_
