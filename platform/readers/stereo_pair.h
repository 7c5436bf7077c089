// SPDX-License-Identifier: Apache-2.0
// Reads stereo pairs of 3D cameras from one file (.mpo): the left and the right picture in the
// Multi-Picture Format (CIPA DC-007).
#ifndef STARFOCUS_PLATFORM_READERS_STEREO_PAIR_H_
#define STARFOCUS_PLATFORM_READERS_STEREO_PAIR_H_

#include <string>

#include "platform/readers/jpeg_parts.h"
#include "platform/readers/photo.h"

namespace starfocus {

// Reads the right picture of a stereo pair into photo->right. The caller must have stored the left
// picture in photo->picture. A stereo pair has a multi-picture index or the extension .mpo, and its
// second picture has the size of the first picture. Returns false if the file is not a stereo pair.
bool ReadStereoPair(const std::string& path, Span file, DepthPhoto* photo);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_STEREO_PAIR_H_
