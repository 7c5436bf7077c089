// SPDX-License-Identifier: Apache-2.0
// Reduces pictures.
#ifndef STARFOCUS_EXAMPLES_CLI_PICTURES_SHRINK_H_
#define STARFOCUS_EXAMPLES_CLI_PICTURES_SHRINK_H_

#include "platform/image.h"

namespace starfocus {

// Reduces a picture that is larger than `width` x `height` pixels, and keeps its proportions. Every
// pixel is the mean of the area that the pixel covers in the source.
Image Shrink(const Image& source, int width, int height = kMaxPictureSize);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_PICTURES_SHRINK_H_
