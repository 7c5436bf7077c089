// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/multi_picture.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "platform/readers/tiff_numbers.h"

namespace starfocus {
namespace {

constexpr size_t kEntrySize = 16;
constexpr uint32_t kEntryTag = 0xb002, kTypeBits = 0xffffff;

// An entry of the multi-picture index: the position and the type of a picture.
struct Entry {
  size_t begin = 0;
  uint32_t type = 0;
};

// Entries of the multi-picture index except the entry of the first picture. `counted` is the number
// of pictures that the index states, which may be too small after edits.
struct Index {
  std::vector<Entry> entries;
  size_t counted = 0;
};

Index ReadIndex(Span file, Span index, size_t pictures) {
  Index result;
  const TiffNumbers tiff(index);
  const size_t base = index.empty() ? 0 : static_cast<size_t>(index.data - file.data);
  const std::optional<size_t> tag = tiff.Entry(tiff.Whole(4, 4), kEntryTag);
  if (!tag) return result;
  const size_t count = tiff.Whole(*tag + 4, 4) / kEntrySize, first = tiff.Whole(*tag + 8, 4);
  result.counted = std::max(count, size_t{1}) - 1;
  for (size_t n = 1; n <= pictures; ++n) {
    const size_t at = first + n * kEntrySize;
    if (at > index.size || kEntrySize > index.size - at) break;
    result.entries.push_back({base + tiff.Whole(at + 8, 4), tiff.Whole(at, 4) & kTypeBits});
  }
  return result;
}

// Returns true if CIPA DC-007 defines the picture type. Unrelated bytes rarely match a defined
// type.
bool IsType(uint32_t type) {
  constexpr uint32_t kTypes[] = {0x000000, 0x010001, 0x010002, 0x020001,
                                 0x020002, 0x020003, 0x030000};
  return std::find(std::begin(kTypes), std::end(kTypes), type) != std::end(kTypes);
}

// Assigns types of the multi-picture index to pictures with matching positions. If no position
// matches, an editor has moved the pictures, and types are assigned in order.
void TakeIndex(Span file, const Index& index, std::vector<MultiPicture>* pictures) {
  const std::vector<Entry>& entries = index.entries;
  bool any = false;
  for (MultiPicture& picture : *pictures) {
    const auto begin = static_cast<size_t>(picture.file.data - file.data);
    for (size_t k = 0; k < entries.size(); ++k) {
      if (entries[k].begin != begin) continue;
      picture.type = entries[k].type;
      picture.indexed = k < index.counted;
      any = true;
    }
  }
  if (any) return;
  const size_t both = std::min(entries.size(), pictures->size());
  for (size_t k = 0; k < both; ++k) {
    if (IsType(entries[k].type)) (*pictures)[k].type = entries[k].type;
  }
}

}  // namespace

MultiPictures ListMultiPictures(Span file, const JpegParts& parts,
                                std::vector<AppendedPicture> appended) {
  std::vector<MultiPicture> pictures;
  for (AppendedPicture& picture : appended) {
    if (!picture.is_png) pictures.push_back({std::move(picture)});
  }
  const Index index = ReadIndex(file, parts.multi_picture, pictures.size());
  TakeIndex(file, index, &pictures);
  const bool missing = index.counted > pictures.size();
  return {std::move(pictures), missing};
}

}  // namespace starfocus
