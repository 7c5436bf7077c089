// SPDX-License-Identifier: Apache-2.0
// Bytes as text: RFC 4648, section 4.
#ifndef STARFOCUS_PLATFORM_BASE64_H_
#define STARFOCUS_PLATFORM_BASE64_H_

#include <optional>
#include <string>

#include "platform/file.h"

namespace starfocus {

// With padding, without line breaks.
std::string EncodeBase64(const Bytes& bytes);

// Skips white space between characters. Padding at the end may be missing. None if the text has any
// other character.
std::optional<Bytes> DecodeBase64(const std::string& text);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_BASE64_H_
