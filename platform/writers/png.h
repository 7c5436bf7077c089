// SPDX-License-Identifier: Apache-2.0
// PNG files.
#ifndef STARFOCUS_PLATFORM_WRITERS_PNG_H_
#define STARFOCUS_PLATFORM_WRITERS_PNG_H_

#include <cstdint>
#include <string>
#include <vector>

#include "platform/image.h"
#include "platform/metadata.h"
#include "platform/result.h"

namespace starfocus {

// Grey levels, rows without padding.
struct GreyImage {
  int width = 0, height = 0;
  std::vector<uint16_t> levels;
};

// How much time goes into a small file: kSmall takes about 17 times as long for 5 to 7 % less.
enum class PngSize { kQuick, kSmall };

// 8 bits of R, G, B, as all pictures of the engine have. By libpng and libdeflate where the build
// has them, with metadata changed to what is true of the picture (exif.h); else by stb_image_write,
// without any and of one size. `path` only names the file in errors, here and below.
Result<Bytes> EncodePng(const std::string& path, const Image& image, const Metadata& metadata,
                        PngSize size);

// Levels as they are, in 8 bits where all have room there, else in 16, which only libpng writes.
Result<Bytes> EncodeGreyPng(const std::string& path, const GreyImage& image);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_WRITERS_PNG_H_
