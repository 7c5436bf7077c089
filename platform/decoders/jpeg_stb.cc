// SPDX-License-Identifier: Apache-2.0
// Decodes JPEG with stb_image in builds without libjpeg-turbo.
#include <stb/stb_image.h>

#include "platform/container.h"
#include "platform/decoders/jpeg.h"
#include "platform/decoders/limits.h"
#include "platform/decoders/stb_pixels.h"
#include "platform/stb_memory.h"

namespace starfocus {

Result<Image> DecodeJpeg(const std::string& where, const Bytes& jpeg) {
  if (Error error = CheckStbContainer(where, jpeg)) return error;
  int width = 0, height = 0, channels = 0;
  {
    const StbMemory memory;
    if (!stbi_info_from_memory(jpeg.data(), static_cast<int>(jpeg.size()), &width, &height,
                               &channels)) {
      return StbFailed(where);
    }
  }
  if (Error error = CheckPictureSize(where, width, height)) return error;
  // Check the size first: stb_image would allocate and fill hundreds of megabytes for a file of a
  // few bytes.
  return JpegCanHold(jpeg.size(), false, width, height) ? DecodeStb(where, jpeg)
                                                        : Truncated(where, "JPEG");
}

}  // namespace starfocus
