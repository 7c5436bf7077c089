// SPDX-License-Identifier: Apache-2.0
// Measures and draws the difference between two pictures.
#ifndef STARFOCUS_EXAMPLES_CLI_PICTURES_DIFFERENCE_H_
#define STARFOCUS_EXAMPLES_CLI_PICTURES_DIFFERENCE_H_

#include "platform/image.h"

namespace starfocus {

struct Difference {
  double psnr = 0;  // in dB, over all samples; infinite if the pictures are equal
  int largest = 0;  // largest difference of any sample
};

// Measures the difference between two pictures. Both functions of this header require pictures of
// equal size.
Difference MeasureDifference(const Image& a, const Image& b);

// Draws the largest difference of each pixel's samples. Colours run from black (no difference) over
// red and yellow to white (`white` or more). `white` must be above 0.
Image DrawDifference(const Image& a, const Image& b, int white);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_PICTURES_DIFFERENCE_H_
