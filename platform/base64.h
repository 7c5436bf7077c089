// SPDX-License-Identifier: Apache-2.0
// Bytes as text: RFC 4648, section 4.
#ifndef STARFOCUS_PLATFORM_BASE64_H_
#define STARFOCUS_PLATFORM_BASE64_H_

#include <string>

#include "platform/file.h"

namespace starfocus {

// With padding, without line breaks.
std::string EncodeBase64(const Bytes& bytes);

// White space between characters is skipped; what pads the end may be missing. False for any other
// character.
bool DecodeBase64(const std::string& text, Bytes* bytes);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_BASE64_H_
