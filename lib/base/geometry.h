// SPDX-License-Identifier: Apache-2.0
// Rectangles, planes of rows, and address ranges.
#ifndef STARFOCUS_LIB_BASE_GEOMETRY_H_
#define STARFOCUS_LIB_BASE_GEOMETRY_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/fixed.h"
#include "starfocus/starfocus.h"

namespace starfocus {

struct Rect {
  int32_t x, y, width, height;
};

// Number of pixels that are added at each side of a rectangle.
struct Border {
  int32_t left, right, top, bottom;
};

// Returns `rect` extended by `border` on each side.
constexpr Rect Extended(const Rect& rect, const Border& border) {
  return {rect.x - border.left, rect.y - border.top, border.left + rect.width + border.right,
          border.top + rect.height + border.bottom};
}

constexpr uint64_t PixelsIn(int32_t width, int32_t height) {
  return static_cast<uint64_t>(width) * static_cast<uint64_t>(height);
}

// Returns the part of a rectangle in a picture of width x height pixels.
constexpr Rect Clipped(const Rect& rect, int32_t width, int32_t height) {
  const int32_t left = Max(rect.x, 0), top = Max(rect.y, 0);
  return {left, top, Min(rect.x + rect.width, width) - left,
          Min(rect.y + rect.height, height) - top};
}

// Returns the square of the pixels that are at most `reach` columns and rows away from (x, y).
constexpr Rect Around(int32_t x, int32_t y, int32_t reach) {
  return {x - reach, y - reach, 2 * reach + 1, 2 * reach + 1};
}

constexpr bool Contains(const Rect& rect, int32_t x, int32_t y) {
  return x >= rect.x && y >= rect.y && x < rect.x + rect.width && y < rect.y + rect.height;
}

// Calls act(x, y) for each pixel of a rectangle, row by row.
template <class Act>
void ForPixels(const Rect& rect, const Act& act) {
  for (int32_t y = rect.y; y < rect.y + rect.height; ++y) {
    for (int32_t x = rect.x; x < rect.x + rect.width; ++x) act(x, y);
  }
}

// Returns true if test(x, y) is true for a pixel of a rectangle.
template <class Test>
bool AnyPixel(const Rect& rect, const Test& test) {
  for (int32_t y = rect.y; y < rect.y + rect.height; ++y) {
    for (int32_t x = rect.x; x < rect.x + rect.width; ++x) {
      if (test(x, y)) return true;
    }
  }
  return false;
}

// Rows, columns or other indices in [first, last).
struct Range {
  int32_t first, last;

  constexpr int32_t count() const { return last - first; }
};

// Returns part `index` when `rows` are divided into `parts` parts. The sizes of the parts differ by
// at most one row.
constexpr Range PartOf(const Range& rows, int32_t index, int32_t parts) {
  const int64_t count = rows.count();
  return {rows.first + static_cast<int32_t>(count * index / parts),
          rows.first + static_cast<int32_t>(count * (index + 1) / parts)};
}

// Rows of T, starting at row `first`. A ring (rows > 0) stores row y at index y modulo `rows`.
template <class T>
struct Plane {
  T* data = nullptr;
  size_t stride = 0;  // distance between rows, in elements of T
  int32_t rows = 0;
  int32_t first = 0;

  T* Row(int32_t y) const {
    const int32_t row = rows == 0 ? y - first : y % rows;
    return data + static_cast<size_t>(row) * stride;
  }
};

// Address range [begin, end).
struct Extent {
  uintptr_t begin, end;
};

// Returns the address range from the first byte of the first row to the last byte of the last row.
inline Extent ExtentOf(const void* data, size_t stride, int32_t rows, size_t row_bytes) {
  const auto begin = reinterpret_cast<uintptr_t>(data);
  const uintptr_t bytes = rows == 0 ? 0 : static_cast<uintptr_t>(rows - 1) * stride + row_bytes;
  return {begin, begin + bytes};
}

inline bool Overlaps(const Extent& a, const Extent& b) {
  return a.begin < b.end && b.begin < a.end;
}

// List of address ranges. The capacity suffices for all planes of one light field in any format, or
// of two in-place light fields, plus six more ranges.
struct Extents {
  Extent of[3 * STARFOCUS_MAX_VIEWS + 6];
  int count = 0;

  void Add(const Extent& extent) { of[count++] = extent; }
  void AddRows(const void* data, size_t stride, int32_t rows, size_t row_bytes) {
    Add(ExtentOf(data, stride, rows, row_bytes));
  }
};

inline bool Overlaps(const Extent& a, const Extents& b) {
  for (int n = 0; n < b.count; ++n) {
    if (Overlaps(a, b.of[n])) return true;
  }
  return false;
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_BASE_GEOMETRY_H_
