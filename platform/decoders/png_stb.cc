// SPDX-License-Identifier: Apache-2.0
// PNG by stb_image, where libpng is absent.
#include "platform/decoders/png.h"
#include "platform/decoders/stb_pixels.h"
#include "platform/png.h"
#include "platform/stb_memory.h"

namespace starfocus {
namespace {

Error DecodeIndices(const std::string& where, const PngHeader& header, Bytes bytes, Image* image) {
  const StbMemory memory;
  const Bytes palette = TakePalette(&bytes);
  const int colours = static_cast<int>(palette.size() / 3), step = GreyStep(header);
  Image result;
  const uint8_t* levels = LoadStb(bytes, 1, &result);
  if (levels == nullptr) return StbFailed(where);
  for (size_t i = 0; i < result.pixels.size() / 3; ++i) {
    const int index = levels[i] / step;
    if (index >= colours) {
      return Expected(where, "indices below the palette's " + std::to_string(colours) + " colours",
                      std::to_string(index));
    }
    for (size_t c = 0; c < 3; ++c) result.pixels[3 * i + c] = palette[3 * size_t(index) + c];
  }
  *image = std::move(result);
  return {};
}

}  // namespace

Error DecodePngPixels(const std::string& where, const Bytes& png, Image* image, Metadata*) {
  const Error error = CheckStbContainer(where, png);
  PngHeader header = {};
  if (error || !ReadPngHeader(png, &header)) return error;
  return HasPalette(header) ? DecodeIndices(where, header, png, image)
                            : DecodeStb(where, png, image);
}

}  // namespace starfocus
