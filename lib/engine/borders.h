// SPDX-License-Identifier: Apache-2.0
// How many pixels the engine reads beyond what it makes, added up over its steps. Each step
// declares its own border beside its code; borders.cc has the list of steps, and nothing else adds
// borders.
#ifndef STARFOCUS_LIB_ENGINE_BORDERS_H_
#define STARFOCUS_LIB_ENGINE_BORDERS_H_

#include <cstdint>

#include "starfocus/starfocus.h"

namespace starfocus {

// Pixels on every side of a superblock, or of the stripe that it lies in. A border of a step's
// input holds all that the steps after it need.
struct Borders {
  int32_t joined = 0;                    // of the finished picture, around a region
  int32_t whole_block = 0;               // of a block at level 0 that is planned without cells
  int32_t level[STARFOCUS_LAYERS] = {};  // of pixels of the level, by blocks of any plan
  int32_t cells = 0;                     // of cells
  int32_t parted = 0;                    // of the coverage map
  int32_t centre = 0;                    // of the centre view and the disparity map
  int32_t highlights = 0;  // where highlights count as the superblock's own; 0: nowhere
  int32_t views = 0;       // of any view
  int32_t streamed = 0;    // of rows that are pushed; of images an even number
};

// Adds the borders for blur radii up to `max_blur`, and for deblocking if it `joins` blocks.
Borders AddBorders(const starfocus_config& config, double max_blur, bool joins);

// The largest that any lens has.
inline Borders LargestBorders(const starfocus_config& config) {
  return AddBorders(config, config.max_blur, true);
}

// Superblocks side by side.
inline int32_t Columns(const starfocus_config& config) {
  return (config.width + config.superblock - 1) / config.superblock;
}

// Rows of a level that a stripe may need.
inline int32_t LayerRows(const starfocus_config& config, int layer) {
  return (config.superblock >> layer) + 2 * LargestBorders(config).level[layer];
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_BORDERS_H_
