// SPDX-License-Identifier: Apache-2.0
// Checks ICC profiles before readers of picture files pass them on, and finds out their primaries
// for files that cannot store profiles. The pixels that starfocus writes are RGB, so a profile for
// grey or CMYK would cause wrong colours in viewers.
#ifndef STARFOCUS_PLATFORM_ICC_PROFILE_H_
#define STARFOCUS_PLATFORM_ICC_PROFILE_H_

#include <optional>

#include "platform/colour_description.h"
#include "platform/file.h"

namespace starfocus {

// Returns true if `icc` is a complete profile for RGB (ICC.1:2022, 7.2 and 7.3). A complete profile
// has the size that its header states, the data colour space RGB, and all tagged elements.
bool IsRgbProfile(const Bytes& icc);

// Returns the primaries and the transfer of a profile of primaries and curves (ICC.1:2022, 8.3.3),
// or nullopt for other profiles. Primaries within 0.001 of a code point of ColourDescription have
// this code point. Curves within 0.005 of sRGB or linear light have the code point of that
// transfer, and others the exponent of the code 0.5.
std::optional<ColourDescription> DescriptionOf(const Bytes& icc);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_ICC_PROFILE_H_
