// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/estimate.h"

#include <cstdlib>

#include "lib/base/fixed.h"
#include "lib/base/rows.h"
#include "lib/depth/estimate_clean.h"
#include "lib/depth/phases.h"
#include "lib/depth/sweep.h"

namespace starfocus {
namespace {

struct EstimateJob {
  Sweep sweep;
  const MapOutput& output;
};

void SweepFirst(const void* data, int32_t index, int32_t worker) {
  SweepOneSide(&static_cast<const EstimateJob*>(data)->sweep, index, worker);
}

void SweepSecond(const void* data, int32_t index, int32_t worker) {
  SweepAllViews(&static_cast<const EstimateJob*>(data)->sweep, index, worker);
}

// Writes a tile of the result. Pixels that WithoutStray changes get confidence 0.
void WriteTile(const void* data, int32_t index, int32_t) {
  const EstimateJob& job = *static_cast<const EstimateJob*>(data);
  const EstimatePlan& plan = job.sweep.plan;
  const EstimateMemory& memory = *job.sweep.memory;
  const MapOutput& output = job.output;
  const Rect tile = TileOf(plan, index);
  for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
    const size_t row = static_cast<size_t>(y) * static_cast<size_t>(plan.width);
    float* disparity = output.disparity + static_cast<size_t>(y) * output.stride;
    for (int32_t x = tile.x; x < tile.x + tile.width; ++x) {
      const int32_t d =
          WithoutStray(plan, RowsOf(job.sweep.light_field.views[0]), memory.second, x, y);
      const size_t at = row + static_cast<size_t>(x);
      constexpr float kPixel = 1.0F / (1 << kDisparityBits);
      disparity[x] = output.Clamped(static_cast<float>(d) * kPixel);
      if (output.confidence == nullptr) continue;
      const bool overruled = std::abs(d - memory.second[at]) > 1 << kDisparityBits;
      output
          .confidence[static_cast<size_t>(y) * output.confidence_stride + static_cast<size_t>(x)] =
          overruled ? 0 : memory.certainty[at];
    }
  }
}

}  // namespace

starfocus_status Estimate(const EstimatePlan& plan, const starfocus_light_field& light_field,
                          const simd::DepthKernels& kernels, const MapOutput& output,
                          EstimateMemory* memory) {
  const EstimateJob job = {{plan, light_field, kernels, memory, output.confidence != nullptr},
                           output};
  constexpr JobFunction kPhases[] = {SweepFirst, SweepSecond, WriteTile};
  Phases phases(plan, sizeof kPhases / sizeof *kPhases, &memory->jobs);
  for (const JobFunction phase : kPhases) {
    const starfocus_status status = phases.Run(phase, &job);
    if (status != STARFOCUS_OK) return status;
  }
  return STARFOCUS_OK;
}

}  // namespace starfocus
