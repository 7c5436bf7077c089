// SPDX-License-Identifier: Apache-2.0
// Images of any format: the layout of their memory, and the conversion of rows to and from RGB
// codes.
#ifndef STARFOCUS_LIB_IO_IMAGE_H_
#define STARFOCUS_LIB_IO_IMAGE_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/geometry.h"
#include "simd/kernels.h"
#include "simd/pixels.h"
#include "starfocus/image.h"

namespace starfocus {

constexpr int16_t RoundCoefficient(double value) {
  return static_cast<int16_t>(value < 0 ? value - 0.5 : value + 0.5);
}

// Computes the YUV coefficients from the shares kr and kb of red and blue in luma.
constexpr simd::YuvMatrix MakeYuvMatrix(double kr, double kb, bool full) {
  const double kg = 1 - kr - kb;
  const double p = full ? 1 : 255.0 / 219, q = full ? 1 : 255.0 / 224;
  const double red = 2 - 2 * kr, blue = 2 - 2 * kb;
  simd::YuvMatrix m = {};
  m.black = full ? 0 : 16;
  m.y = RoundCoefficient((1 << 14) * p);
  m.rv = RoundCoefficient((1 << 13) * q * red);
  m.gu = RoundCoefficient(-(1 << 13) * q * blue * kb / kg);
  m.gv = RoundCoefficient(-(1 << 13) * q * red * kr / kg);
  m.bu = RoundCoefficient((1 << 13) * q * blue);
  const double w = (1 << 15) / p, h = (1 << 15) / q / 2;
  m.yr = RoundCoefficient(w * kr);
  m.yb = RoundCoefficient(w * kb);
  m.yg = static_cast<int16_t>(static_cast<int32_t>(w + 0.5) - m.yr - m.yb);
  m.ub = RoundCoefficient(h);
  m.ur = RoundCoefficient(-h * kr / (1 - kb));
  m.ug = static_cast<int16_t>(-m.ur - m.ub);
  m.vr = RoundCoefficient(h);
  m.vb = RoundCoefficient(-h * kb / (1 - kr));
  m.vg = static_cast<int16_t>(-m.vr - m.vb);
  return m;
}

// YUV coefficients, indexed by starfocus_matrix and starfocus_range.
inline constexpr simd::YuvMatrix kYuvMatrices[2][2] = {
    {MakeYuvMatrix(0.299, 0.114, false), MakeYuvMatrix(0.299, 0.114, true)},
    {MakeYuvMatrix(0.2126, 0.0722, false), MakeYuvMatrix(0.2126, 0.0722, true)},
};

// Returns true if the samples of a format have more than 8 bits.
constexpr bool IsDeep(int32_t format) { return format >= STARFOCUS_FORMAT_RGB16; }
constexpr int32_t SampleBytes(int32_t format) { return IsDeep(format) ? 2 : 1; }

// Planes of an image. The type parameter Byte is const for input images. RGB formats use only
// planes[0], and `step` is the number of bytes from pixel to pixel. YUV formats have planes for
// luma, U and V, and `step` is the number of bytes from chroma sample to chroma sample.
template <class Byte>
struct ImagePlanes {
  int32_t format;  // starfocus_format
  bool is_yuv, blue_first, has_alpha;
  bool refocuses_alpha;  // True: alpha is refocused like light; false: alpha is copied.
  uint8_t matrix;        // 2 * starfocus_matrix + starfocus_range, of YUV formats
  uint32_t step;
  Byte* planes[3];
  size_t strides[3];

  const simd::YuvMatrix& Matrix() const { return kYuvMatrices[matrix / 2][matrix % 2]; }

  // Returns true if rows are packed RGB.
  bool IsPacked() const { return format == STARFOCUS_FORMAT_RGB && step == 3; }

