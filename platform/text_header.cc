// SPDX-License-Identifier: Apache-2.0
#include "platform/text_header.h"

#include "platform/image.h"

namespace starfocus {
namespace {

bool IsSpace(uint8_t c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

}  // namespace

void TextHeader::SkipSpaceAndComments() {
  bool comment = false;
  for (; position_ < bytes_.size(); ++position_) {
    const uint8_t c = bytes_[position_];
    if (comment) {
      comment = c != '\n' && c != '\r';
    } else if (c == '#') {
      comment = true;
    } else if (!IsSpace(c)) {
      return;
    }
  }
}

std::string TextHeader::Token() {
  SkipSpaceAndComments();
  std::string token;
  while (position_ < bytes_.size() && !IsSpace(bytes_[position_]) && token.size() < 32) {
    const uint8_t c = bytes_[position_++];
    token += c > ' ' && c < 0x7f ? static_cast<char>(c) : '?';
  }
  if (position_ < bytes_.size() && IsSpace(bytes_[position_])) ++position_;
  return token;
}

int ParseSize(const std::string& token) {
  if (token.empty() || token.size() > 5) return 0;
  int value = 0;
  for (char c : token) {
    if (c < '0' || c > '9') return 0;
    value = value * 10 + (c - '0');
  }
  return value <= kMaxPictureSize ? value : 0;
}

}  // namespace starfocus
