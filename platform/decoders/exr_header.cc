// SPDX-License-Identifier: Apache-2.0
#include "platform/decoders/exr_header.h"

#include <algorithm>

namespace starfocus {
namespace {

constexpr int kMostParts = 1000, kMostAttributes = 10000;

// Reads texts and numbers of a file. After an attempt to read beyond the end, `is_sound` is false.
struct ExrReader {
  const uint8_t *at, *end;
  bool is_sound = true;

  std::string Text() {
    const uint8_t* zero = std::find(at, end, 0);
    is_sound = is_sound && zero != end;
    std::string text(at, zero);
    if (is_sound) at = zero + 1;
    return text;
  }
  uint32_t Number() {
    uint32_t value = 0;
    is_sound = is_sound && end - at >= 4;
    for (int k = 3; k >= 0 && is_sound; --k) value = value << 8 | at[k];
    if (is_sound) at += 4;
    return value;
  }
};

}  // namespace

bool VisitExrAttributes(
    const uint8_t* file, size_t size,
    const std::function<void(const std::string& name, const uint8_t* value, size_t size)>& visit) {
  constexpr uint32_t kMultipleParts = 0x1000;
  ExrReader reader = {file, file + size};
  reader.Number();  // signature
  const bool has_parts = (reader.Number() & kMultipleParts) != 0;
  int parts = 0, attributes = 0;
  for (bool in_part = false; reader.is_sound;) {
    const std::string name = reader.Text();
    if (name.empty()) {
      // An empty name ends a part, and a second one ends the headers of several parts.
      if (!in_part || !has_parts) return reader.is_sound;
      in_part = false;
      continue;
    }
    if (!in_part && ++parts > kMostParts) return false;
    if (++attributes > kMostAttributes) return false;
    in_part = true;
    reader.Text();  // type
    const uint32_t length = reader.Number();
    if (!reader.is_sound || length > static_cast<size_t>(reader.end - reader.at)) return false;
    visit(name, reader.at, length);
    reader.at += length;
  }
  return false;
}

}  // namespace starfocus
