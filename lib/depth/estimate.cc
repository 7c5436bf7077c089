// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/estimate.h"

#include <cstdlib>

#include "lib/base/fixed.h"
#include "lib/depth/estimate_clean.h"
#include "lib/depth/phases.h"
#include "lib/depth/side_maps.h"
#include "lib/depth/sweep.h"
#include "lib/io/rows.h"

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

void FindUnseenTile(const void* data, int32_t index, int32_t) {
  const Sweep& sweep = static_cast<const EstimateJob*>(data)->sweep;
  FindUnseen(sweep.plan, TileOf(sweep.plan, index), sweep.memory);
}

void FillUnseenTile(const void* data, int32_t index, int32_t) {
  const Sweep& sweep = static_cast<const EstimateJob*>(data)->sweep;
  FillUnseen(sweep.plan, TileOf(sweep.plan, index), sweep.memory);
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

// Estimates the maps of all side views, which lie on one side of the centre view.
starfocus_status SweepSideViews(const Sweep& sweep, Phases* phases) {
  for (int32_t k = 0; k < sweep.plan.side_views; ++k) {
    const SideReference side = MakeSideReference(sweep.plan, sweep.light_field, k);
    const Sweep of_side = {side.plan,
                           side.light_field,
                           sweep.kernels,
                           sweep.memory,
                           SideMap(sweep.plan, *sweep.memory, k),
                           false};
    const starfocus_status status = phases->Run(SweepOneSide, &of_side);
    if (status != STARFOCUS_OK) return status;
  }
  return STARFOCUS_OK;
}

}  // namespace

starfocus_status Estimate(const EstimatePlan& plan, const starfocus_light_field& light_field,
                          const simd::DepthKernels& kernels, const MapOutput& output,
                          EstimateMemory* memory) {
  const EstimateJob job = {
      {plan, light_field, kernels, memory, memory->first, output.confidence != nullptr}, output};
  constexpr JobFunction kAround[] = {SweepFirst, SweepSecond, WriteTile};
  constexpr JobFunction kOneSided[] = {SweepSecond, FindUnseenTile, FillUnseenTile, WriteTile};
  const bool one_sided = plan.one_sided();
  const int32_t steps = one_sided ? 4 : 3;
  Phases phases(plan, steps + (one_sided ? plan.side_views : 0), &memory->jobs);
  starfocus_status status = one_sided ? SweepSideViews(job.sweep, &phases) : STARFOCUS_OK;
  for (int32_t k = 0; k < steps && status == STARFOCUS_OK; ++k) {
    status = phases.Run(one_sided ? kOneSided[k] : kAround[k], &job);
  }
  return status;
}

}  // namespace starfocus
