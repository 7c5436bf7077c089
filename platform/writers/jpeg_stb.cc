// SPDX-License-Identifier: Apache-2.0
// Encodes JPEG pixels with stb_image_write in builds without libjpeg-turbo.
#include <stb/stb_image_write.h>

#include "platform/stb_memory.h"
#include "platform/writers/jpeg.h"

namespace starfocus {

Result<Bytes> EncodeJpegPixels(const std::string& path, const Samples8& picture, int quality,
                               RowGate* rows) {
  if (rows != nullptr) rows->WaitFor(picture.height - 1);
  const StbMemory memory;
  Bytes jpeg;
  if (stbi_write_jpg_to_func(AppendStb, &jpeg, picture.width, picture.height, picture.channels,
                             picture.samples, quality)) {
    return jpeg;
  }
  return Expected(path, "a picture that can be encoded", "an encoder failure");
}

}  // namespace starfocus
