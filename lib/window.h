// The rows of all views and of the disparity map that a stripe needs, whether they lie in the
// caller's pictures or in a ring of lines.
#ifndef STARFOCUS_LIB_WINDOW_H_
#define STARFOCUS_LIB_WINDOW_H_

#include <cstddef>
#include <cstdint>

#include "lib/fixed.h"

namespace starfocus {

// Rows of T; row y lies at y modulo `rows` when the plane is a ring (rows > 0).
template <class T>
struct Plane {
  T* data = nullptr;
  size_t stride = 0;  // in T
  int32_t rows = 0;   // of the ring; 0: whole picture

  T* Row(int32_t y) const {
    const size_t row = static_cast<size_t>(rows == 0 ? y : y % rows);
    return data + row * stride;
  }
};

inline constexpr int kMaxViews = 17;

// A light field at one layer: pixel (x, y) stands for pixel (x << L, y << L) of the pictures.
struct Window {
  int32_t width = 0;
  int32_t height = 0;
  int32_t views = 0;  // 1, 5, 9 or 17
  Plane<const uint8_t> view[kMaxViews];
  Plane<const int16_t> disparity;  // kDisparityBits, in pixels of the pictures

  // Pixel of a view; positions outside the picture take the nearest pixel inside.
  const uint8_t* Pixel(int index, int32_t x, int32_t y) const {
    return view[index].Row(Clamp(y, 0, height - 1)) + 3 * Clamp(x, 0, width - 1);
  }
};

// Index of the captured view in direction (u, v), each -1, 0 or 1 and not both 0, at full or half
// distance.
int CapturedView(int u, int v, bool half);

// Position of a captured view in halves of a unit.
struct ViewPosition {
  int8_t u2, v2;
};
ViewPosition CapturedPosition(int index);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_WINDOW_H_
