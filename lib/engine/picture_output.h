// SPDX-License-Identifier: Apache-2.0
// Writes finished RGB rows to a picture of the caller in any format.
#ifndef STARFOCUS_LIB_ENGINE_PICTURE_OUTPUT_H_
#define STARFOCUS_LIB_ENGINE_PICTURE_OUTPUT_H_

#include "lib/engine/driver.h"
#include "lib/io/image_rows.h"

namespace starfocus {

// Output picture for the part `rect` of the whole picture.
struct PictureOutput {
  const simd::ImageKernels* kernels;
  ImageTarget image;
  Rect rect;
  AlphaSource alpha;  // alpha of the whole picture; if its rows are null, alpha is 255
  // Source of unchanged pixels, or null. If `previous` is not null, `image` and `previous` are
  // packed RGB.
  const starfocus_image* previous = nullptr;
};

// Returns a sink that writes to `out`, which must outlive the sink. If the last stored row shares
// chroma samples with the next row, the chroma samples are written together with the next row.
RowSink SinkOf(const PictureOutput& out);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_PICTURE_OUTPUT_H_
