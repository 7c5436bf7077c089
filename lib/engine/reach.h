// SPDX-License-Identifier: Apache-2.0
// Columns of blocks, and how far around a stripe of them anything is read.
#ifndef STARFOCUS_LIB_ENGINE_REACH_H_
#define STARFOCUS_LIB_ENGINE_REACH_H_

#include <cstdint>

#include "starfocus/starfocus.h"

namespace starfocus {

// How far beyond a stripe of blocks anything may be read, for blur up to a radius.
struct Reach {
  int32_t border;  // pixels: largest border of a block
  int32_t cells;   // how many cells away a pixel may splat from
  int32_t rows;    // picture rows of the centre view and the disparity map
};
Reach GetReach(double max_blur);

// Columns of largest blocks.
inline int32_t Columns(const sf_config& config) {
  return (config.width + config.largest_block - 1) / config.largest_block;
}

// Rows of a layer that a stripe may need.
int32_t LayerRows(const sf_config& config, int layer);

// Pixels around a highlight that decide what it stands for; 0 where that is nothing but white.
int32_t HighlightReach(const sf_config& config);

// Rows beyond a stripe that side views are read in, for blur up to a radius.
int32_t SideReach(const sf_config& config, double max_blur);

// Returns how many rows beyond a stripe are pushed before it is refocused, and kept after that:
// what side views may be read in, and of images, of which two rows share their chroma, an even
// number.
int32_t StreamReach(const sf_config& config);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_REACH_H_
