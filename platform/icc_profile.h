// SPDX-License-Identifier: Apache-2.0
// Test of ICC profiles that readers of picture files apply before a profile is passed on: pixels of
// this program are RGB, so that a profile of grey or CMYK would make a viewer show other colours.
#ifndef STARFOCUS_PLATFORM_ICC_PROFILE_H_
#define STARFOCUS_PLATFORM_ICC_PROFILE_H_

#include "platform/file.h"

namespace starfocus {

// Returns true if `icc` is a whole profile of RGB colours (ICC.1:2022, 7.2 and 7.3): its size is
// the one in its header, its data colour space is RGB, and all tagged elements lie within it.
bool IsRgbProfile(const Bytes& icc);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_ICC_PROFILE_H_
