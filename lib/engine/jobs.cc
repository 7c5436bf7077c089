// SPDX-License-Identifier: Apache-2.0
#include "lib/engine/jobs.h"

#include "lib/engine/borders.h"
#include "lib/plan/partition.h"

namespace starfocus {

int32_t MaxJobs(const starfocus_config& config) {
  const int32_t side = config.superblock;
  // A set has one job per block of a stripe, or one job per column of superblocks. Deblocking has
  // one job per row of smallest blocks in a stripe and in the rows kept above the stripe. A stripe
  // never has more columns of superblocks than blocks.
  return Max(Columns(config) * MaxBlocks(side), side / kSmallestBlock + 1);
}

}  // namespace starfocus
