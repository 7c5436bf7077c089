// SPDX-License-Identifier: Apache-2.0
// Measures how similar a preview is to the full picture. Used by tap.cc.
#ifndef STARFOCUS_EXAMPLES_TAP_NEARNESS_H_
#define STARFOCUS_EXAMPLES_TAP_NEARNESS_H_

#include "platform/image_io.h"

namespace starfocus {

// Returns the PSNR in dB of a preview at 1 / 2^shift of the size, over all samples of the preview.
// The reference for the PSNR is the full picture, reduced to the size of the preview by averaging
// light. Returns infinity if the preview equals the reference.
double PreviewPsnr(const Image& preview, const Image& full, int shift);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_TAP_NEARNESS_H_
