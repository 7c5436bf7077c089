// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/decoding_memory.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <string>

#include "platform/container.h"
#include "platform/decoders/exr_header.h"
#include "platform/readers/heic.h"

namespace starfocus {
namespace {

// 3 bytes for the picture and 4 for its map in the helper process, the same again in the program,
// and 2 for the planes of a decoder. Files that may have more than 8 bits or alpha take 8 bytes
// more in each process.
constexpr uint64_t kBytesPerPixel = 16, kDeepBytesPerPixel = 32;
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

// Returns the pixels of the largest display window of the parts of an OpenEXR file.
uint64_t ExrPixels(Span file) {
  uint64_t most = 0;
  const bool is_whole = VisitExrAttributes(
      file.data, file.size, [&](const std::string& name, const uint8_t* value, size_t size) {
        if (name != "displayWindow" || size != 16) return;
        const auto side = [value](size_t first) {  // from the first and the last coordinate
          const Span box = {value, 16};
          return (Little(box, first + 8, 4) - Little(box, first, 4) + 1) & 0xffffffff;
        };
        most = std::max(most, side(0) * side(4));
      });
  return is_whole && most > 0 ? most : kUnknown;
}

// Returns the pixels of the first directory of a TIFF file (TIFF 6.0, section 2).
uint64_t TiffPixels(Span file) {
  const bool is_little = HasAt(file, 0, "II*");
  const auto number = [&](size_t at, int bytes) {
    uint64_t value = Little(file, at, bytes);
    if (!is_little) {
      value = 0;
      for (int k = 0; k < bytes; ++k) value = value << 8 | file.data[at + static_cast<size_t>(k)];
    }
    return value;
  };
  if (file.size < 8) return kUnknown;
  const auto directory = static_cast<size_t>(number(4, 4));
  if (directory > file.size - 2) return kUnknown;
  constexpr uint64_t kWidth = 256, kHeight = 257, kShort = 3;
  uint64_t width = 0, height = 0;
  const auto entries = static_cast<size_t>(number(directory, 2));
  for (size_t k = 0, at = directory + 2; k < entries && at + 12 <= file.size; ++k, at += 12) {
    const uint64_t tag = number(at, 2), value = number(at + 8, number(at + 2, 2) == kShort ? 2 : 4);
    if (tag == kWidth) width = value;
    if (tag == kHeight) height = value;
  }
  return width * height == 0 ? kUnknown : width * height;
}

// Returns the bytes for a pixel that files of this format may take.
uint64_t BytesPerPixel(Span file) {
  const bool is_deep = IsHeif(file) || HasAt(file, 1, "PNG\r\n") || HasAt(file, 0, "v/1\1") ||
                       HasAt(file, 0, "II*") || HasAt(file, 0, "MM") || HasAt(file, 0, "RIFF");
  return is_deep ? kDeepBytesPerPixel : kBytesPerPixel;
}

uint64_t PixelsOf(Span file) {
  if (IsJpeg(file)) return JpegPixels(file);
  if (IsHeif(file)) return HeifPixels(file);
  if (HasAt(file, 1, "PNG\r\n") && file.size >= 24) {
    return uint64_t{ReadBigEndian32(file.data + 16)} * ReadBigEndian32(file.data + 20);
  }
  if (HasAt(file, 0, "RIFF") && HasAt(file, 8, "WEBP")) return WebpPixels(file);
  if (HasAt(file, 0, "v/1\1")) return ExrPixels(file);
  if (HasAt(file, 0, "II*") || HasAt(file, 0, "MM")) return TiffPixels(file);
  // Each pixel of formats without compression takes at least one byte.
  for (const char* signature : {"P5", "P6", "Pf", "PF", "\x93NUMPY"}) {
    if (HasAt(file, 0, signature)) return file.size;
  }
  return kUnknown;
}

}  // namespace

uint64_t DecodingBytes(Span file) {
  const uint64_t pixels = PixelsOf(file);
  const uint64_t bytes = BytesPerPixel(file);
  return pixels < kUnknown / bytes ? pixels * bytes : kUnknown;
}

}  // namespace starfocus
