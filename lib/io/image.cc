// SPDX-License-Identifier: Apache-2.0
#include "lib/io/image.h"

#include <cstring>

#include "lib/base/fixed.h"

namespace starfocus {
namespace {

// Largest number of chroma samples that are converted at once, in arrays on the stack.
constexpr int32_t kPiece = 256;

// Returns true if samples of U and V alternate in one plane. *first is set to the plane of the
// first sample.
template <class Byte>
bool ArePairs(const ImagePlanes<Byte>& image, int* first) {
  if (image.step != 2 || image.strides[1] != image.strides[2]) return false;
  const auto u = reinterpret_cast<uintptr_t>(image.planes[1]);
  const auto v = reinterpret_cast<uintptr_t>(image.planes[2]);
  *first = u < v ? 1 : 2;
  return u + 1 == v || v + 1 == u;
}

// Points samples[0] and samples[1] to `count` <= kPiece consecutive samples of U and V: in place if
// possible, otherwise copied to `room`.
void FindChroma(const simd::ImageKernels& kernels, const ImageSource& image, int32_t x, int32_t y,
                size_t count, uint8_t room[2][kPiece], const uint8_t* samples[2]) {
  int first = 1;
  const bool pairs = ArePairs(image, &first);
  if (pairs) {
    kernels.DeinterleavePairs(image.Chroma(first, x, y), count, room[first - 1], room[2 - first]);
  }
  for (int k = 0; k < 2; ++k) {
    const uint8_t* const from = image.Chroma(k + 1, x, y);
    samples[k] = image.step == 1 ? from : room[k];
    if (image.step == 1 || pairs) continue;
    for (size_t n = 0; n < count; ++n) room[k][n] = from[n * image.step];
  }
}

void ReadYuv(const simd::ImageKernels& kernels, const ImageSource& image, int32_t x, int32_t y,
             int32_t count, uint8_t* rgb) {
  for (const int32_t end = x + count; x < end;) {
    // If x is odd, convert one pixel first to align with the chroma samples.
    const int32_t piece = x % 2 != 0 ? 1 : Min(2 * kPiece, end - x);
    const auto pixels = static_cast<size_t>(piece);
    uint8_t room[2][kPiece];
    const uint8_t* chroma[2];
    FindChroma(kernels, image, x, y, (pixels + 1) / 2, room, chroma);
    kernels.YuvToRgb(image.Luma(x, y), chroma[0], chroma[1], pixels, image.Matrix(), rgb);
    x += piece;
    rgb += 3 * piece;
  }
}

}  // namespace

void ReadCodes(const simd::ImageKernels& kernels, const ImageSource& image, int32_t x, int32_t y,
               int32_t count, uint8_t* rgb) {
  const auto pixels = static_cast<size_t>(count);
  if (image.is_yuv) {
    ReadYuv(kernels, image, x, y, count, rgb);
  } else if (image.IsPacked()) {
    std::memcpy(rgb, image.Pixel(x, y), 3 * pixels);
  } else {
    const auto convert = image.step <= 4 ? kernels.PixelsToRgb : simd::reference::PixelsToRgb;
    convert(image.Pixel(x, y), pixels, image.step, image.blue_first, rgb);
  }
}

void WriteCodes(const simd::ImageKernels& kernels, const uint8_t* rgb, int32_t width, int32_t y,
                const ImageTarget& image) {
  const auto count = static_cast<size_t>(width);
  if (image.is_yuv) {
    kernels.RgbToLuma(rgb, count, image.Matrix(), image.Luma(0, y));
  } else if (image.IsPacked()) {
    std::memcpy(image.Pixel(0, y), rgb, 3 * count);
  } else if (image.step == (image.has_alpha ? 4 : 3)) {
    kernels.RgbToPixels(rgb, count, image.step, image.blue_first, image.Pixel(0, y));
  } else {
    // No SIMD kernel supports other pixel strides.
    const size_t red = image.blue_first ? 2 : 0;
    for (int32_t x = 0; x < width; ++x, rgb += 3) {
      uint8_t* const pixel = image.Pixel(x, y);
      pixel[red] = rgb[0];
      pixel[1] = rgb[1];
      pixel[2 - red] = rgb[2];
      if (image.has_alpha) pixel[3] = 255;
    }
  }
}

void WriteChroma(const simd::ImageKernels& kernels, const uint8_t* upper, const uint8_t* lower,
                 int32_t width, int32_t y, const ImageTarget& image) {
  int first = 1;
  const bool pairs = ArePairs(image, &first);
  for (int32_t x = 0; x < width; x += 2 * kPiece) {
    const auto piece = static_cast<size_t>(Min(2 * kPiece, width - x)), samples = (piece + 1) / 2;
    const size_t at = 3 * static_cast<size_t>(x);
    uint8_t own[2][kPiece];
    const bool in_place = image.step == 1;
    kernels.RgbToChroma(upper + at, lower + at, piece, image.Matrix(),
                        in_place ? image.Chroma(1, x, y) : own[0],
                        in_place ? image.Chroma(2, x, y) : own[1]);
    if (pairs) {
      kernels.JoinPairs(own[first - 1], own[2 - first], samples, image.Chroma(first, x, y));
    } else if (!in_place) {
      for (int plane = 1; plane <= 2; ++plane) {
        uint8_t* out = image.Chroma(plane, x, y);
        for (size_t k = 0; k < samples; ++k) out[k * image.step] = own[plane - 1][k];
      }
    }
  }
}

Plane<const uint8_t> AlphaOf(const ImageSource& image) {
  if (!image.has_alpha) return {};
  return {image.planes[0] + 3, image.strides[0], 0, 0};
}

}  // namespace starfocus
