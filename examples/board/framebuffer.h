// SPDX-License-Identifier: Apache-2.0
// Draws pictures on a Linux framebuffer (/dev/fb0).
#ifndef STARFOCUS_EXAMPLES_BOARD_FRAMEBUFFER_H_
#define STARFOCUS_EXAMPLES_BOARD_FRAMEBUFFER_H_

#include <cstddef>
#include <cstdint>
#include <string>

#include "platform/image.h"
#include "platform/result.h"

namespace starfocus {

// Position of a colour within a pixel: `length` bits, starting at bit `offset`.
struct PixelField {
  int offset, length;
};

// The memory of a screen, mapped into this process, and its pixel format.
struct Screen {
  uint8_t* memory = nullptr;
  int width = 0, height = 0;  // Size of the screen in pixels.
  size_t stride = 0;          // Bytes from one row to the next row.
  int bytes_per_pixel = 0;    // Size of a little-endian pixel: 2, 3 or 4 bytes.
  PixelField red = {0, 0}, green = {0, 0}, blue = {0, 0};
};

// Draws the picture at the centre of the screen, cropped to the screen, and fills the rest of the
// screen with black.
void Draw(const Image& picture, const Screen& screen);

// Draws the picture on the framebuffer device `path`.
Error ShowOnFramebuffer(const std::string& path, const Image& picture);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_BOARD_FRAMEBUFFER_H_
