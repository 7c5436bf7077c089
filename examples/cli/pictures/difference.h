// SPDX-License-Identifier: Apache-2.0
// How much two pictures differ, and where.
#ifndef STARFOCUS_EXAMPLES_CLI_PICTURES_DIFFERENCE_H_
#define STARFOCUS_EXAMPLES_CLI_PICTURES_DIFFERENCE_H_

#include "platform/image.h"

namespace starfocus {

struct Difference {
  double psnr = 0;  // dB over all samples; infinite where they are equal
  int largest = 0;  // of all samples
};

// Of two pictures of one size, here and below.
Difference MeasureDifference(const Image& a, const Image& b);

// Black where they agree, and by the largest difference of a pixel's samples over red and yellow to
// white, which is a difference of `white` or more; above 0.
Image DrawDifference(const Image& a, const Image& b, int white);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_PICTURES_DIFFERENCE_H_
