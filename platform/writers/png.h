// SPDX-License-Identifier: Apache-2.0
// Writes PNG files.
#ifndef STARFOCUS_PLATFORM_WRITERS_PNG_H_
#define STARFOCUS_PLATFORM_WRITERS_PNG_H_

#include <cstdint>
#include <string>
#include <vector>

#include "platform/image.h"
#include "platform/metadata.h"
#include "platform/result.h"

namespace starfocus {

// A grey picture whose rows have no padding.
struct GreyImage {
  int width = 0, height = 0;
  std::vector<uint16_t> levels;
};

// Trade-off between time and file size: kSmall takes about 17 times as long as kQuick and makes
// files 5 to 7 % smaller.
enum class PngSize { kQuick, kSmall };

// Encodes a picture with 8 bits per sample. In builds with libpng and libdeflate, writes metadata
// with EXIF edited to match the picture (exif.h). Builds without libpng or libdeflate use
// stb_image_write, which writes no metadata and ignores `size`. In all functions of this header,
// `path` appears only in error messages.
Result<Bytes> EncodePng(const std::string& path, const Image& image, const Metadata& metadata,
                        PngSize size);

// Encodes codes of 16 bits, with alpha if the picture has it. Requires libpng.
Result<Bytes> EncodeDeepPng(const std::string& path, const DeepImage& image,
                            const Metadata& metadata, PngSize size);

// Encodes grey levels without scaling: with 8 bits if all levels are at most 255, otherwise with 16
// bits. Levels of 16 bits require libpng.
Result<Bytes> EncodeGreyPng(const std::string& path, const GreyImage& image);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_WRITERS_PNG_H_
