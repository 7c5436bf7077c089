// SPDX-License-Identifier: Apache-2.0
// Converts rows of images to and from RGB codes.
#ifndef STARFOCUS_LIB_IO_IMAGE_ROWS_H_
#define STARFOCUS_LIB_IO_IMAGE_ROWS_H_

#include <cstdint>

#include "lib/base/geometry.h"
#include "lib/io/image_planes.h"
#include "simd/image_kernels.h"

namespace starfocus {

// Reads `count` pixels, starting at (x, y), and writes their codes to `rgb`.
void ReadCodes(const simd::ImageKernels& kernels, const ImageSource& image, int32_t x, int32_t y,
               int32_t count, uint8_t* rgb);

// Writes the first `width` pixels of row y. For YUV formats, writes only the luma. Alpha is set to
// 255.
void WriteCodes(const simd::ImageKernels& kernels, const uint8_t* rgb, int32_t width, int32_t y,
                const ImageTarget& image);

// Writes the chroma of rows y and y + 1; y is even. If the last row of the picture has no partner,
// pass this row twice.
void WriteChroma(const simd::ImageKernels& kernels, const uint8_t* upper, const uint8_t* lower,
                 int32_t width, int32_t y, const ImageTarget& image);

// Returns the rows of the alpha of an image, whose values are image.step bytes apart. The data is
// null if the image has no alpha.
Plane<const uint8_t> AlphaOf(const ImageSource& image);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_IO_IMAGE_ROWS_H_
