// SPDX-License-Identifier: Apache-2.0
// Checks ICC profiles before readers of picture files pass them on. The pixels that starfocus
// writes are RGB, so a profile for grey or CMYK would cause wrong colours in viewers.
#ifndef STARFOCUS_PLATFORM_ICC_PROFILE_H_
#define STARFOCUS_PLATFORM_ICC_PROFILE_H_

#include "platform/file.h"

namespace starfocus {

// Returns true if `icc` is a complete profile for RGB (ICC.1:2022, 7.2 and 7.3). A complete profile
// has the size that its header states, the data colour space RGB, and all tagged elements.
bool IsRgbProfile(const Bytes& icc);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_ICC_PROFILE_H_
