// SPDX-License-Identifier: Apache-2.0
// Pictures in memory: of 8 bits, of 16 bits, and in YUV.
#ifndef STARFOCUS_PLATFORM_IMAGE_H_
#define STARFOCUS_PLATFORM_IMAGE_H_

#include <cstddef>
#include <cstdint>
#include <vector>

#include "starfocus/starfocus.h"

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

// A picture with samples of 16 bits, for light that 8 bits cannot hold. Integers are codes of
// `transfer`, of which 65535 is white for sRGB and linear light; their alpha is not multiplied with
// the colours. Half floats are linear light, of which 1 is white; their colours are premultiplied
// with alpha.
struct DeepImage {
  int width = 0;
  int height = 0;
  int channels = 3;                            // 3: R, G and B; 4: also alpha
  bool is_half = false;                        // true: IEEE half floats
  int bits = 16;                               // bits of each sample in the file, from 8
  bool is_multiplied = false;                  // true: the file has colours times alpha
  int32_t transfer = STARFOCUS_TRANSFER_SRGB;  // starfocus_transfer of integers
  std::vector<uint16_t> samples;               // rows without padding

  DeepImage() = default;
  DeepImage(int w, int h, int c)
      : width(w), height(h), channels(c), samples(size_t(w) * size_t(h) * size_t(c)) {}

  size_t row_samples() const { return size_t(channels) * size_t(width); }
  uint16_t* row(int y) { return samples.data() + size_t(y) * row_samples(); }
  const uint16_t* row(int y) const { return samples.data() + size_t(y) * row_samples(); }
};

// A picture in YUV with one chroma sample for 2 x 2 pixels, as the engine reads and writes it.
struct PlanarImage {
  int width = 0;
  int height = 0;
  bool is_deep = false;  // true: STARFOCUS_FORMAT_P010; false: STARFOCUS_FORMAT_I420
  int32_t matrix = STARFOCUS_MATRIX_BT601;  // starfocus_matrix
  int32_t range = STARFOCUS_RANGE_LIMITED;  // starfocus_range
  // Planes in rows without padding: Y, U, V, or words of Y and then words of U and V in turn.
  std::vector<uint8_t> samples;

  int chroma_width() const { return (width + 1) / 2; }
  int chroma_height() const { return (height + 1) / 2; }
  size_t luma_samples() const { return size_t(width) * size_t(height); }
  size_t chroma_samples() const { return size_t(chroma_width()) * size_t(chroma_height()); }
  // Makes the samples of the size.
  void Allocate() { samples.resize((luma_samples() + 2 * chroma_samples()) * (is_deep ? 2 : 1)); }
};

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_IMAGE_H_
