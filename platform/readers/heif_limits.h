// SPDX-License-Identifier: Apache-2.0
// Checks the limits of HEIF files before libheif decodes them. Without checks, libheif would decode
// a picture that contains itself until threads or memory run out. Without checks, libheif would
// allocate memory for any size that a file declares.
#ifndef STARFOCUS_PLATFORM_READERS_HEIF_LIMITS_H_
#define STARFOCUS_PLATFORM_READERS_HEIF_LIMITS_H_

#include <string>

#include "platform/readers/jpeg_parts.h"
#include "platform/result.h"

namespace starfocus {

// Returns an error if a picture of `width` x `height` pixels is too large for a file of `file`
// bytes.
Error CheckHeifSize(const std::string& where, int64_t width, int64_t height, size_t file);

// Returns an error if the items of a file are malformed, too large or inconsistent. A derived
// picture may contain only coded pictures, and exactly as many as its item declares. The total area
// of the coded pictures in a derived picture must not be much larger than the area of the derived
// picture. A coded picture must have the size that its item declares.
Error CheckHeif(const std::string& where, Span file);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_HEIF_LIMITS_H_
