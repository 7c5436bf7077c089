// SPDX-License-Identifier: Apache-2.0
// The way from finished rows of R, G, B to a picture of the caller's, in any format.
#ifndef STARFOCUS_LIB_SOURCE_PICTURE_OUTPUT_H_
#define STARFOCUS_LIB_SOURCE_PICTURE_OUTPUT_H_

#include "lib/convert/image_rows.h"
#include "lib/engine/driver.h"

namespace starfocus {

// A picture for `rect` of the whole one.
struct PictureOutput {
  const simd::ImageKernels* kernels;
  ImageTarget image;
  Rect rect;
  AlphaSource alpha;  // of the whole picture; none: it is 255
  // Where what has not changed comes from; null: nowhere. Both pictures are in place then.
  const starfocus_image* previous = nullptr;
};

// Returns a sink that writes to `out`, which must outlive it. Chroma of a last row that has its
// partner below waits for that.
RowSink SinkOf(const PictureOutput& out);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SOURCE_PICTURE_OUTPUT_H_
