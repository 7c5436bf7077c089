// SPDX-License-Identifier: Apache-2.0
// Measures and draws the difference between two pictures, and reduces and tints pictures.
#ifndef STARFOCUS_EXAMPLES_CLI_PICTURES_H_
#define STARFOCUS_EXAMPLES_CLI_PICTURES_H_

#include <cstdint>

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

// Reduces a picture that is larger than `width` x `height` pixels, and keeps its proportions. Every
// pixel is the mean of the area that the pixel covers in the source.
Image Shrink(const Image& source, int width, int height = kMaxPictureSize);

// Replaces the pixel `rgb` by a mixture of `percent` % of `color` and its own grey level. A
// percentage of 0 makes the pixel grey.
inline void Tint(const uint8_t* color, int percent, uint8_t* rgb) {
  const int grey = (77 * rgb[0] + 150 * rgb[1] + 29 * rgb[2] + 128) >> 8;
  for (int c = 0; c < 3; ++c) {
    rgb[c] = static_cast<uint8_t>((color[c] * percent + grey * (100 - percent) + 50) / 100);
  }
}

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_PICTURES_H_
