// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/evidence.h"

namespace starfocus {

int32_t LeastEvidence(const EvidenceScale& scale, const TileCount* counts, int32_t tiles) {
  int64_t rough = 1, differs = 0;
  for (int32_t tile = 0; tile < tiles; ++tile) {
    rough += counts[tile].rough;
    differs += counts[tile].differs;
  }
  const int64_t percent = 100 * differs / rough;
  if (percent <= scale.right_percent) return scale.right;
  if (percent >= scale.wrong_percent) return scale.wrong;
  const auto beyond = static_cast<int32_t>(scale.wrong_percent - percent);
  return scale.wrong +
         (scale.right - scale.wrong) * beyond / (scale.wrong_percent - scale.right_percent);
}

}  // namespace starfocus
