// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/decoding_memory.h"

#include <algorithm>
#include <cstring>
#include <optional>

#include "platform/container.h"
#include "platform/readers/heic.h"

namespace starfocus {
namespace {

// 3 bytes for the picture and 4 for its map in the helper process, the same again in the program,
// and 2 for the planes of a decoder.
constexpr uint64_t kBytesPerPixel = 16;
constexpr uint64_t kUnknown = UINT64_MAX;

bool HasAt(Span file, size_t at, const char* text) {
  const size_t length = std::strlen(text);
  return file.size >= at + length && std::memcmp(file.data + at, text, length) == 0;
}

uint64_t Little(Span file, size_t at, int bytes) {
  uint64_t value = 0;
  for (int k = bytes; k-- > 0;) value = value << 8 | file.data[at + static_cast<size_t>(k)];
  return value;
}

// Returns the pixels of the first frame header (ITU-T T.81, B.2.2).
uint64_t JpegPixels(Span file) {
  size_t at = 2;
  for (;;) {
    const std::optional<JpegSegment> segment = NextJpegSegment(file.data, file.size, at);
    if (!segment || segment->marker == kJpegEndOfImage) return kUnknown;
    const uint8_t marker = segment->marker;
    const bool frame = marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 &&
                       marker != 0xcc;  // not DHT, JPG or DAC
    if (frame && segment->end - segment->begin >= 5) {
      const uint32_t size = ReadBigEndian32(file.data + segment->begin + 1);
      return uint64_t{size >> 16} * (size & 0xffff);
    }
    at = segment->end;
  }
}

// Returns the pixels of the largest picture (ISO/IEC 23008-12, 6.5.3) among the properties in the
// first 64 KiB.
uint64_t HeifPixels(Span file) {
  constexpr size_t kSearched = 65536, kSize = 8;  // version and flags precede the size
  uint64_t most = 0;
  for (size_t at = 0; at + kSize + 8 <= std::min(file.size, kSearched); ++at) {
    if (!HasAt(file, at, "ispe")) continue;
    most = std::max(most, uint64_t{ReadBigEndian32(file.data + at + kSize)} *
                              ReadBigEndian32(file.data + at + kSize + 4));
  }
  return most == 0 ? kUnknown : most;
}

// Returns the pixels of the first chunk of a WebP file (RFC 9649).
uint64_t WebpPixels(Span file) {
  if (file.size < 30) return kUnknown;
  if (HasAt(file, 12, "VP8X")) return (Little(file, 24, 3) + 1) * (Little(file, 27, 3) + 1);
  if (HasAt(file, 12, "VP8L")) {
    const uint64_t bits = Little(file, 21, 4);
    return ((bits & 0x3fff) + 1) * ((bits >> 14 & 0x3fff) + 1);
  }
  return (Little(file, 26, 2) & 0x3fff) * (Little(file, 28, 2) & 0x3fff);
}

uint64_t PixelsOf(Span file) {
  if (IsJpeg(file)) return JpegPixels(file);
  if (IsHeif(file)) return HeifPixels(file);
  if (HasAt(file, 1, "PNG\r\n") && file.size >= 24) {
    return uint64_t{ReadBigEndian32(file.data + 16)} * ReadBigEndian32(file.data + 20);
  }
  if (HasAt(file, 0, "RIFF") && HasAt(file, 8, "WEBP")) return WebpPixels(file);
  // Each pixel of formats without compression takes at least one byte.
  for (const char* signature : {"P5", "P6", "Pf", "PF", "\x93NUMPY"}) {
    if (HasAt(file, 0, signature)) return file.size;
  }
  return kUnknown;
}

}  // namespace

uint64_t DecodingBytes(Span file) {
  const uint64_t pixels = PixelsOf(file);
  return pixels < kUnknown / kBytesPerPixel ? pixels * kBytesPerPixel : kUnknown;
}

}  // namespace starfocus
