// SPDX-License-Identifier: Apache-2.0
// The text header that PPM and PFM files share: tokens between white space, a single white-space
// character before the data, comments from # to the end of the line.
#ifndef STARFOCUS_PLATFORM_TEXT_HEADER_H_
#define STARFOCUS_PLATFORM_TEXT_HEADER_H_

#include <string>

#include "platform/file.h"

namespace starfocus {

class TextHeader {
 public:
  explicit TextHeader(const Bytes& bytes) : bytes_(bytes) {}

  // The next token and the one white-space character behind it; at most 32 characters, empty at
  // the end of the file. Characters that do not print become '?'.
  std::string Token();

  const uint8_t* data() const { return bytes_.data() + position_; }
  size_t remaining() const { return bytes_.size() - position_; }

 private:
  void SkipSpaceAndComments();

  const Bytes& bytes_;
  size_t position_ = 0;
};

// A whole number from 1 to kMaxPictureSize in decimal digits; 0 for anything else.
int ParseSize(const std::string& token);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_TEXT_HEADER_H_
