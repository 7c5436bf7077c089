// SPDX-License-Identifier: Apache-2.0
#include "platform/decoders/limits.h"

#include "platform/image.h"
#include "platform/text.h"

namespace starfocus {
namespace {

// Limit of the number of pixels. The library stb_image counts bytes in an int. It reads at most
// 2^30 samples of a PNG file, which may have four samples per pixel.
constexpr int64_t kMostPixels = int64_t{1} << 28;

}  // namespace

Error CheckPictureSize(const std::string& where, int64_t width, int64_t height) {
  const std::string size = SizeText(width, height);
  if (width < 1 || height < 1 || width > kMaxPictureSize || height > kMaxPictureSize) {
    return Expected(where, "width and height from 1 to 65535", size);
  }
  if (width * height <= kMostPixels) return {};
  return Expected(where, "a picture of at most 2^28 pixels", size);
}

bool JpegCanHold(size_t bytes, bool arithmetic, int64_t width, int64_t height) {
  constexpr int64_t kMostPixelsPerByte = 8 * 8 * 32, kOneUnit = 32 * 32;
  const int64_t most = kMostPixelsPerByte * (arithmetic ? 16 : 1);
  return width * height <= kOneUnit + most * static_cast<int64_t>(bytes);
}

}  // namespace starfocus
