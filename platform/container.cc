#include "platform/container.h"

#include <algorithm>
#include <numeric>

namespace starfocus {
namespace {

constexpr uint8_t kPngSignature[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
constexpr uint8_t kJpegSignature[] = {0xff, 0xd8};

template <size_t kSize>
bool StartsWith(const Bytes& bytes, const uint8_t (&signature)[kSize]) {
  return bytes.size() >= kSize && std::equal(signature, signature + kSize, bytes.begin());
}

// stb_image allocates what a chunk says it holds before it looks for it.
Container CheckPng(const Bytes& bytes) {
  for (size_t at = sizeof(kPngSignature); at + 12 <= bytes.size();) {
    const uint8_t* chunk = &bytes[at];
    const size_t length =
        size_t(chunk[0]) << 24 | size_t(chunk[1]) << 16 | size_t(chunk[2]) << 8 | size_t(chunk[3]);
    if (length > bytes.size() - at - 12) return Container::kTruncated;
    if (std::equal(chunk + 4, chunk + 8, "IEND")) return Container::kWhole;
    at += 12 + length;
  }
  return Container::kTruncated;
}

enum Marker : uint8_t {
  kStuffed = 0x00,  // a byte of coded data, 0xff
  kTemporary = 0x01,
  kHuffmanTables = 0xc4,
  kFirstRestart = 0xd0,
  kLastRestart = 0xd7,
  kEndOfImage = 0xd9
};

bool HasNoLength(uint8_t marker) {
  return marker == kStuffed || marker == kTemporary ||
         (marker >= kFirstRestart && marker <= kLastRestart);
}

// The Huffman tables in [at, end): each has a byte of its class, 16 numbers of codes and the codes'
// values. stb_image 2.27 writes beyond its table when there are more than 256.
Container CheckHuffmanTables(const Bytes& bytes, size_t at, size_t end) {
  while (at < end) {
    if (at + 17 > bytes.size()) return Container::kTruncated;
    const size_t codes = std::accumulate(&bytes[at + 1], &bytes[at + 17], size_t{0});
    if (codes > 256) return Container::kBroken;
    at += 17 + codes;
  }
  return Container::kWhole;
}

// stb_image fills the missing part of a truncated JPEG with grey. Between the segments lies coded
// data, where a 0xff is stuffed or restarts the coder.
Container CheckJpeg(const Bytes& bytes) {
  for (size_t at = sizeof(kJpegSignature); at + 1 < bytes.size();) {
    if (bytes[at] != 0xff || bytes[at + 1] == 0xff) {
      ++at;
      continue;
    }
    const uint8_t marker = bytes[at + 1];
    at += 2;
    if (HasNoLength(marker)) continue;
    if (marker == kEndOfImage) return Container::kWhole;
    if (at + 2 > bytes.size()) break;
    const size_t end = at + size_t(bytes[at]) * 256 + bytes[at + 1];
    if (end > bytes.size()) break;
    if (marker == kHuffmanTables) {
      const Container tables = CheckHuffmanTables(bytes, at + 2, end);
      if (tables != Container::kWhole) return tables;
    }
    at = end;
  }
  return Container::kTruncated;
}

}  // namespace

Container CheckContainer(const Bytes& bytes) {
  if (StartsWith(bytes, kPngSignature)) return CheckPng(bytes);
  if (StartsWith(bytes, kJpegSignature)) return CheckJpeg(bytes);
  return Container::kUnknown;
}

}  // namespace starfocus
