// SPDX-License-Identifier: Apache-2.0
// Rectangles, rows and ranges of addresses.
#ifndef STARFOCUS_LIB_BASE_GEOMETRY_H_
#define STARFOCUS_LIB_BASE_GEOMETRY_H_

#include <cstddef>
#include <cstdint>

namespace starfocus {

struct Rect {
  int32_t x, y, width, height;
};

// Pixels beyond the sides of a rectangle.
struct Border {
  int32_t left, right, top, bottom;
};

// The rectangle with its border.
constexpr Rect Extended(const Rect& rect, const Border& border) {
  return {rect.x - border.left, rect.y - border.top, border.left + rect.width + border.right,
          border.top + rect.height + border.bottom};
}

// Rows [first, last) of a picture, a layer or a tile.
struct RowRange {
  int32_t first, last;
};

// Rows of T, from row `first` on; a ring (rows > 0) holds row y at y modulo `rows` instead.
template <class T>
struct Plane {
  T* data = nullptr;
  size_t stride = 0;  // in T
  int32_t rows = 0;
  int32_t first = 0;

  T* Row(int32_t y) const {
    const int32_t row = rows == 0 ? y - first : y % rows;
    return data + static_cast<size_t>(row) * stride;
  }
};

// The addresses [begin, end).
struct Extent {
  uintptr_t begin, end;
};

// The addresses from the first byte of `rows` rows to the last one's; those between rows count.
inline Extent ExtentOf(const void* data, size_t stride, int32_t rows, size_t row_bytes) {
  const auto begin = reinterpret_cast<uintptr_t>(data);
  const uintptr_t bytes = rows == 0 ? 0 : static_cast<uintptr_t>(rows - 1) * stride + row_bytes;
  return {begin, begin + bytes};
}

inline bool Overlaps(const Extent& a, const Extent& b) {
  return a.begin < b.end && b.begin < a.end;
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_BASE_GEOMETRY_H_
