// SPDX-License-Identifier: Apache-2.0
#include "lib/engine/jobs.h"

#include "lib/engine/borders.h"
#include "lib/plan/partition.h"

namespace starfocus {

int32_t MaxJobs(const starfocus_config& config) {
  const int32_t side = config.superblock;
  // Sets of jobs go by blocks of a stripe, by columns of superblocks, or in deblocking by rows
  // of smallest blocks of one stripe and of what waits above. There are no more columns than
  // blocks.
  return Max(Columns(config) * MaxBlocks(side), side / kSmallestBlock + 1);
}

}  // namespace starfocus
