// SPDX-License-Identifier: Apache-2.0
// Captured views that do not lie in memory as rows of R, G, B: pixels are asked for.
#ifndef STARFOCUS_LIB_INPUT_CODE_READER_H_
#define STARFOCUS_LIB_INPUT_CODE_READER_H_

#include <cstdint>

namespace starfocus {

// Writes the codes of `count` pixels of view `index`, from (x, y) on along its row; all of them are
// inside the picture.
struct CodeReader {
  void (*read)(const void* views, int index, int32_t x, int32_t y, int32_t count, uint8_t* rgb);
  const void* views;

  void Read(int index, int32_t x, int32_t y, int32_t count, uint8_t* rgb) const {
    read(views, index, x, y, count, rgb);
  }
};

}  // namespace starfocus

#endif  // STARFOCUS_LIB_INPUT_CODE_READER_H_
