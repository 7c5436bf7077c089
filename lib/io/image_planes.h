// SPDX-License-Identifier: Apache-2.0
// Describes the memory layout of images of any format: RGB pixels, or planes of luma and chroma.
#ifndef STARFOCUS_LIB_IO_IMAGE_PLANES_H_
#define STARFOCUS_LIB_IO_IMAGE_PLANES_H_

#include <cstddef>
#include <cstdint>

#include "lib/io/yuv_matrix.h"
#include "starfocus/image.h"

namespace starfocus {

// Planes of an image. The type parameter Byte is const for input images. RGB formats use only
// planes[0], and `step` is the number of bytes from pixel to pixel. YUV formats have planes for
// luma, U and V, and `step` is the number of bytes from chroma sample to chroma sample.
template <class Byte>
struct ImagePlanes {
  bool is_yuv, blue_first, has_alpha;
  uint8_t matrix;  // 2 * starfocus_matrix + starfocus_range, of YUV formats
  uint32_t step;
  Byte* planes[3];
  size_t strides[3];

  const simd::YuvMatrix& Matrix() const { return kYuvMatrices[matrix / 2][matrix % 2]; }

  // Returns true if rows are packed RGB.
  bool IsPacked() const { return !is_yuv && !blue_first && step == 3; }

  Byte* Pixel(int32_t x, int32_t y) const {
    return planes[0] + static_cast<size_t>(y) * strides[0] + static_cast<size_t>(x) * step;
  }
  Byte* Luma(int32_t x, int32_t y) const {
    return planes[0] + static_cast<size_t>(y) * strides[0] + static_cast<size_t>(x);
  }
  // Returns the sample of chroma plane 1 or 2 for pixel (x, y).
  Byte* Chroma(int plane, int32_t x, int32_t y) const {
    return planes[plane] + static_cast<size_t>(y / 2) * strides[plane] +
           static_cast<size_t>(x / 2) * step;
  }
};

using ImageSource = ImagePlanes<const uint8_t>;
using ImageTarget = ImagePlanes<uint8_t>;

constexpr bool IsYuv(int32_t format) { return format >= STARFOCUS_FORMAT_NV12; }
constexpr bool IsPaired(int32_t format) {
  return format == STARFOCUS_FORMAT_NV12 || format == STARFOCUS_FORMAT_NV21;
}
constexpr bool HasAlpha(int32_t format) {
  return format == STARFOCUS_FORMAT_RGBX || format == STARFOCUS_FORMAT_BGRX;
}

// Returns the number of bytes that pixel_stride = 0 selects for a format.
constexpr int32_t LeastStep(int32_t format) {
  if (!IsYuv(format)) return HasAlpha(format) ? 4 : 3;
  return IsPaired(format) ? 2 : 1;
}

// Returns the planes of a valid image. The type parameter Byte is const for input images.
template <class Byte>
ImagePlanes<Byte> PlanesOf(const starfocus_image& image) {
  ImagePlanes<Byte> of = {};
  const int32_t format = image.format;
  of.is_yuv = IsYuv(format);
  of.blue_first = format == STARFOCUS_FORMAT_BGR || format == STARFOCUS_FORMAT_BGRX;
  of.has_alpha = HasAlpha(format);
  of.step = static_cast<uint32_t>(image.pixel_stride != 0 ? image.pixel_stride : LeastStep(format));
  if (of.is_yuv) of.matrix = static_cast<uint8_t>(2 * image.matrix + image.range);
  for (int plane = 0; plane < 3; ++plane) {
    of.planes[plane] = static_cast<Byte*>(image.planes[plane]);
    of.strides[plane] = image.strides[plane];
  }
  if (IsPaired(format)) {
    const int u = format == STARFOCUS_FORMAT_NV12 ? 0 : 1;
    Byte* const chroma = of.planes[1];
    of.planes[1] = chroma + u;
    of.planes[2] = chroma + 1 - u;
    of.strides[2] = of.strides[1];
  }
  return of;
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_IO_IMAGE_PLANES_H_
