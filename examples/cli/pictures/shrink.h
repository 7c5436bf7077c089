// SPDX-License-Identifier: Apache-2.0
// Smaller pictures.
#ifndef STARFOCUS_EXAMPLES_CLI_PICTURES_SHRINK_H_
#define STARFOCUS_EXAMPLES_CLI_PICTURES_SHRINK_H_

#include "platform/image.h"

namespace starfocus {

// Scales a picture that is wider than `width` down to it: every pixel is the mean of those that it
// covers.
Image Shrink(const Image& source, int width);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_PICTURES_SHRINK_H_
