// SPDX-License-Identifier: Apache-2.0
#include "platform/container.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <numeric>

#include "platform/decoders/tiff.h"

namespace starfocus {
namespace {

constexpr uint8_t kPngSignature[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
constexpr uint8_t kJpegSignature[] = {0xff, 0xd8};

template <size_t kSize>
bool StartsWith(const Bytes& bytes, const uint8_t (&signature)[kSize]) {
  return bytes.size() >= kSize && std::equal(signature, signature + kSize, bytes.begin());
}

// Table for the CRC of PNG chunks and ZIP archives (PNG specification, annex D): x^32 + x^26 + ...
// + 1, reflected.
struct CrcTable {
  uint32_t of[256] = {};
  constexpr CrcTable() {
    for (uint32_t n = 0; n < 256; ++n) {
      of[n] = n;
      for (int bit = 0; bit < 8; ++bit) of[n] = of[n] >> 1 ^ (of[n] % 2 == 0 ? 0 : 0xedb88320u);
    }
  }
};
constexpr CrcTable kCrc;

// Checks the lengths and checksums of PNG chunks. The library stb_image allocates the declared size
// of a chunk before it checks that the data exists, and never verifies checksums.
Container CheckPng(const Bytes& bytes, bool checksums) {
  for (size_t at = sizeof(kPngSignature); at + 12 <= bytes.size();) {
    const uint8_t* chunk = &bytes[at];
    const size_t length = ReadBigEndian32(chunk);
    if (length > bytes.size() - at - 12) return Container::kTruncated;
    if (checksums && Crc32(chunk + 4, length + 4) != ReadBigEndian32(chunk + 8 + length)) {
      return Container::kBroken;
    }
    if (std::equal(chunk + 4, chunk + 8, "IEND")) return Container::kWhole;
    at += 12 + length;
  }
  return Container::kTruncated;
}

// Checks the Huffman tables in [at, end). Each Huffman table has a byte for its class, 16 counts of
// codes, and the values of the codes. Version 2.27 of stb_image writes out of bounds if a table has
// more than 256 codes.
Container CheckHuffmanTables(const Bytes& bytes, size_t at, size_t end) {
  while (at < end) {
    if (at + 17 > bytes.size()) return Container::kTruncated;
    const size_t codes = std::accumulate(&bytes[at + 1], &bytes[at + 17], size_t{0});
    if (codes > 256) return Container::kBroken;
    at += 17 + codes;
  }
  return Container::kWhole;
}

// Rejects truncated JPEG files, whose missing part stb_image would fill with grey.
Container CheckJpeg(const Bytes& bytes) {
  constexpr uint8_t kHuffmanTables = 0xc4;
  size_t at = sizeof(kJpegSignature);
  while (const auto segment = NextJpegSegment(bytes.data(), bytes.size(), at)) {
    if (segment->marker == kJpegEndOfImage) return Container::kWhole;
    at = segment->end;
    if (segment->marker != kHuffmanTables) continue;
    const Container tables = CheckHuffmanTables(bytes, segment->begin, segment->end);
    if (tables != Container::kWhole) return tables;
  }
  return Container::kTruncated;
}

// A file type and its signature, which starts at byte `at` of the file.
struct Beginning {
  size_t at;
  const char* bytes;
  const char* what;
  bool is_picture = false;  // True for a picture of a format that the program does not read.
};
constexpr Beginning kBeginnings[] = {
    {0, "\x89PNG", "a damaged PNG file"},
    {0, "\xff\xd8", "a damaged JPEG file"},
    {0, "GIF8", "a GIF file", true},
    {0, "BM", "a BMP file", true},
    {0, "II*", "a TIFF or raw file", true},
    {0, "MM", "a TIFF or raw file", true},
    {0, "\x93NUMPY", "a NumPy array"},
    {0, "v/1\x01", "an OpenEXR file", true},
    {0, "%PDF", "a PDF file"},
    {0, "PK\x03\x04", "a ZIP archive"},
    {0, "\x1f\x8b", "a gzip archive"},
    {0, "version https://git-lfs", "a pointer of Git LFS, not the file itself"},
    {8, "WEBP", "a WebP file"},
    {4, "ftyp", "a HEIF, AVIF or MP4 file"},
};

// Returns true if the first bytes are text: they contain no control characters except white space.
bool IsText(const Bytes& bytes) {
  const auto end = bytes.begin() + static_cast<ptrdiff_t>(std::min(bytes.size(), size_t{512}));
  return std::all_of(bytes.begin(), end, [](uint8_t c) {
    return (c >= 0x20 && c != 0x7f) || (c >= '\t' && c <= '\r') || c == 0x1b;
  });
}

}  // namespace

Error Truncated(const std::string& where, const std::string& format) {
  return {ErrorKind::kInput,
          where + ": the " + format +
              " file is truncated (expected its last part, found the end of the file)"};
}

std::string DescribeFile(const Bytes& bytes, const std::string& advice) {
  if (bytes.empty()) return "an empty file";
  for (const Beginning& beginning : kBeginnings) {
    const size_t size = std::strlen(beginning.bytes);
    if (bytes.size() >= beginning.at + size &&
        std::memcmp(&bytes[beginning.at], beginning.bytes, size) == 0) {
      return beginning.what + (beginning.is_picture ? advice : "");
    }
  }
  const bool blank = std::all_of(bytes.begin(), bytes.end(), [](uint8_t c) { return c == 0; });
  if (blank) return "a file of zeros";
  return IsText(bytes) ? "a text file" : "a file of an unknown format";
}

std::optional<JpegSegment> NextJpegSegment(const uint8_t* jpeg, size_t size, size_t at) {
  constexpr uint8_t kStuffed = 0x00, kTemporary = 0x01, kFirstRestart = 0xd0, kLastRestart = 0xd7;
  for (; at + 1 < size; ++at) {
    const uint8_t marker = jpeg[at + 1];
    if (jpeg[at] != 0xff || marker == 0xff) continue;
    if (marker == kJpegEndOfImage) return JpegSegment{marker, at + 2, at + 2};
    if (marker == kStuffed || marker == kTemporary ||
        (marker >= kFirstRestart && marker <= kLastRestart)) {
      ++at;
      continue;
    }
    if (at + 4 > size) break;
    const size_t end = at + 2 + size_t(jpeg[at + 2]) * 256 + jpeg[at + 3];
    return end <= size ? std::optional(JpegSegment{marker, at + 4, end}) : std::nullopt;
  }
  return {};
}

uint32_t ReadBigEndian32(const uint8_t* bytes) {
  return uint32_t(bytes[0]) << 24 | uint32_t(bytes[1]) << 16 | uint32_t(bytes[2]) << 8 | bytes[3];
}

uint32_t Crc32(const uint8_t* bytes, size_t size) {
  uint32_t crc = 0xffffffffu;
  for (size_t n = 0; n < size; ++n) crc = kCrc.of[(crc ^ bytes[n]) & 0xff] ^ crc >> 8;
  return ~crc;
}

bool MayBePicture(const Bytes& beginning) {
  if (beginning.size() < 12) return true;  // a file of less than 12 bytes is cheap to read
  const bool netpbm = beginning[0] == 'P' && beginning[1] >= '1' && beginning[1] <= '6';
  return netpbm || IsExr(beginning) || IsTiff(beginning) || IsPng(beginning) ||
         StartsWith(beginning, kJpegSignature) || std::memcmp(&beginning[0], "RIFF", 4) == 0 ||
         std::memcmp(&beginning[4], "ftyp", 4) == 0;
}

bool IsExr(const Bytes& bytes) {
  constexpr uint8_t kExrSignature[] = {'v', '/', '1', 1};
  return StartsWith(bytes, kExrSignature);
}

bool IsPng(const Bytes& bytes) { return StartsWith(bytes, kPngSignature); }

bool IsTruncatedPng(const Bytes& png) { return CheckPng(png, false) == Container::kTruncated; }

Container CheckContainer(const Bytes& bytes) {
  if (IsPng(bytes)) return CheckPng(bytes, true);
  if (StartsWith(bytes, kJpegSignature)) return CheckJpeg(bytes);
  return Container::kUnknown;
}

}  // namespace starfocus
