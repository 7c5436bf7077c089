// SPDX-License-Identifier: Apache-2.0
// Tints pixels of pictures.
#ifndef STARFOCUS_EXAMPLES_CLI_PICTURES_TINT_H_
#define STARFOCUS_EXAMPLES_CLI_PICTURES_TINT_H_

#include <cstdint>

namespace starfocus {

// Replaces the pixel `rgb` by a mixture of `percent` % of `color` and its own grey level. A
// percentage of 0 makes the pixel grey.
inline void Tint(const uint8_t* color, int percent, uint8_t* rgb) {
  const int grey = (77 * rgb[0] + 150 * rgb[1] + 29 * rgb[2] + 128) >> 8;
  for (int c = 0; c < 3; ++c) {
    rgb[c] = static_cast<uint8_t>((color[c] * percent + grey * (100 - percent) + 50) / 100);
  }
}

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_PICTURES_TINT_H_
