// SPDX-License-Identifier: Apache-2.0
#include "platform/decoders/stb_pixels.h"

#include <stb/stb_image.h>

#include "platform/container.h"
#include "platform/decoders/limits.h"
#include "platform/stb_memory.h"

namespace starfocus {

Error CheckStbContainer(const std::string& where, const Bytes& bytes) {
  const Container container = CheckContainer(bytes);
  if (container == Container::kWhole) return {};
  if (container == Container::kTruncated) return Truncated(where, IsPng(bytes) ? "PNG" : "JPEG");
  return Expected(where, "an undamaged picture", "a damaged one (checksum or code table)");
}

const uint8_t* LoadStb(const Bytes& bytes, int channels, Image* image) {
  int own_channels = 0;
  const stbi_uc* samples =
      stbi_load_from_memory(bytes.data(), static_cast<int>(bytes.size()), &image->width,
                            &image->height, &own_channels, channels);
  if (samples != nullptr) *image = Image(image->width, image->height);
  return samples;
}

Error StbFailed(const std::string& where) {
  return Expected(where, "an undamaged picture",
                  "a damaged one (" + std::string(stbi_failure_reason()) + ")");
}

Result<Image> DecodeStb(const std::string& where, const Bytes& bytes) {
  const StbMemory memory;
  Image result;
  const uint8_t* samples = LoadStb(bytes, 3, &result);
  if (samples == nullptr) return StbFailed(where);
  result.pixels.assign(samples, samples + result.pixels.size());
  return result;
}

}  // namespace starfocus
