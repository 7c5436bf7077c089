// SPDX-License-Identifier: Apache-2.0
// Computes the MD5 digest (RFC 1321), which identifies extended XMP. The digest is not used for
// security.
#ifndef STARFOCUS_PLATFORM_WRITERS_MD5_H_
#define STARFOCUS_PLATFORM_WRITERS_MD5_H_

#include <string>

namespace starfocus {

// Returns the MD5 digest of a text as 32 upper-case hexadecimal digits.
std::string Md5(const std::string& text);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_WRITERS_MD5_H_
