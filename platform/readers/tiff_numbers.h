// SPDX-License-Identifier: Apache-2.0
// Reads the numbers of TIFF structures: the multi-picture index and EXIF.
#ifndef STARFOCUS_PLATFORM_READERS_TIFF_NUMBERS_H_
#define STARFOCUS_PLATFORM_READERS_TIFF_NUMBERS_H_

#include <cstddef>
#include <cstdint>
#include <optional>

#include "platform/readers/jpeg_parts.h"

namespace starfocus {

// Reads integers in the byte order that the first byte of a TIFF header states. If a read extends
// past the end, the result is 0.
struct TiffNumbers {
  Span bytes;
  bool little = false;

  explicit TiffNumbers(Span tiff) : bytes(tiff), little(tiff.size > 0 && tiff.data[0] == 'I') {}
  TiffNumbers(Span tiff, bool is_little) : bytes(tiff), little(is_little) {}

  uint32_t Whole(size_t at, size_t size) const {
    if (at > bytes.size || size > bytes.size - at) return 0;
    uint32_t value = 0;
    for (size_t k = 0; k < size; ++k) {
      value = value << 8 | bytes.data[little ? at + size - 1 - k : at + k];
    }
    return value;
  }

  // Returns the position of the entry `tag` of the directory at `directory`, or nullopt if the
  // directory does not have the entry.
  std::optional<size_t> Entry(size_t directory, uint32_t tag) const {
    constexpr size_t kEntry = 12;  // bytes: tag, type, number of values, and value or its position
    const size_t count = Whole(directory, 2);
    for (size_t k = 0; k < count && directory + kEntry * k < bytes.size; ++k) {
      const size_t at = directory + 2 + kEntry * k;
      if (Whole(at, 2) == tag) return at;
    }
    return std::nullopt;
  }
};

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_TIFF_NUMBERS_H_
