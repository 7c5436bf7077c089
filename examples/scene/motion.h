// SPDX-License-Identifier: Apache-2.0
// Frames of a moving scene, and disparity maps that change from frame to frame like the maps of
// networks and sensors. Uses only arithmetic that IEEE 754 defines exactly, so that frames are
// equal on all machines.
#ifndef STARFOCUS_EXAMPLES_SCENE_MOTION_H_
#define STARFOCUS_EXAMPLES_SCENE_MOTION_H_

#include <cstdint>

#include "examples/scene/scene.h"
#include "platform/pfm.h"

namespace starfocus {

// Returns a scene at the time of a frame; the first frame is 0. The scene has more samples per
// pixel, so that textures do not shimmer. At frame 0, everything is where it is in the scene. The
// camera turns and moves, so that all scenes change. The foreground moves in parallel to the
// picture and turns about the first of the scene's points, which moves with it. All movements
// return to their beginning after 1 to 2 seconds at 60 frames per second, and textures move with
// their surfaces.
Scene SceneAt(const Scene& scene, int frame);

// Largest changes of an unstable map, in pixels: of disparities by noise and by the offset of a
// frame, and of outlines.
inline constexpr double kUnstableNoise = 0.5, kUnstableOffset = 0.3;
inline constexpr int kUnstableOutline = 2;

// Returns the map of a frame with three errors, which depend on the seed and the frame only:
// outlines of near surfaces grow in some places and shrink in others, smooth noise changes the
// disparities, and one offset is added to all of them.
FloatMap UnstableMap(const FloatMap& exact, uint32_t seed, int frame);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_SCENE_MOTION_H_
