// SPDX-License-Identifier: Apache-2.0
// Encodes pictures as sixels, the graphics of DEC terminals.
#ifndef STARFOCUS_PLATFORM_WRITERS_SIXEL_H_
#define STARFOCUS_PLATFORM_WRITERS_SIXEL_H_

#include <string>

#include "platform/image.h"
#include "platform/result.h"

namespace starfocus {

// Returns the escape sequence that draws a picture of at least one pixel with up to 256 colours.
// Builds without libsixel return an error, which starts with `where`.
Result<std::string> EncodeSixel(const std::string& where, const Image& image);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_WRITERS_SIXEL_H_
