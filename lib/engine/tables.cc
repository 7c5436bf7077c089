// SPDX-License-Identifier: Apache-2.0
#include "lib/engine/tables.h"

namespace starfocus {

void MakeTables(const sf_config& config, Tables* tables) {
  tables->opening = OpeningOf(config);
  uint16_t* weights = tables->aperture_weights;
  for (int32_t n = 0; n <= tables->max_n; ++n) {
    tables->apertures[n] = MakeAperture(n, tables->opening, weights);
    tables->view_counts[n] = CountViews(n);
    weights += ApertureSize(tables->opening, n);
  }
  for (int32_t n = 0; n <= tables->max_subaperture_n; ++n) {
    tables->subapertures[n] = MakeSubapertures(n, tables->opening, weights);
    tables->subaperture_view_counts[n] = CountSubapertures(tables->subapertures[n]);
    weights += ApertureSize(tables->opening, n);
  }
  tables->blur_steps = 0;
  tables->mean_square = MeanSquare(tables->opening);
}

sf_status MakeBlurKernels(int32_t steps, Watch* watch, Tables* tables) {
  if (steps <= tables->blur_steps) return SF_OK;
  Patience patience(watch);
  tables->blur_steps = MakeBlurKernels(tables->blur_steps, steps, tables->opening, &patience,
                                       tables->blur_weights, tables->blur_kernels);
  return tables->blur_steps == steps ? SF_OK : SF_ERROR_CANCELLED;
}

}  // namespace starfocus
