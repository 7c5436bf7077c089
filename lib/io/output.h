// SPDX-License-Identifier: Apache-2.0
// Finished rows of a picture, and their conversion to a picture of the caller in any format.
#ifndef STARFOCUS_LIB_IO_OUTPUT_H_
#define STARFOCUS_LIB_IO_OUTPUT_H_

#include "lib/base/config.h"
#include "lib/base/jobs.h"
#include "lib/io/image.h"

namespace starfocus {

struct DeepTables;

// Rows of the refocused picture: codes, or colours and alpha of a deep picture (deep.h).
struct PictureRows {
  Plane<uint8_t> codes = {};
  Plane<uint16_t> deep = {}, alpha = {};

  bool is_deep() const { return kDeep && deep.data != nullptr; }
};

// Picture of any format that receives the part `rect` of the whole picture.
struct Output {
  const simd::ImageKernels* kernels;
  const DeepTables* tables;  // Null: rows are codes.
  ImageTarget image;
  Rect rect;
  // Memory for 8-bit codes of deep rows: the rows of a stripe and its alpha; null without images.
  Plane<uint8_t> dithered, dithered_alpha;
  // Memory for the upper row of a pair whose chroma is written together with the next row: codes,
  // or a deep row. Null for formats without chroma.
  uint8_t* odd_row;
  // Alpha of the whole picture, and the number of bytes from pixel to pixel. Null: alpha is 255.
  Plane<const uint8_t> alpha;
  size_t alpha_step;
};

// Copies columns [first, last) of row y of `from`, which contains all columns of the whole picture.
// The output must be packed RGB.
void CopyColumns(const Output& out, const Plane<uint8_t>& from, int32_t y, int32_t first,
                 int32_t last);

// Stores rows of the whole picture, in order. `from` contains all columns of the whole picture. If
// the last row shares chroma samples with the next row, these samples are written together with
// the next row. Runs at most `most_jobs` jobs at once. Returns STARFOCUS_OK,
// STARFOCUS_ERROR_RUNNER or STARFOCUS_ERROR_CANCELLED.
starfocus_status StoreRows(const Output& out, const Range& rows, const PictureRows& from,
                           int32_t most_jobs, Jobs* jobs);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_IO_OUTPUT_H_
