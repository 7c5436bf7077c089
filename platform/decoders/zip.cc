// SPDX-License-Identifier: Apache-2.0
#include "platform/decoders/zip.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "platform/container.h"

namespace starfocus {
namespace {

constexpr uint32_t kLocalHeader = 0x04034b50, kDirectoryEntry = 0x02014b50;
constexpr uint32_t kEnd = 0x06054b50, kEnd64 = 0x06064b50, kEnd64Locator = 0x07064b50;
constexpr uint64_t kLocalBytes = 30, kEntryBytes = 46, kEndBytes = 22, kEnd64Bytes = 56;
constexpr uint64_t kLocatorBytes = 20, kMostComment = 65535, kMostEntries = 1000;
constexpr uint64_t kIn64 = UINT32_MAX;  // A 32-bit number whose 64-bit value is stored elsewhere.
constexpr int kStored = 0, kDeflated = 8;
// Deflate expands a byte to at most 1032 bytes.
constexpr uint64_t kMostExpansion = 1032;
constexpr uint64_t kMostBytes = uint64_t{1} << 31;  // Limit of all files (file.h).

Error Damaged(const std::string& where, const std::string& found) {
  return Expected(where, "an undamaged ZIP archive", found);
}

// Little-endian numbers at positions of an archive. Each position must be checked with Has before.
class Reader {
 public:
  explicit Reader(const Bytes& zip) : zip_(zip) {}

  bool Has(uint64_t at, uint64_t bytes) const {
    return at <= zip_.size() && bytes <= zip_.size() - at;
  }
  // Returns true if the archive has `bytes` bytes at `at`, which start with a signature.
  bool Has(uint64_t at, uint64_t bytes, uint32_t signature) const {
    return Has(at, bytes) && Number(at, 4) == signature;
  }
  uint64_t Number(uint64_t at, size_t bytes) const {
    uint64_t value = 0;
    for (size_t k = 0; k < bytes; ++k) value |= uint64_t{zip_[size_t(at) + k]} << 8 * k;
    return value;
  }
  std::string Text(uint64_t at, uint64_t bytes) const {
    const auto first = zip_.begin() + static_cast<ptrdiff_t>(at);
    return {first, first + static_cast<ptrdiff_t>(bytes)};
  }

