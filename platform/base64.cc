// SPDX-License-Identifier: Apache-2.0
#include "platform/base64.h"

#include <algorithm>

namespace starfocus {
namespace {

// Returns the six bits that a base64 character encodes, or -1 for other characters.
int BitsOf(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+') return 62;
  return c == '/' ? 63 : -1;
}

bool IsSpace(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

}  // namespace

std::string EncodeBase64(const Bytes& bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t at = 0; at < bytes.size(); at += 3) {
    const size_t count = std::min<size_t>(3, bytes.size() - at);
    uint32_t bits = 0;
    for (size_t i = 0; i < 3; ++i) bits = bits << 8 | (i < count ? bytes[at + i] : 0u);
    for (size_t i = 0; i < 4; ++i) text += i > count ? '=' : kDigits[bits >> (18 - 6 * i) & 63];
  }
  return text;
}

std::optional<Bytes> DecodeBase64(const std::string& text) {
  Bytes result;
  result.reserve(text.size() / 4 * 3 + 3);
  uint32_t bits = 0;
  int count = 0;
  size_t at = 0;
  for (; at < text.size() && text[at] != '='; ++at) {
    if (IsSpace(text[at])) continue;
    const int six = BitsOf(text[at]);
    if (six < 0) return {};
    bits = (bits << 6 | static_cast<uint32_t>(six)) & 0xffff;
    count += 6;
    if (count < 8) continue;
    count -= 8;
    result.push_back(static_cast<uint8_t>(bits >> count));
  }
  for (; at < text.size(); ++at) {
    if (text[at] != '=' && !IsSpace(text[at])) return {};
  }
  return result;
}

}  // namespace starfocus
