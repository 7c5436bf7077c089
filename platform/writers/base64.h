// SPDX-License-Identifier: Apache-2.0
// Bytes as text: RFC 4648, section 4.
#ifndef STARFOCUS_PLATFORM_WRITERS_BASE64_H_
#define STARFOCUS_PLATFORM_WRITERS_BASE64_H_

#include <string>

#include "platform/file.h"

namespace starfocus {

// With padding, without line breaks.
std::string EncodeBase64(const Bytes& bytes);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_WRITERS_BASE64_H_
