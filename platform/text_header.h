// SPDX-License-Identifier: Apache-2.0
// Parses the text header of PPM and PFM files. The header consists of tokens separated by white
// space, and comments from # to the end of the line. A single white-space character separates the
// header from the binary data.
#ifndef STARFOCUS_PLATFORM_TEXT_HEADER_H_
#define STARFOCUS_PLATFORM_TEXT_HEADER_H_

#include <string>

#include "platform/file.h"

namespace starfocus {

class TextHeader {
 public:
  explicit TextHeader(const Bytes& bytes) : bytes_(bytes) {}

  // Returns the next token of the header and skips the white-space character after the token. The
  // token has at most 32 characters, and is empty at the end of the file. Replaces non-printable
  // characters of the token by '?'.
  std::string Token();

  const uint8_t* data() const { return bytes_.data() + position_; }
  size_t remaining() const { return bytes_.size() - position_; }

 private:
  void SkipSpaceAndComments();

  const Bytes& bytes_;
  size_t position_ = 0;
};

// Parses a decimal integer from 1 to kMaxPictureSize. Returns 0 if the token is not an integer in
// this range.
int ParseSize(const std::string& token);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_TEXT_HEADER_H_
