// SPDX-License-Identifier: Apache-2.0
// The way from finished rows of R, G, B to an image of the caller's.
#ifndef STARFOCUS_LIB_SOURCE_IMAGE_OUTPUT_H_
#define STARFOCUS_LIB_SOURCE_IMAGE_OUTPUT_H_

#include "lib/convert/image_rows.h"
#include "lib/engine/driver.h"

namespace starfocus {

// An image for `rect` of the picture.
struct ImageOutput {
  const simd::ImageKernels* kernels;
  ImageTarget image;
  Rect rect;
  AlphaSource alpha;  // of the picture; none: it is 255
};

// Returns a sink that writes to `out`, which must outlive it. Chroma of a last row that has its
// partner below waits for that.
RowSink SinkOf(const ImageOutput& out);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SOURCE_IMAGE_OUTPUT_H_