  Byte* Pixel(int32_t x, int32_t y) const {
    return planes[0] + static_cast<size_t>(y) * strides[0] + static_cast<size_t>(x) * step;
  }
  Byte* Luma(int32_t x, int32_t y) const {
    return planes[0] + static_cast<size_t>(y) * strides[0] + static_cast<size_t>(x);
  }
  // Prefetches planes[0] of `count` pixels, starting at (x, y), which may be outside the image.
  void Prefetch(int32_t x, int32_t y, int32_t count) const {
    constexpr ptrdiff_t kLine = 64;
    const ptrdiff_t bytes = is_yuv ? SampleBytes(format) : static_cast<ptrdiff_t>(step);
    const Byte* const from = planes[0] + y * static_cast<ptrdiff_t>(strides[0]) + x * bytes;
    for (ptrdiff_t n = 0; n < count * bytes; n += kLine) __builtin_prefetch(from + n);
  }
  // Returns the sample of chroma plane 1 or 2 for pixel (x, y).
  Byte* Chroma(int plane, int32_t x, int32_t y) const {
    return planes[plane] + static_cast<size_t>(y / 2) * strides[plane] +
           static_cast<size_t>(x / 2) * step;
  }
};

using ImageSource = ImagePlanes<const uint8_t>;
using ImageTarget = ImagePlanes<uint8_t>;

constexpr bool IsYuv(int32_t format) {
  return (format >= STARFOCUS_FORMAT_NV12 && format <= STARFOCUS_FORMAT_YUV_420_888) ||
         format >= STARFOCUS_FORMAT_P010;
}
// Returns true if two rows of pixels share a row of chroma samples.
constexpr bool HasRowPairs(int32_t format) {
  return IsYuv(format) && format != STARFOCUS_FORMAT_P210;
}
// Returns true if samples of U and V alternate in one plane.
constexpr bool IsPaired(int32_t format) {
  return format == STARFOCUS_FORMAT_NV12 || format == STARFOCUS_FORMAT_NV21 ||
         format >= STARFOCUS_FORMAT_P010;
}
constexpr bool HasAlpha(int32_t format) {
  return format == STARFOCUS_FORMAT_RGBX || format == STARFOCUS_FORMAT_BGRX;
}
constexpr bool RefocusesAlpha(int32_t format) {
  return format == STARFOCUS_FORMAT_RGBA16 || format == STARFOCUS_FORMAT_RGBA_HALF;
}

// Returns the number of bytes that pixel_stride = 0 selects for a format.
constexpr int32_t LeastStep(int32_t format) {
  const bool four = HasAlpha(format) || RefocusesAlpha(format);
  return SampleBytes(format) * (IsYuv(format) ? (IsPaired(format) ? 2 : 1) : four ? 4 : 3);
}

// Returns the planes of a valid image. The type parameter Byte is const for input images.
template <class Byte>
ImagePlanes<Byte> PlanesOf(const starfocus_image& image) {
  ImagePlanes<Byte> of = {};
  const int32_t format = of.format = image.format;
  of.is_yuv = IsYuv(format);
  of.blue_first = format == STARFOCUS_FORMAT_BGR || format == STARFOCUS_FORMAT_BGRX;
  of.has_alpha = HasAlpha(format);
  of.refocuses_alpha = RefocusesAlpha(format);
  of.step = static_cast<uint32_t>(image.pixel_stride != 0 ? image.pixel_stride : LeastStep(format));
  if (of.is_yuv) of.matrix = static_cast<uint8_t>(2 * image.matrix + image.range);
  for (int plane = 0; plane < 3; ++plane) {
    of.planes[plane] = static_cast<Byte*>(image.planes[plane]);
    of.strides[plane] = image.strides[plane];
  }
  if (IsPaired(format) && !IsDeep(format)) {
    const int u = format == STARFOCUS_FORMAT_NV12 ? 0 : 1;
    Byte* const chroma = of.planes[1];
    of.planes[1] = chroma + u;
    of.planes[2] = chroma + 1 - u;
    of.strides[2] = of.strides[1];
  }
  return of;
}

inline bool IsInPlace(const starfocus_image& image) {
  return image.format == STARFOCUS_FORMAT_RGB &&
         (image.pixel_stride == 0 || image.pixel_stride == 3);
}

// Returns the rows of a packed RGB image. The first row of the image is row `first` of the picture.
inline Plane<const uint8_t> RowsOf(const starfocus_image& image, int32_t first = 0) {
  return {static_cast<const uint8_t*>(image.planes[0]), image.strides[0], 0, first};
}

// Reads `count` pixels, starting at (x, y), and writes their codes to `rgb`.
void ReadCodes(const simd::ImageKernels& kernels, const ImageSource& image, int32_t x, int32_t y,
               int32_t count, uint8_t* rgb);

// Writes the first `width` pixels of row y. For YUV formats, writes only the luma. Alpha is set to
// 255.
void WriteCodes(const simd::ImageKernels& kernels, const uint8_t* rgb, int32_t width, int32_t y,
                const ImageTarget& image);

// Writes the chroma of rows y and y + 1; y is even. If the last row of the picture has no partner,
// pass this row twice.
void WriteChroma(const simd::ImageKernels& kernels, const uint8_t* upper, const uint8_t* lower,
                 int32_t width, int32_t y, const ImageTarget& image);

// Returns the rows of the alpha of an image, whose values are image.step bytes apart. The data is
// null if the image has no alpha.
Plane<const uint8_t> AlphaOf(const ImageSource& image);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_IO_IMAGE_H_
