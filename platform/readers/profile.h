// SPDX-License-Identifier: Apache-2.0
// Checks the colour profile of a photograph, for the readers of all formats.
#ifndef STARFOCUS_PLATFORM_READERS_PROFILE_H_
#define STARFOCUS_PLATFORM_READERS_PROFILE_H_

#include "platform/readers/photo.h"

namespace starfocus {

// Adds an entry about photo->metadata.icc to photo->facts unless the profile is empty. Clears
// photo->metadata.icc if the profile is incomplete or not for RGB (icc_profile.h).
void CheckProfile(DepthPhoto* photo);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_PROFILE_H_
