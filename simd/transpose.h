// SPDX-License-Identifier: Apache-2.0
// The kernel that turns rows of pixels into columns.
#ifndef STARFOCUS_SIMD_TRANSPOSE_H_
#define STARFOCUS_SIMD_TRANSPOSE_H_

#include <cstddef>
#include <cstdint>

namespace starfocus::simd {

// Bytes that Transpose may write past the end of each row.
inline constexpr size_t kTransposePadding = 13;

namespace reference {

// Pixel `column` of row `row` of `in` becomes pixel `row` of row `column` of `out`. Strides are in
// bytes. Up to kTransposePadding bytes past the end of each row of `out` may be written, in the
// order of the rows of `in`: so a picture can be transposed in strips of a multiple of four rows.
void Transpose(const uint8_t* in, size_t in_stride, size_t rows, size_t columns, uint8_t* out,
               size_t out_stride);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_TRANSPOSE_H_
