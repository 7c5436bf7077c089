// SPDX-License-Identifier: Apache-2.0
// JPEG pixels by stb_image_write, where libjpeg-turbo is absent.
#include <stb/stb_image_write.h>

#include "platform/stb_memory.h"
#include "platform/writers/jpeg.h"

namespace starfocus {
namespace {

void Append(void* context, void* data, int size) {
  const uint8_t* first = static_cast<const uint8_t*>(data);
  Bytes* bytes = static_cast<Bytes*>(context);
  bytes->insert(bytes->end(), first, first + size);
}

}  // namespace

Result<Bytes> EncodeJpegPixels(const std::string& path, const Image& image, int quality) {
  const StbMemory memory;
  Bytes jpeg;
  if (stbi_write_jpg_to_func(Append, &jpeg, image.width, image.height, 3, image.pixels.data(),
                             quality)) {
    return jpeg;
  }
  return Expected(path, "a picture that can be encoded", "an encoder failure");
}

}  // namespace starfocus
