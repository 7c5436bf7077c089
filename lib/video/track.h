// SPDX-License-Identifier: Apache-2.0
// Follows a point of a subject through the frames of a stabiliser, so that the focus stays on it.
#ifndef STARFOCUS_LIB_VIDEO_TRACK_H_
#define STARFOCUS_LIB_VIDEO_TRACK_H_

#include "lib/video/stabilise.h"
#include "starfocus/video.h"

namespace starfocus {

// Starts to follow the point (x, y) of the current frame.
void BeginTrack(const Stabiliser& stabiliser, int32_t x, int32_t y, starfocus_track* track);

// Moves the point to the current frame, which is the one after that of the last call.
void FollowTrack(const Stabiliser& stabiliser, starfocus_track* track);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_VIDEO_TRACK_H_
