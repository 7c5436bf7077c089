// SPDX-License-Identifier: Apache-2.0
// Reads pixels of captured views in any format: a format is one reader.
#ifndef STARFOCUS_LIB_INPUT_VIEW_READER_H_
#define STARFOCUS_LIB_INPUT_VIEW_READER_H_

#include <cstdint>

#include "lib/base/geometry.h"
#include "lib/base/transfer.h"
#include "lib/base/view_set.h"
#include "simd/kernels.h"

namespace starfocus {

// Both functions read `count` pixels of a view from (x, y) on along its row, R, G and B each. All
// pixels are inside the picture.
struct ViewReader {
  // Writes their light.
  void (*light)(const void* self, int view, int32_t x, int32_t y, int32_t count,
                int16_t* rgb) = nullptr;
  // Returns their codes: in place, or in `room` (3 * count), to which it writes them.
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

// Views that lie in memory as rows of codes R, G, B.
struct PlaneViews {
  const simd::Kernels* kernels = nullptr;
  const Transfer* transfer = nullptr;
  Plane<const uint8_t> view[kMaxViews];
};

// Returns the reader of `views`, which must outlive it.
ViewReader ReaderOf(const PlaneViews& views);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_INPUT_VIEW_READER_H_
