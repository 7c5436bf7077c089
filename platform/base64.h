// SPDX-License-Identifier: Apache-2.0
// Converts bytes to text by RFC 4648, section 4, and back.
#ifndef STARFOCUS_PLATFORM_BASE64_H_
#define STARFOCUS_PLATFORM_BASE64_H_

#include <optional>
#include <string>

#include "platform/file.h"

namespace starfocus {

// Encodes bytes as base64 with padding and without line breaks.
std::string EncodeBase64(const Bytes& bytes);

// Decodes a text. Skips white space in the text, and accepts missing padding at the end of the
// text. Returns nullopt if the text contains any character except base64 characters and white
// space.
std::optional<Bytes> DecodeBase64(const std::string& text);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_BASE64_H_
