// SPDX-License-Identifier: Apache-2.0
// Writes finished RGB rows to a picture of the caller in any format.
#ifndef STARFOCUS_LIB_IO_OUTPUT_H_
#define STARFOCUS_LIB_IO_OUTPUT_H_

#include "lib/base/jobs.h"
#include "lib/io/image.h"

namespace starfocus {

// Picture of any format that receives the part `rect` of the whole picture.
struct Output {
  const simd::ImageKernels* kernels;
  ImageTarget image;
  Rect rect;
  // Memory for the upper row of a pair whose chroma is written together with the next row. Null for
  // formats without chroma.
  uint8_t* odd_row;
  // Alpha of the whole picture, and the number of bytes from pixel to pixel. Null: alpha is 255.
  Plane<const uint8_t> alpha;
  size_t alpha_step;
};

// Returns an output to `image`, which must be valid, without alpha.
Output OutputOf(const starfocus_image& image, const Rect& rect, uint8_t* odd_row);

// Copies columns [first, last) of row y of `from`, which contains all columns of the whole picture.
// The output must be packed RGB.
void CopyColumns(const Output& out, const Plane<uint8_t>& from, int32_t y, int32_t first,
                 int32_t last);

// Stores rows of the whole picture, in order. `from` contains all columns of the whole picture. If
// the last row shares chroma samples with the next row, these samples are written together with
// the next row. Runs at most `most_jobs` jobs at once. Returns STARFOCUS_OK,
// STARFOCUS_ERROR_RUNNER or STARFOCUS_ERROR_CANCELLED.
starfocus_status StoreRows(const Output& out, const Range& rows, const Plane<uint8_t>& from,
                           int32_t most_jobs, Jobs* jobs);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_IO_OUTPUT_H_
