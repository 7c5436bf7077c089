// SPDX-License-Identifier: Apache-2.0
#include "platform/decoders/png_text.h"

#include <libdeflate.h>

#include <algorithm>
#include <memory>
#include <string>

#include "platform/decoders/exif_bytes.h"

namespace starfocus {
namespace {

// Limit on the size of a text chunk in bytes. EXIF has at most 64 KiB, and its text has two digits
// per byte plus line breaks.
constexpr size_t kMostText = size_t{1} << 18;

struct FreeDecompressor {
  void operator()(libdeflate_decompressor* decompressor) const {
    libdeflate_free_decompressor(decompressor);
  }
};

// Returns the decompressed text, or an empty string if the data is malformed or the text is too
// long.
std::string Inflate(const uint8_t* data, size_t size) {
  const std::unique_ptr<libdeflate_decompressor, FreeDecompressor> decompressor(
      libdeflate_alloc_decompressor());
  std::string text(kMostText, '\0');
  size_t length = 0;
  if (decompressor == nullptr ||
      libdeflate_zlib_decompress(decompressor.get(), data, size, text.data(), text.size(),
                                 &length) != LIBDEFLATE_SUCCESS) {
    return "";
  }
  text.resize(length);
  return text;
}

// Returns the value of a hexadecimal digit, or -1 for other characters.
int DigitOf(char text) {
  if (text >= '0' && text <= '9') return text - '0';
  if (text >= 'a' && text <= 'f') return text - 'a' + 10;
  return text >= 'A' && text <= 'F' ? text - 'A' + 10 : -1;
}

// Parses a text such as "\nexif\n      124\n45786966...": a name, the number of bytes, and lines
// with the hexadecimal digits of the bytes.
Bytes ParseDigits(const std::string& text) {
  size_t at = text.find('\n', 1);
  if (at == std::string::npos) return {};
  at = text.find('\n', at + 1);
  Bytes bytes;
  int high = -1;
  for (; at < text.size(); ++at) {
    const int digit = DigitOf(text[at]);
    if (digit < 0) continue;
    if (high >= 0) bytes.push_back(static_cast<uint8_t>(high << 4 | digit));
    high = high >= 0 ? -1 : digit;
  }
  return bytes;
}

}  // namespace

void ReadRawProfile(bool compressed, const uint8_t* data, size_t size, Bytes* exif) {
  const uint8_t* const last = data + size;
  const uint8_t* end = std::find(data, last, uint8_t{0});  // Position after the keyword.
  const std::string keyword(data, end);
  if (keyword != "Raw profile type exif" && keyword != "Raw profile type APP1") return;
  // A zero byte follows the keyword, and a byte for the compression method follows in zTXt chunks.
  const size_t skip = compressed ? 2 : 1;
  if (size_t(last - end) < skip || !exif->empty()) return;
  end += skip;
  *exif = ParseDigits(compressed ? Inflate(end, size_t(last - end)) : std::string(end, last));
  TrimExif(exif);
}

void ReadXmpText(const uint8_t* data, size_t size, std::string* xmp) {
  constexpr char kKeyword[] = "XML:com.adobe.xmp";  // Keyword with its zero byte.
  constexpr size_t kFlags = 2;  // Bytes of the compression flag and the compression method.
  const uint8_t* const last = data + size;
  if (!xmp->empty() || size < sizeof(kKeyword) + kFlags ||
      !std::equal(kKeyword, kKeyword + sizeof(kKeyword), data)) {
    return;
  }
  const bool compressed = data[sizeof(kKeyword)] != 0;
  const uint8_t* text = data + sizeof(kKeyword) + kFlags;
  for (int part = 0; part < 2; ++part) {  // Skips the language tag and the translated keyword.
    text = std::find(text, last, uint8_t{0});
    if (text == last) return;
    ++text;
  }
  *xmp = compressed ? Inflate(text, size_t(last - text)) : std::string(text, last);
}

}  // namespace starfocus
