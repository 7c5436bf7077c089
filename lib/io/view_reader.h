// SPDX-License-Identifier: Apache-2.0
// Interface for reading pixels of captured views. Each picture format has one reader.
#ifndef STARFOCUS_LIB_IO_VIEW_READER_H_
#define STARFOCUS_LIB_IO_VIEW_READER_H_

#include <cstdint>

#include "lib/base/geometry.h"
#include "lib/base/transfer.h"
#include "lib/optics/view_set.h"
#include "simd/kernels.h"

namespace starfocus {

// The functions of a reader read `count` RGB pixels of a view, starting at (x, y) and continuing
// along the row. All pixels must be inside the picture.
struct ViewReader {
  // Writes the light of the pixels.
  void (*light)(const void* self, int view, int32_t x, int32_t y, int32_t count,
                int16_t* rgb) = nullptr;
  // Returns the codes of the pixels. The result points to the picture, or to `room` if the function
  // wrote the codes there. `room` has 3 * count bytes.
  const uint8_t* (*codes)(const void* self, int view, int32_t x, int32_t y, int32_t count,
                          uint8_t* room) = nullptr;
  const void* self = nullptr;

  void Light(int view, int32_t x, int32_t y, int32_t count, int16_t* rgb) const {
    light(self, view, x, y, count, rgb);
  }
  const uint8_t* Codes(int view, int32_t x, int32_t y, int32_t count, uint8_t* room) const {
    return codes(self, view, x, y, count, room);
  }
};

// Views in memory as rows of packed RGB codes.
struct PlaneViews {
  const simd::Kernels* kernels = nullptr;
  const Transfer* transfer = nullptr;
  Plane<const uint8_t> view[kMaxViews];
};

// Returns a reader of `views`, which must outlive the reader.
ViewReader ReaderOf(const PlaneViews& views);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_IO_VIEW_READER_H_
