// SPDX-License-Identifier: Apache-2.0
// How near a preview comes to the full picture that it stands for.
#ifndef STARFOCUS_EXAMPLES_TAP_NEARNESS_H_
#define STARFOCUS_EXAMPLES_TAP_NEARNESS_H_

#include "platform/image_io.h"

namespace starfocus {

// PSNR in dB over all samples of a preview at 1 / 2^shift of the size against the full picture
// reduced by means of light; infinite when they are equal.
double PreviewPsnr(const Image& preview, const Image& full, int shift);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_TAP_NEARNESS_H_
