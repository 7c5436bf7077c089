// SPDX-License-Identifier: Apache-2.0
// Checks ICC profiles before readers of picture files pass them on. Pixels of this program are RGB,
// so a viewer would show wrong colours with a profile for grey or CMYK.
#ifndef STARFOCUS_PLATFORM_ICC_PROFILE_H_
#define STARFOCUS_PLATFORM_ICC_PROFILE_H_

#include "platform/file.h"

namespace starfocus {

// Returns true if `icc` is a complete profile for RGB (ICC.1:2022, 7.2 and 7.3). The profile must
// have the size in its header, must have the data colour space RGB, and must contain all tagged
// elements.
bool IsRgbProfile(const Bytes& icc);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_ICC_PROFILE_H_
