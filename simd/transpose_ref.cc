// SPDX-License-Identifier: Apache-2.0
#include <cstring>

#include "simd/transpose.h"

namespace starfocus::simd::reference {

void Transpose(const uint8_t* in, size_t in_stride, size_t rows, size_t columns, uint8_t* out,
               size_t out_stride) {
  for (size_t row = 0; row < rows; ++row) {
    for (size_t column = 0; column < columns; ++column) {
      std::memcpy(out + column * out_stride + 3 * row, in + row * in_stride + 3 * column, 3);
    }
  }
}

}  // namespace starfocus::simd::reference
