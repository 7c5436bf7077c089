// SPDX-License-Identifier: Apache-2.0
// Measures and draws the difference between two pictures.
#ifndef STARFOCUS_EXAMPLES_CLI_PICTURES_DIFFERENCE_H_
#define STARFOCUS_EXAMPLES_CLI_PICTURES_DIFFERENCE_H_

#include "platform/image.h"

namespace starfocus {

struct Difference {
  double psnr = 0;  // Peak signal-to-noise ratio in dB; infinite if the pictures are equal.
  int largest = 0;  // Largest difference of any sample.
};

// Measures the difference between two pictures. MeasureDifference and DrawDifference require
// pictures of equal size.
Difference MeasureDifference(const Image& a, const Image& b);

// Draws, for each pixel, the largest difference of any of its samples. Colours run from black (no
// difference) over red and yellow to white (`white` or more). `white` must be above 0.
Image DrawDifference(const Image& a, const Image& b, int white);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_PICTURES_DIFFERENCE_H_
