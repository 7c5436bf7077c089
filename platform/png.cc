// SPDX-License-Identifier: Apache-2.0
#include "platform/png.h"

#include <algorithm>
#include <iterator>

#include "platform/container.h"

namespace starfocus {
namespace {

constexpr size_t kFirstChunk = 8;  // after the signature
constexpr int kGrey = 0, kPalette = 3;

bool IsChunk(const uint8_t* chunk, const char* name) {
  return std::equal(name, name + 4, chunk + 4);
}

}  // namespace

std::optional<PngHeader> ReadPngHeader(const Bytes& png) {
  constexpr size_t kSize = 13;
  if (png.size() < kFirstChunk + 8 + kSize) return {};
  const uint8_t* chunk = &png[kFirstChunk];
  if (!IsChunk(chunk, "IHDR") || ReadBigEndian32(chunk) != kSize) return {};
  return PngHeader{ReadBigEndian32(chunk + 8), ReadBigEndian32(chunk + 12), chunk[16], chunk[17]};
}

// The PNG format does not allow palettes with 16-bit indices, and stb_image rejects such files.
bool HasPalette(const PngHeader& header) { return header.colour == kPalette && header.depth <= 8; }

Bytes TakePalette(Bytes* png) {
  Bytes palette;
  (*png)[kFirstChunk + 17] = kGrey;
  for (size_t at = kFirstChunk; at + 12 <= png->size();) {
    uint8_t* chunk = &(*png)[at];
    if (IsChunk(chunk, "IEND")) break;  // any data may follow the last chunk
    const size_t length = ReadBigEndian32(chunk);
    if (IsChunk(chunk, "PLTE")) palette.assign(chunk + 8, chunk + 8 + length);
    // Rename the chunk tRNS so that decoders skip it: opacities of a palette do not apply to grey
    // levels.
    if (IsChunk(chunk, "tRNS")) chunk[4] = 'x';
    at += 12 + length;
  }
  return palette;
}

int GreyStep(const PngHeader& header) { return 255 / ((1 << header.depth) - 1); }

}  // namespace starfocus
