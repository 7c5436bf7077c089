// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/multi_picture.h"

namespace starfocus {
namespace {

constexpr size_t kMostPictures = 64, kEntrySize = 16;
constexpr uint32_t kEntryTag = 0xb002;

// Whole numbers of a TIFF header in either byte order; 0 beyond its end.
struct Tiff {
  Span bytes;
  bool little = false;

  uint32_t Whole(size_t at, size_t size) const {
    if (at > bytes.size || size > bytes.size - at) return 0;
    uint32_t value = 0;
    for (size_t k = 0; k < size; ++k) {
      value = value << 8 | bytes.data[little ? at + size - 1 - k : at + k];
    }
    return value;
  }
};

// Where the entries lie and how many there are, from the first directory.
bool FindEntries(const Tiff& tiff, size_t* at, size_t* count) {
  const size_t directory = tiff.Whole(4, 4), tags = tiff.Whole(directory, 2);
  for (size_t k = 0; k < tags; ++k) {
    const size_t tag = directory + 2 + 12 * k;
    if (tag >= tiff.bytes.size) return false;
    if (tiff.Whole(tag, 2) != kEntryTag) continue;
    *count = tiff.Whole(tag + 4, 4) / kEntrySize;
    *at = tiff.Whole(tag + 8, 4);
    return true;
  }
  return false;
}

}  // namespace

std::string ListMultiPictures(const std::string& where, Span file, const JpegParts& parts,
                              std::vector<Span>* pictures) {
  if (parts.multi_picture.size < 8) return "";
  const Tiff tiff = {parts.multi_picture, parts.multi_picture.data[0] == 'I'};
  size_t entries = 0, count = 0;
  if (!FindEntries(tiff, &entries, &count)) return "";
  if (count > kMostPictures) {
    return Expected(where, "a multi-picture file of at most " + std::to_string(kMostPictures),
                    std::to_string(count));
  }
  const auto base = static_cast<size_t>(parts.multi_picture.data - file.data);
  for (size_t k = 1; k < count; ++k) {
    const size_t entry = entries + k * kEntrySize;
    const size_t size = tiff.Whole(entry + 4, 4), offset = tiff.Whole(entry + 8, 4);
    if (offset > file.size - base || size > file.size - base - offset) continue;  // cut off
    pictures->push_back({file.data + base + offset, size});
  }
  return "";
}

}  // namespace starfocus
