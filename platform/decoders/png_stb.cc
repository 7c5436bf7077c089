// SPDX-License-Identifier: Apache-2.0
// Decodes PNG with stb_image in builds without libpng.
#include "platform/decoders/png.h"
#include "platform/decoders/stb_pixels.h"
#include "platform/png.h"
#include "platform/stb_memory.h"

namespace starfocus {
namespace {

Result<Image> DecodeIndices(const std::string& where, const PngHeader& header, Bytes bytes) {
  const StbMemory memory;
  const Bytes palette = TakePalette(&bytes);
  const int colours = static_cast<int>(palette.size() / 3), step = GreyStep(header);
  Image result;
  const uint8_t* levels = LoadStb(bytes, 1, &result);
  if (levels == nullptr) return StbFailed(where);
  for (size_t i = 0; i < result.pixels.size() / 3; ++i) {
    const int index = levels[i] / step;
    if (index >= colours) {
      return Expected(where, "palette indices below " + std::to_string(colours),
                      std::to_string(index));
    }
    for (size_t c = 0; c < 3; ++c) result.pixels[3 * i + c] = palette[3 * size_t(index) + c];
  }
  return result;
}

}  // namespace

Result<DecodedPicture> DecodePngPixels(const std::string& where, const Bytes& png) {
  if (Error error = CheckStbContainer(where, png)) return error;
  const PngHeader header = *ReadPngHeader(png);
  return WithoutMetadata(HasPalette(header) ? DecodeIndices(where, header, png)
                                            : DecodeStb(where, png));
}

}  // namespace starfocus
