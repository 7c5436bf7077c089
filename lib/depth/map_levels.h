// SPDX-License-Identifier: Apache-2.0
// Finds the depth edges of a map and the two surfaces that meet at each. An edge may be a step or a
// ramp of up to 24 pixels. Each pixel near an edge gets the disparities of the surfaces at both
// ends of the ramp, the side on which it lies, and its distance from the ramp.
#ifndef STARFOCUS_LIB_DEPTH_MAP_LEVELS_H_
#define STARFOCUS_LIB_DEPTH_MAP_LEVELS_H_

#include <cstdint>

#include "lib/base/carver.h"
#include "lib/depth/colour_map.h"

namespace starfocus {

// Distance from the nearest edge up to which pixels get levels.
inline constexpr int32_t kMostDistance = 44;
// Pixels around a tile that decide on its levels.
inline constexpr int32_t kLevelsMargin = kMostDistance + 12;

// Place of a pixel relative to the nearest edge.
inline constexpr uint8_t kNearSide = 0x80;      // flag: the pixel lies on the near side
inline constexpr uint8_t kOnRamp = 0x40;        // flag: the pixel lies between both surfaces
inline constexpr uint8_t kDistanceMask = 0x3F;  // distance from the edge: 0 beside a step
inline constexpr uint8_t kNoEdge = kDistanceMask;

// Planes of the picture's size; levels have kDisparityBits and are undefined at kNoEdge.
struct MapLevels {
  int16_t *near_level, *far_level;
  uint8_t* place;
};

// Memory of a worker, for the largest tile with kLevelsMargin around it.
struct LevelsScratch {
  int16_t *high, *low;
  int32_t* keys[3];
};

LevelsScratch TakeLevelsScratch(size_t width, size_t height, Carver* carver);

// Fills `levels` of a tile.
void FindLevels(const ColourMap& map, const Rect& tile, const LevelsScratch& scratch,
                const MapLevels& levels);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_MAP_LEVELS_H_
