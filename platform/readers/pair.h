// SPDX-License-Identifier: Apache-2.0
// A photograph and its depth picture as two files.
#ifndef STARFOCUS_PLATFORM_READERS_PAIR_H_
#define STARFOCUS_PLATFORM_READERS_PAIR_H_

#include <string>

#include "platform/readers/photo.h"

namespace starfocus {

// The depth picture that lies beside a photograph: NAME-depth.png, .jpg or .jpeg beside NAME.jpg or
// NAME-image.jpg. Empty if there is none.
std::string FindDepthPicture(const std::string& photo);

// Reads the depth picture, PNG (16 bits, too), PPM, JPEG or PFM, into a photo whose picture is
// there. A PFM file has disparities: larger is nearer.
std::string ReadDepthPicture(const std::string& path, Near near, DepthPhoto* photo);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_PAIR_H_
