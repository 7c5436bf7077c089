// SPDX-License-Identifier: Apache-2.0
// The colour profile of a photograph, as readers of every format pass it on.
#ifndef STARFOCUS_PLATFORM_READERS_PROFILE_H_
#define STARFOCUS_PLATFORM_READERS_PROFILE_H_

#include "platform/readers/photo.h"

namespace starfocus {

// Adds a fact about photo->metadata.icc, if there is any, and empties it unless it is a whole
// profile of RGB (icc_profile.h).
void CheckProfile(DepthPhoto* photo);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_PROFILE_H_
