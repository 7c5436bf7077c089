// SPDX-License-Identifier: Apache-2.0
#include "platform/readers/base64.h"

namespace starfocus {
namespace {

// The six bits of a character; -1 for none.
int BitsOf(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+') return 62;
  return c == '/' ? 63 : -1;
}

bool IsSpace(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

}  // namespace

bool DecodeBase64(const std::string& text, Bytes* bytes) {
  Bytes result;
  result.reserve(text.size() / 4 * 3 + 3);
  uint32_t bits = 0;
  int count = 0;
  size_t at = 0;
  for (; at < text.size() && text[at] != '='; ++at) {
    if (IsSpace(text[at])) continue;
    const int six = BitsOf(text[at]);
    if (six < 0) return false;
    bits = (bits << 6 | static_cast<uint32_t>(six)) & 0xffff;
    count += 6;
    if (count < 8) continue;
    count -= 8;
    result.push_back(static_cast<uint8_t>(bits >> count));
  }
  for (; at < text.size(); ++at) {
    if (text[at] != '=' && !IsSpace(text[at])) return false;
  }
  *bytes = std::move(result);
  return true;
}

}  // namespace starfocus
