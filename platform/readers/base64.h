// SPDX-License-Identifier: Apache-2.0
// Base64 (RFC 4648) as XMP holds files.
#ifndef STARFOCUS_PLATFORM_READERS_BASE64_H_
#define STARFOCUS_PLATFORM_READERS_BASE64_H_

#include <string>

#include "platform/file.h"

namespace starfocus {

// White space between characters is skipped; what pads the end may be missing. False for any other
// character.
bool DecodeBase64(const std::string& text, Bytes* bytes);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_BASE64_H_
