// SPDX-License-Identifier: Apache-2.0
// Number of pixels that the engine reads around the pixels it produces, accumulated over the
// processing steps. Each step declares its own border next to its code. borders.cc lists the steps
// and is the only place that adds borders.
#ifndef STARFOCUS_LIB_ENGINE_BORDERS_H_
#define STARFOCUS_LIB_ENGINE_BORDERS_H_

#include <cstdint>

#include "starfocus/starfocus.h"

namespace starfocus {

// Borders in pixels on each side of a superblock, or of its stripe. The border of a processing
// step's input includes the borders of all later steps.
struct Borders {
  int32_t joined = 0;                    // Finished pixels around a region, for deblocking.
  int32_t whole_block = 0;               // Pixels around a block that is planned without cells.
  int32_t layer[STARFOCUS_LAYERS] = {};  // Pixels of each layer around any possible block.
  int32_t cells = 0;                     // Number of cells (not pixels) around a superblock.
  int32_t parted = 0;                    // Pixels of the coverage map.
  int32_t centre = 0;                    // Pixels of the centre view and the disparity map.
  // Distance of the farthest highlights that affect a superblock; 0: no highlights.
  int32_t highlights = 0;
  int32_t views = 0;     // Pixels of any view.
  int32_t streamed = 0;  // Rows around a stripe of a stream, rounded up to even for images.
};

// Adds the borders of all processing steps for blur radii up to `max_blur`. `joins` is true if
// blocks are deblocked.
Borders AddBorders(const starfocus_config& config, double max_blur, bool joins);

// Returns the borders for the largest configured blur radius.
inline Borders LargestBorders(const starfocus_config& config) {
  return AddBorders(config, config.max_blur, true);
}

// Number of columns of superblocks.
inline int32_t Columns(const starfocus_config& config) {
  return (config.width + config.superblock - 1) / config.superblock;
}

// Largest number of rows of a layer that a stripe reads.
inline int32_t LayerRows(const starfocus_config& config, int layer) {
  return (config.superblock >> layer) + 2 * LargestBorders(config).layer[layer];
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_BORDERS_H_
