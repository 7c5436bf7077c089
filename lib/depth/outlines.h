// SPDX-License-Identifier: Apache-2.0
// Moves the outlines of a disparity map of a single view to the outlines of the picture. Maps from
// networks, stereo and sensors have outlines that are soft, of low resolution, or off by a few
// pixels.
//
// An outline is where the map crosses the mean of two surfaces that meet (`middle`). The pixels of
// a band around the outline have a signed distance to it, which is positive on the nearer side, and
// get votes: whether trusted pixels of similar colour around them are nearer or farther than the
// middle. The outline is displaced where the votes of a whole window agree, and snaps to the edges
// of the picture as far as colours explain the votes. Pixels that change their side, and pixels on
// ramps, take the disparity of the nearest clean pixels of their side. In hard maps, whose outlines
// are steps between neighbours, a second pass with a narrow band corrects what remains.
#ifndef STARFOCUS_LIB_DEPTH_OUTLINES_H_
#define STARFOCUS_LIB_DEPTH_OUTLINES_H_

#include <cstdint>

#include "lib/base/arena.h"
#include "lib/base/jobs.h"
#include "lib/depth/outline_planes.h"

namespace starfocus {

OutlineMemory TakeOutlines(int32_t width, int32_t height, int32_t max_workers, Arena* arena);

// Number of phases of FollowOutlines.
inline constexpr int32_t kOutlinePhases = 15;

// Returns the repaired map, which is memory.repaired or memory.given. Where the edges of the map
// are steps and few pixels would change their side, the map is right: memory.side is 0, memory.vote
// is 0 at pixels whose colours contradict the map, and disparities are as given.
const int16_t* FollowOutlines(const OutlinePicture& picture, const OutlineMemory& memory,
                              Sequence* run);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_OUTLINES_H_
