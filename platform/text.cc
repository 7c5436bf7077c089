// SPDX-License-Identifier: Apache-2.0
#include "platform/text.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace starfocus {
namespace {

// Returns the number of continuation bytes after the first byte of a character in UTF-8, or 0 for a
// byte that is not the first byte of several.
size_t ContinuationsOf(unsigned char lead) {
  return lead >= 0xf0 && lead < 0xf8 ? 3 : lead >= 0xe0 ? lead < 0xf0 ? 2 : 0 : lead >= 0xc2;
}

bool IsContinuation(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }

// Returns the number of bytes of the character at `at`: 1 for a byte that is not valid UTF-8.
size_t BytesOfCharacter(const std::string& text, size_t at) {
  const size_t more = ContinuationsOf(static_cast<unsigned char>(text[at]));
  for (size_t i = 1; i <= more; ++i) {
    if (at + i >= text.size() || !IsContinuation(text[at + i])) return 1;
  }
  return 1 + more;
}

}  // namespace

std::optional<double> ParseNumber(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || end != text.c_str() + text.size() || !std::isfinite(value)) return {};
  return value;
}

std::string SizeText(int64_t width, int64_t height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

std::string NumberText(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.6g", value);
  return text;
}

std::string Lower(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

std::string Printable(std::string text) {
  for (size_t at = 0, bytes = 0; at < text.size(); at += bytes) {
    bytes = BytesOfCharacter(text, at);
    const auto first = static_cast<unsigned char>(text[at]);
    const auto last = static_cast<unsigned char>(text[at + bytes - 1]);
    const bool single = bytes == 1 && (first < 0x20 || (first >= 0x7f && first < 0xa0));
    const bool pair = bytes == 2 && first == 0xc2 && last < 0xa0;
    if (single || pair) text.replace(at, bytes, bytes, ' ');
  }
  return text;
}

std::string EscapeXml(const std::string& text) {
  const std::string markup = "&<>\"\n\r\t";
  constexpr const char* kReferences[] = {"&amp;", "&lt;",  "&gt;", "&quot;",
                                         "&#10;", "&#13;", "&#9;"};
  std::string escaped;
  for (const char c : text) {
    const size_t at = markup.find(c);
    escaped += at == std::string::npos ? std::string(1, c) : kReferences[at];
  }
  return escaped;
}

}  // namespace starfocus
