// SPDX-License-Identifier: Apache-2.0
// Chooses the ICC profile of a photo, and adds facts and notes about its colours.
#ifndef STARFOCUS_PLATFORM_READERS_PROFILE_H_
#define STARFOCUS_PLATFORM_READERS_PROFILE_H_

#include "platform/readers/photo.h"

namespace starfocus {

// Clears photo->metadata.icc if it is not a complete RGB profile. Replaces photo->metadata.colours
// by an equivalent profile if the photo has no profile, or if the description overrides the profile
// (cICP). If no profile can express the description, the description remains, and a note reports
// that only PNG files keep it. Sets photo->is_linear. Call the function after the function
// ReadExif, which may set a description.
void ChooseProfile(DepthPhoto* photo);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_PROFILE_H_
