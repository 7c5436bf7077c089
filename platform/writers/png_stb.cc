// SPDX-License-Identifier: Apache-2.0
// Encodes PNG with stb_image_write in builds without libpng.
#include <stb/stb_image_write.h>

#include <algorithm>

#include "platform/stb_memory.h"
#include "platform/writers/png.h"

namespace starfocus {
namespace {

Result<Bytes> Encode(const std::string& path, int width, int height, int channels,
                     const uint8_t* samples) {
  const StbMemory memory;
  Bytes png;
  if (stbi_write_png_to_func(AppendStb, &png, width, height, channels, samples, channels * width) &&
      !png.empty()) {
    return png;
  }
  return Expected(path, "a picture that can be encoded", "an encoder failure");
}

}  // namespace

Result<Bytes> EncodePng(const std::string& path, const Image& image, const Metadata&, PngSize) {
  return Encode(path, image.width, image.height, 3, image.pixels.data());
}

Result<Bytes> EncodeDeepPng(const std::string& path, const DeepImage&, const Metadata&, PngSize) {
  return Unsupported(path, "PNG of 16 bits", "libpng");
}

Result<Bytes> EncodeGreyPng(const std::string& path, const GreyImage& image) {
  Bytes samples;
  for (const uint16_t level : image.levels) {
    if (level > 255) {
      return Expected(path,
                      "levels up to 255, because this program was built without libpng, "
                      "which writes 16 bits",
                      std::to_string(level));
    }
    samples.push_back(static_cast<uint8_t>(level));
  }
  return Encode(path, image.width, image.height, 1, samples.data());
}

}  // namespace starfocus
