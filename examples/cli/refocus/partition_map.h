// SPDX-License-Identifier: Apache-2.0
// Draws the blocks of a refocusing over a picture.
#ifndef STARFOCUS_EXAMPLES_CLI_REFOCUS_PARTITION_MAP_H_
#define STARFOCUS_EXAMPLES_CLI_REFOCUS_PARTITION_MAP_H_

#include <vector>

#include "platform/image.h"
#include "starfocus/experimental.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// A starfocus_block_visitor that appends the block to `data`, a std::vector<starfocus_block>.
void CollectBlock(void* data, const starfocus_block* block);

// Draws the picture in grey, with every block tinted by its layer (L = 0 red, 1 green, 2 blue) and
// outlined. `picture` may be a region whose first pixel is (left, top) of the whole picture.
Image DrawPartition(const Image& picture, int left, int top,
                    const std::vector<starfocus_block>& blocks);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_REFOCUS_PARTITION_MAP_H_
