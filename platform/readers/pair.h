// SPDX-License-Identifier: Apache-2.0
// A photograph and its depth picture as two files.
#ifndef STARFOCUS_PLATFORM_READERS_PAIR_H_
#define STARFOCUS_PLATFORM_READERS_PAIR_H_

#include <string>

#include "platform/readers/photo.h"
#include "platform/result.h"

namespace starfocus {

// Whether a file of that name is a depth picture: its name without the extension ends in -depth,
// _depth or .depth, in any case.
bool IsDepthPictureName(const std::string& name);

// Finds the depth picture beside a photograph NAME.jpg or NAME-image.jpg: NAME-depth, NAME_depth or
// NAME.depth with .png, .pgm, .pfm, .jpg or .jpeg, in any case. Returns "" if there is none.
// If there are several, a note names the one that is taken.
Result<std::string> FindDepthPicture(const std::string& path, DepthPhoto* photo);

// Reads the depth picture, PNG, PGM, PPM, JPEG or PFM, into a photo whose picture is there. Without
// options larger is nearer in a PFM file, and the near end of others is guessed.
Error ReadDepthPicture(const std::string& path, const DepthOptions& options, DepthPhoto* photo);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_PAIR_H_
