// SPDX-License-Identifier: Apache-2.0
// The way from finished rows of R, G, B to an image of the caller's.
#ifndef STARFOCUS_LIB_API_IMAGE_OUTPUT_H_
#define STARFOCUS_LIB_API_IMAGE_OUTPUT_H_

#include "lib/convert/image_rows.h"
#include "lib/engine/engine.h"

namespace starfocus {

// An image for `rect` of the picture.
struct ImageOutput {
  const simd::ImageKernels* kernels;
  ImageTarget image;
  Rect rect;
  AlphaSource alpha;  // of the picture; none: it is 255
};

// Writes rows [rows.first, rows.last) of the picture, of which `from` has all columns. Rows come in
// order. Chroma of a last row that has its partner below waits for that.
sf_status WriteImageRows(const ImageOutput& out, const Plane<uint8_t>& from, const RowRange& rows,
                         const Runner& runner, EngineState* engine);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_API_IMAGE_OUTPUT_H_
