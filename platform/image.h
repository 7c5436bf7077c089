// SPDX-License-Identifier: Apache-2.0
// An 8-bit RGB picture in memory.
#ifndef STARFOCUS_PLATFORM_IMAGE_H_
#define STARFOCUS_PLATFORM_IMAGE_H_

#include <cstddef>
#include <cstdint>
#include <vector>

namespace starfocus {

// Largest width and height of pictures in files. Equal to STARFOCUS_MAX_SIZE of starfocus.h.
inline constexpr int kMaxPictureSize = 65535;

// Returns true if the size of the picture in bytes fits the address space. On 32-bit systems, the
// largest pictures do not fit.
constexpr bool FitsMemory(int width, int height, size_t bytes_per_pixel) {
  return uint64_t(width) * uint64_t(height) <= uint64_t{PTRDIFF_MAX} / bytes_per_pixel;
}

struct Image {
  int width = 0;
  int height = 0;
  std::vector<uint8_t> pixels;  // samples R, G and B of each pixel, in rows without padding

  Image() = default;
  Image(int w, int h) : width(w), height(h), pixels(size_t(3) * size_t(w) * size_t(h)) {}

  size_t stride() const { return size_t(3) * size_t(width); }
  uint8_t* row(int y) { return pixels.data() + size_t(y) * stride(); }
  const uint8_t* row(int y) const { return pixels.data() + size_t(y) * stride(); }
};

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_IMAGE_H_
