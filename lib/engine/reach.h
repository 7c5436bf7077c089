// SPDX-License-Identifier: Apache-2.0
// Columns of blocks, and how far around a stripe of them anything is read.
#ifndef STARFOCUS_LIB_ENGINE_REACH_H_
#define STARFOCUS_LIB_ENGINE_REACH_H_

#include <cstdint>

#include "starfocus/starfocus.h"

namespace starfocus {

// How far beyond a stripe of blocks anything may be read, for blur up to a radius.
struct Reach {
  int32_t border = 0;                  // pixels: largest border of a block
  int32_t cells = 0;                   // how many cells away a pixel may splat from
  int32_t layer_rows[SF_LAYERS] = {};  // of layers 1 and 2
  int32_t rows = 0;                    // picture rows of the centre view and the disparity map
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

// How far around a block highlights count as its own. It decides how blocks are split, and so the
// bytes of pictures: as far as blur and disparity bring them, and somewhat farther.
int32_t HighlightsAround(const sf_config& config, double max_blur);

// Rows beyond a stripe that any view is read in, for blur up to a radius.
int32_t SideReach(const sf_config& config, double max_blur);

// Returns how many rows beyond a stripe are pushed before it is refocused, and kept after that:
// what views may be read in, and of images, of which two rows share their chroma, an even number.
int32_t StreamReach(const sf_config& config);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_REACH_H_
