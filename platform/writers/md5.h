// SPDX-License-Identifier: Apache-2.0
// The digest by which extended XMP is named: RFC 1321. It keeps no secrets.
#ifndef STARFOCUS_PLATFORM_WRITERS_MD5_H_
#define STARFOCUS_PLATFORM_WRITERS_MD5_H_

#include <string>

namespace starfocus {

// 32 hexadecimal digits in capitals.
std::string Md5(const std::string& text);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_WRITERS_MD5_H_