 private:
  const Bytes& zip_;
};

struct Directory {
  uint64_t at, entries;
};

// Finds the directory by the record at the end of the archive, which a comment may follow.
std::optional<Directory> FindDirectory(const Bytes& zip) {
  const Reader read(zip);
  const uint64_t size = zip.size();
  if (size < kEndBytes) return {};
  uint64_t end = size - kEndBytes;
  const uint64_t first = end - std::min(end, kMostComment);
  while (!read.Has(end, kEndBytes, kEnd)) {
    if (end == first) return {};
    --end;
  }
  const Directory own = {read.Number(end + 16, 4), read.Number(end + 10, 2)};
  if (end < kLocatorBytes || !read.Has(end - kLocatorBytes, kLocatorBytes, kEnd64Locator)) {
    return own;
  }
  const uint64_t end64 = read.Number(end - kLocatorBytes + 8, 8);
  if (!read.Has(end64, kEnd64Bytes, kEnd64)) return {};
  return Directory{read.Number(end64 + 48, 8), read.Number(end64 + 32, 8)};
}

// Replaces numbers of an entry by their 64-bit values in the extra field of ZIP64, which stores
// only the replaced numbers. Returns false if a value is missing.
bool Read64(const Reader& read, uint64_t at, uint64_t end, ZipEntry* entry) {
  constexpr uint64_t kZip64 = 1;
  std::vector<uint64_t*> wanted;
  for (uint64_t* number : {&entry->bytes, &entry->packed, &entry->at}) {
    if (*number == kIn64) wanted.push_back(number);
  }
  while (!wanted.empty() && end - at >= 4) {
    const uint64_t kind = read.Number(at, 2), size = read.Number(at + 2, 2);
    at += 4;
    if (size > end - at) return false;
    if (kind == kZip64) {
      if (size < 8 * wanted.size()) return false;
      for (uint64_t* number : wanted) {
        *number = read.Number(at, 8);
        at += 8;
      }
      return true;
    }
    at += size;
  }
  return wanted.empty();
}

// Reads the entry at position *at of the directory, and moves *at behind the entry.
std::optional<ZipEntry> ReadEntry(const Reader& read, uint64_t* at) {
  if (!read.Has(*at, kEntryBytes, kDirectoryEntry)) return {};
  const uint64_t name = read.Number(*at + 28, 2), extra = read.Number(*at + 30, 2);
  const uint64_t comment = read.Number(*at + 32, 2), begin = *at + kEntryBytes;
  if (!read.Has(begin, name + extra + comment)) return {};
  ZipEntry entry;
  entry.name = read.Text(begin, name);
  entry.is_encrypted = (read.Number(*at + 8, 2) & 1) != 0;
  entry.method = static_cast<int>(read.Number(*at + 10, 2));
  entry.crc = static_cast<uint32_t>(read.Number(*at + 16, 4));
  entry.packed = read.Number(*at + 20, 4);
  entry.bytes = read.Number(*at + 24, 4);
  entry.at = read.Number(*at + 42, 4);
  if (!Read64(read, begin + name, begin + name + extra, &entry)) return {};
  *at = begin + name + extra + comment;
  return entry;
}

}  // namespace

bool IsZip(const Bytes& bytes) { return Reader(bytes).Has(0, 4, kLocalHeader); }

Result<std::vector<ZipEntry>> ListZip(const std::string& where, const Bytes& zip) {
  const std::optional<Directory> directory = FindDirectory(zip);
  if (!directory) return Truncated(where, "ZIP");
  if (directory->entries > kMostEntries) {
    return Expected(where, "a ZIP archive of at most " + std::to_string(kMostEntries) + " files",
                    std::to_string(directory->entries));
  }
  const Reader read(zip);
  std::vector<ZipEntry> entries;
  uint64_t at = directory->at, left = zip.size();
  for (uint64_t k = 0; k < directory->entries; ++k) {
    std::optional<ZipEntry> entry = ReadEntry(read, &at);
    if (!entry) return Damaged(where, "a directory that cannot be read");
    // Files that overlap would let a small archive expand to any size.
    if (entry->packed > left || entry->bytes / kMostExpansion > entry->packed) {
      return Damaged(where, "an archive that is too small for its files");
    }
    if (entry->bytes > kMostBytes) {
      return Expected(where, "files of at most 2 GiB", std::to_string(entry->bytes) + " bytes");
    }
    left -= entry->packed;
    entries.push_back(std::move(*entry));
  }
  return entries;
}

Result<Bytes> ReadZipEntry(const std::string& where, const Bytes& zip, const ZipEntry& entry) {
  if (entry.is_encrypted) return Expected(where, "a ZIP archive without a password", "one");
  if (entry.method != kStored && entry.method != kDeflated) {
    return Expected(where, "files that are stored or compressed by Deflate",
                    "compression method " + std::to_string(entry.method));
  }
  const Reader read(zip);
  if (!read.Has(entry.at, kLocalBytes, kLocalHeader)) return Damaged(where, "no header of a file");
  const uint64_t begin =
      entry.at + kLocalBytes + read.Number(entry.at + 26, 2) + read.Number(entry.at + 28, 2);
  if (!read.Has(begin, entry.packed)) return Truncated(where, "ZIP");
  const uint8_t* packed = zip.data() + begin;
  if (entry.method == kStored && entry.packed != entry.bytes) {
    return Damaged(where, "two sizes of a file that is not compressed");
  }
  Bytes bytes(static_cast<size_t>(entry.bytes));
  if (entry.method == kStored) {
    std::copy_n(packed, entry.packed, bytes.begin());
  } else if (Error error = Inflate(where, packed, static_cast<size_t>(entry.packed), &bytes)) {
    return error;
  }
  if (Crc32(bytes.data(), bytes.size()) != entry.crc) return Damaged(where, "a wrong checksum");
  return bytes;
}

}  // namespace starfocus
