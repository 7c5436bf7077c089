// SPDX-License-Identifier: Apache-2.0
#include "platform/writers/exif.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "starfocus/version.h"

namespace starfocus {
namespace {

constexpr uint32_t kOrientation = 0x0112, kSoftware = 0x0131, kExifFolder = 0x8769;
constexpr uint32_t kPixelWidth = 0xa002, kPixelHeight = 0xa003;
constexpr uint32_t kSubjectArea = 0x9214, kSubjectLocation = 0xa214;
constexpr uint32_t kAscii = 2, kShort = 3, kLong = 4;
constexpr size_t kEntry = 12;  // bytes of an entry: tag, type, count, and value or its position

// Reads and writes numbers of a TIFF structure in the byte order of the structure.
class Tiff {
 public:
  explicit Tiff(Bytes* bytes) : bytes_(*bytes), little_(!bytes->empty() && bytes->front() == 'I') {}

  bool Has(size_t at, size_t size) const {
    return at <= bytes_.size() && size <= bytes_.size() - at;
  }
  uint32_t Get(size_t at, size_t size) const {
    uint32_t value = 0;
    for (size_t i = 0; i < size; ++i) {
      value = value << 8 | bytes_[at + (little_ ? size - 1 - i : i)];
    }
    return value;
  }
  void Set(size_t at, size_t size, uint32_t value) {
    for (size_t i = 0; i < size; ++i) {
      bytes_[at + (little_ ? i : size - 1 - i)] = static_cast<uint8_t>(value >> (8 * i));
    }
  }
  // Removes an entry from an IFD (a list of EXIF tags) with `count` entries. Moves the entries that
  // follow the removed entry up.
  void Remove(size_t folder, size_t entry, size_t count) {
    const size_t end = folder + 2 + count * kEntry + 4;
    std::copy(bytes_.begin() + static_cast<ptrdiff_t>(entry + kEntry),
              bytes_.begin() + static_cast<ptrdiff_t>(end),
              bytes_.begin() + static_cast<ptrdiff_t>(entry));
    Set(folder, 2, static_cast<uint32_t>(count - 1));
  }
  // Returns the positions of the entries of the IFD at the offset `folder`, or nullopt if the IFD
  // is truncated.
  std::optional<std::vector<size_t>> Entries(size_t folder) const {
    const size_t count = Has(folder, 2) ? Get(folder, 2) : 0;
    if (!Has(folder, 2 + count * kEntry + 4)) return {};
    std::vector<size_t> places(count);
    for (size_t k = 0; k < count; ++k) places[k] = folder + 2 + k * kEntry;
    return places;
  }

 private:
  Bytes& bytes_;
  const bool little_;
};

bool IsTiff(const Bytes& bytes, const Tiff& tiff) {
  if (bytes.size() < 8 || bytes[0] != bytes[1]) return false;
  return (bytes[0] == 'I' || bytes[0] == 'M') && tiff.Get(2, 2) == 42;
}

// Removes the tags SubjectArea and SubjectLocation from the IFD at the offset `folder`. SubjectArea
// and SubjectLocation contain pixel coordinates of the original picture. Keeps both tags if
// `turned` is false and the size tags of the IFD match `width` and `height`.
void RemoveSubject(size_t folder, int width, int height, bool turned, Tiff* tiff) {
  const auto entries = tiff->Entries(folder);
  if (!entries) return;
  bool same_width = false, same_height = false;
  for (const size_t at : *entries) {
    const uint32_t tag = tiff->Get(at, 2), type = tiff->Get(at + 2, 2);
    if (type != kShort && type != kLong) continue;
    const uint32_t value = tiff->Get(at + 8, type == kShort ? 2 : 4);
    same_width = same_width || (tag == kPixelWidth && value == static_cast<uint32_t>(width));
    same_height = same_height || (tag == kPixelHeight && value == static_cast<uint32_t>(height));
  }
  if (!turned && same_width && same_height) return;
  size_t removed = 0;
  for (const size_t place : *entries) {
    const size_t at = place - removed * kEntry;
    const uint32_t tag = tiff->Get(at, 2);
    if (tag != kSubjectArea && tag != kSubjectLocation) continue;
    tiff->Remove(folder, at, entries->size() - removed++);
  }
}

// Sets the tags PixelXDimension and PixelYDimension if the IFD at the offset `folder` has them.
void SetSizes(size_t folder, int width, int height, Tiff* tiff) {
  const auto entries = tiff->Entries(folder);
  if (!entries) return;
  for (const size_t at : *entries) {
    const uint32_t tag = tiff->Get(at, 2), type = tiff->Get(at + 2, 2);
    if ((tag != kPixelWidth && tag != kPixelHeight) || (type != kShort && type != kLong)) continue;
    tiff->Set(at + 8, type == kShort ? 2 : 4,
              static_cast<uint32_t>(tag == kPixelWidth ? width : height));
  }
}

}  // namespace

Bytes EditedExif(const Bytes& exif, int width, int height) {
  const std::string software = "starfocus " STARFOCUS_VERSION_STRING;
  Bytes bytes = exif;
  Tiff tiff(&bytes);
  if (!IsTiff(bytes, tiff)) return {};
  const auto old_entries = tiff.Entries(tiff.Get(4, 4));
  if (!old_entries) return {};
  // tag and position of each entry, sorted by tag
  std::vector<std::pair<uint32_t, size_t>> entries;
  bool turned = false;
  for (const size_t at : *old_entries) {
    const uint32_t tag = tiff.Get(at, 2);
    if (tag == kOrientation) turned = tiff.Get(at + 8, 2) != 1;  // EXIF folder follows
    if (tag == kExifFolder) {
      RemoveSubject(tiff.Get(at + 8, 4), width, height, turned, &tiff);
      SetSizes(tiff.Get(at + 8, 4), width, height, &tiff);
    }
    if (tag != kOrientation && tag != kSoftware) entries.emplace_back(tag, at);
  }
  entries.emplace_back(kOrientation, 0);
  entries.emplace_back(kSoftware, 0);
  std::sort(entries.begin(), entries.end());

  // Append the new list of tags at the end. Other data must not move, since a TIFF structure refers
  // to values by their positions.
  bytes.resize((bytes.size() + 1) & ~size_t{1});
  const size_t folder = bytes.size(), text = folder + 2 + entries.size() * kEntry + 4;
  bytes.resize(text);
  bytes.insert(bytes.end(), software.begin(), software.end());
  bytes.push_back(0);
  tiff.Set(4, 4, static_cast<uint32_t>(folder));
  tiff.Set(folder, 2, static_cast<uint32_t>(entries.size()));
  size_t at = folder + 2;
  for (const auto& [tag, old] : entries) {
    if (old != 0) {
      std::copy_n(bytes.begin() + static_cast<ptrdiff_t>(old), kEntry,
                  bytes.begin() + static_cast<ptrdiff_t>(at));
    } else {
      const bool name = tag == kSoftware;
      tiff.Set(at, 2, tag);
      tiff.Set(at + 2, 2, name ? kAscii : kShort);
      tiff.Set(at + 4, 4, name ? static_cast<uint32_t>(software.size() + 1) : 1);
      tiff.Set(at + 8, name ? 4 : 2, name ? static_cast<uint32_t>(text) : 1);
    }
    at += kEntry;
  }
  // The position of the next IFD, which would contain a thumbnail, stays 0: the file has no
  // thumbnail.
  return bytes;
}

}  // namespace starfocus
