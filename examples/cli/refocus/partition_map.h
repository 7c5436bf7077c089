// SPDX-License-Identifier: Apache-2.0
// The partition of a refocusing, drawn over a picture.
#ifndef STARFOCUS_EXAMPLES_CLI_REFOCUS_PARTITION_MAP_H_
#define STARFOCUS_EXAMPLES_CLI_REFOCUS_PARTITION_MAP_H_

#include <vector>

#include "platform/image.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// A starfocus_block_visitor; `data` is a std::vector<starfocus_block> that the block is added to.
void CollectBlock(void* data, const starfocus_block* block);

// The picture in grey, or the region of it whose first pixel is (left, top), every block tinted by
// its layer (L = 0 red, 1 green, 2 blue) and outlined.
Image DrawPartition(const Image& picture, int left, int top,
                    const std::vector<starfocus_block>& blocks);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_REFOCUS_PARTITION_MAP_H_
