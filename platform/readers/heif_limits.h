// SPDX-License-Identifier: Apache-2.0
// Limits of HEIF files, checked before libheif decodes them: it follows a picture that is made of
// itself until threads or memory run out, and allocates whatever size any part declares.
#ifndef STARFOCUS_PLATFORM_READERS_HEIF_LIMITS_H_
#define STARFOCUS_PLATFORM_READERS_HEIF_LIMITS_H_

#include <string>

#include "platform/readers/jpeg_parts.h"
#include "platform/result.h"

namespace starfocus {

// The error of a picture of this size in a file of so many bytes, if it is too large.
Error CheckHeifSize(const std::string& where, int64_t width, int64_t height, size_t file);

// The error of a file whose items are malformed, too large, or do not fit together: a picture made
// of others has coded ones alone, as many as it says and not much larger in all, and a coded
// picture has the size that its item declares.
Error CheckHeif(const std::string& where, Span file);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_HEIF_LIMITS_H_
