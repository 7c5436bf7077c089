// SPDX-License-Identifier: Apache-2.0
#include "platform/decoders/exif_bytes.h"

#include <algorithm>

namespace starfocus {

void TrimExif(Bytes* exif) {
  constexpr uint8_t kHeader[] = {'E', 'x', 'i', 'f', 0, 0};
  if (exif->size() >= sizeof(kHeader) &&
      std::equal(kHeader, kHeader + sizeof(kHeader), exif->begin())) {
    exif->erase(exif->begin(), exif->begin() + sizeof(kHeader));
  }
  const bool tiff =
      exif->size() >= 8 && (*exif)[0] == (*exif)[1] && ((*exif)[0] == 'I' || (*exif)[0] == 'M');
  if (!tiff) exif->clear();
}

}  // namespace starfocus
