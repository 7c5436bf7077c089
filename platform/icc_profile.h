// SPDX-License-Identifier: Apache-2.0
// Checks ICC profiles before readers of picture files pass them on. The pixels that starfocus
// writes are RGB, so a profile for grey or CMYK would cause wrong colours in viewers.
#ifndef STARFOCUS_PLATFORM_ICC_PROFILE_H_
#define STARFOCUS_PLATFORM_ICC_PROFILE_H_

#include "platform/file.h"

namespace starfocus {

// Returns true if `icc` is a complete profile for RGB (ICC.1:2022, 7.2 and 7.3). The size of `icc`
// must equal the size in the profile header, the data colour space must be RGB, and all tagged
// elements must lie within `icc`.
bool IsRgbProfile(const Bytes& icc);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_ICC_PROFILE_H_
